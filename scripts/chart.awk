# chart.awk -v column=N -v heading=TEXT -v most=X NAME=TRACE.csv...: an SVG chart of a column of traces (from 1) against the iteration, both
# axes logarithmic. Iterations beyond `most` (0: none) and values that are not positive have no place in it.
function log10(x) { return log(x) / log(10) }
function px(k) { return 60 + 500 * log10(k) / wide }
function py(v) { return 40 + 300 * (top - log10(v)) / (top - bottom) }
BEGIN {
    FS = ","
    for (i = 1; i < ARGC; i++) {
        name = file = ARGV[i]; sub(/=.*/, "", name); sub(/^[^=]*=/, "", file)
        gsub(/_/, " ", name)
        label[i] = name
        while ((getline line < file) > 0) {
            split(line, f, ",")
            if (f[1] + 0 < 1 || f[column] + 0 <= 0 || (most > 0 && f[1] > most)) continue
            x[i, ++count[i]] = f[1]; y[i, count[i]] = f[column]
            if (f[1] > last) last = f[1]
            value = log10(f[column])
            if (top == "" || value > top) top = value
            if (bottom == "" || value < bottom) bottom = value
        }
    }
    top = int(top + 99) - 98; bottom = int(bottom + 99) - 99; wide = log10(last)
    split("#1b6ca8 #d1495b #2e8b57 #b8860b #6a4c93 #444444 #00a0a0 #c06014", colour, " ")
    print "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"760\" height=\"390\" font-family=\"sans-serif\" font-size=\"12\">"
    print "<rect width=\"760\" height=\"390\" fill=\"white\"/><text x=\"60\" y=\"22\" font-size=\"14\">" heading "</text>"
    step = top - bottom > 8 ? 2 : 1
    for (e = bottom; e <= top; e += step)
        printf "<path d=\"M60 %.1fH560\" stroke=\"#dddddd\"/><text x=\"54\" y=\"%.1f\" text-anchor=\"end\">1e%d</text>\n", py(10 ^ e), py(10 ^ e) + 4, e
    for (e = 0; e <= wide; e++)
        printf "<path d=\"M%.1f 40V340\" stroke=\"#dddddd\"/><text x=\"%.1f\" y=\"356\" text-anchor=\"middle\">%d</text>\n", px(10 ^ e), px(10 ^ e), 10 ^ e
    print "<path d=\"M60 40V340H560\" fill=\"none\" stroke=\"black\"/><text x=\"310\" y=\"376\" text-anchor=\"middle\">iterations</text>"
    for (i = 1; i < ARGC; i++) {
        printf "<path fill=\"none\" stroke-width=\"1.6\" stroke=\"%s\" d=\"", colour[i]
        before = -9
        for (k = 1; k <= count[i]; k++) {
            here = px(x[i, k])
            if (k > 1 && k < count[i] && here < before + 0.5) continue
            printf "%s%.1f %.1f", k == 1 ? "M" : "L", here, py(y[i, k])
            before = here
        }
        printf "\"/><path d=\"M572 %d h18\" stroke=\"%s\" stroke-width=\"2\"/><text x=\"596\" y=\"%d\">%s</text>\n", 36 + 18 * i, colour[i], 40 + 18 * i, label[i]
    }
    print "</svg>"
    exit
}
