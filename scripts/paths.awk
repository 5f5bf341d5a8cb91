# paths.awk NAME=TOLERANCE=TRACE.csv...: an SVG chart of the largest error, in tolerances, over the control points, from one iteration to the
# next, both axes logarithmic.
function log10(x) { return log(x) / log(10) }
function px(n) { return 60 + 500 * (log10(n) - left) / (right - left) }
function py(v) { return 40 + 300 * (top - log10(v)) / (top - bottom) }
BEGIN {
    FS = ","
    left = 99; right = bottom = 0; top = 1
    for (i = 1; i < ARGC; i++) {
        split(ARGV[i], word, "=")
        label[i] = word[1]
        while ((getline line < word[3]) > 0) {
            split(line, f, ",")
            if (f[3] + 0 <= 0) continue
            x[i, ++count[i]] = f[2]; y[i, count[i]] = f[3] / word[2]
            if (log10(f[2]) < left) left = log10(f[2])
            if (log10(f[2]) > right) right = log10(f[2])
            if (log10(f[3] / word[2]) > top) top = log10(f[3] / word[2])
            if (log10(f[3] / word[2]) < bottom) bottom = log10(f[3] / word[2])
        }
    }
    bottom -= 0.15; top += 0.1
    split("#1b6ca8 #d1495b #2e8b57 #b8860b #6a4c93 #444444", colour, " ")
    print "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"720\" height=\"390\" font-family=\"sans-serif\" font-size=\"12\">"
    print "<rect width=\"720\" height=\"390\" fill=\"white\"/><text x=\"60\" y=\"22\" font-size=\"14\">largest error, in tolerances</text>"
    for (e = int(bottom); e <= top; e++)
        printf "<path d=\"M60 %.1fH560\" stroke=\"%s\"/><text x=\"54\" y=\"%.1f\" text-anchor=\"end\">%g</text>\n", py(10 ^ e), e == 0 ? "#444444" : "#dddddd", py(10 ^ e) + 4, 10 ^ e
    for (e = int(left) + (left > int(left)); e <= right; e++)
        printf "<path d=\"M%.1f 40V340\" stroke=\"#dddddd\"/><text x=\"%.1f\" y=\"356\" text-anchor=\"middle\">%d</text>\n", px(10 ^ e), px(10 ^ e), 10 ^ e
    print "<path d=\"M60 40V340H560\" fill=\"none\" stroke=\"black\"/><text x=\"310\" y=\"376\" text-anchor=\"middle\">control points</text>"
    for (i = 1; i < ARGC; i++) {
        printf "<path fill=\"none\" stroke-width=\"1.6\" stroke=\"%s\" d=\"", colour[i]
        for (k = 1; k <= count[i]; k++) printf "%s%.1f %.1f", k == 1 ? "M" : "L", px(x[i, k]), py(y[i, k])
        print "\"/>"
        for (k = 1; k <= count[i]; k++)
            printf "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"%s\" fill=\"%s\"/>\n", px(x[i, k]), py(y[i, k]), k == count[i] ? 5 : 2.5, colour[i]
        printf "<path d=\"M572 %d h18\" stroke=\"%s\" stroke-width=\"2\"/><text x=\"596\" y=\"%d\">%s</text>\n", 36 + 18 * i, colour[i], 40 + 18 * i, label[i]
    }
    print "</svg>"
}
