# awk -v box="x0 x1 y0 y1 ..." -f box.awk FILE FILE: the columns of numbers, each scaled to its side of the box; a header is skipped.
BEGIN {
    FS = ","
    count = split(box, side, " ") / 2
}
FNR == 1 && /[a-z]/ { next }
NR == FNR {
    for (k = 1; k <= count; k++) {
        if (!(k in low) || $k < low[k]) low[k] = $k
        if (!(k in high) || $k > high[k]) high[k] = $k
    }
    next
}
{
    for (k = 1; k <= count; k++) {
        share = ($k - low[k]) / (high[k] - low[k])
        printf "%.17g%s", side[2 * k - 1] + share * (side[2 * k] - side[2 * k - 1]), k < count ? "," : "\n"
    }
}
