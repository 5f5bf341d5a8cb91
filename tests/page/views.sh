#!/bin/sh
# views.sh ROOT PIA [--update]: reports of real data, opened and looked at in headless Chromium. --update makes the pictures anew.
set -u
root=$1 pia=$2 update=${3-}
playwright=$root/web/node_modules/playwright-core/index.mjs
chromium=$(command -v chromium || command -v chromium-browser) || { echo 'skipped: there is no chromium'; exit 77; }
command -v node >/dev/null && [ -f "$playwright" ] || { echo 'skipped: ./run web has not been run here'; exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$root" || exit 2
set -e
fit() { "$pia" fit "$@" --quiet >/dev/null; }
fit data/airfoil/rae2822.dat --tolerance 1e-4 --report "$work/curve.html"
awk 'BEGIN { for (i = 0; i <= 80; i++) printf "%.6f,%.6f,%.6f\n", cos(i / 8), sin(i / 8), i / 40 + 0.02 * sin(9 * i) }' >"$work/helix.csv"
fit "$work/helix.csv" --control 20 --method lspia --iterations 30 --report "$work/space.html"
fit data/surface/peaks11.csv --grid 11x11 --control 9,9 --interpolate 0,60 --method clspia --iterations 40 --report "$work/surface.html" -o "$work/surface.json"
awk -F , 'NR > 1 { if (NR > 2 && $1 != part) print ""; part = $1; print $2 "," $3 }' data/glyph/dejavuserif_g_outline.csv >"$work/letter.csv"
fit "$work/letter.csv" --closed --corners auto --tolerance 3 --report "$work/parts.html"
sh "$root/tests/page/trim.sh" "$work/surface.json" >"$work/trimmed.json"
"$pia" plot "$work/trimmed.json" -o "$work/trimmed.html" --quiet
node "$root/tests/page/views.mjs" "$playwright" "$chromium" "$work" "$root/tests/page/pictures" $update
