#!/bin/sh
# read_back.sh READER PIA DATA: fits real data, writes STEP and IGES, reads them by OpenCASCADE and compares points of the geometry with
# `pia eval` of the JSON model: at most 1e-12 of the extent apart, faces valid.
set -eu
reader=$1 pia=$2 data=$3
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
ASAN_OPTIONS=detect_leaks=0
export ASAN_OPTIONS

compare() { # FILE COLUMNS: the numbers of both sides, their largest difference over the largest number
    "$reader" "$folder/$1" 9 2>/dev/null | grep -E '^-?[0-9.]+(e[-+0-9]+)? ' >"$folder/theirs"
    test -s "$folder/theirs"
    paste -d ' ' "$folder/theirs" "$folder/ours" | awk -v columns="$2" '
        { for (i = 1; i <= columns; i++) { d = $i - $(i + NF - columns); if (d < 0) d = -d; if (d > worst) worst = d
            a = $i < 0 ? -$i : $i; if (a > size) size = a } }
        END { if (NR == 0 || worst > 1e-12 * size) { print "off by", worst, "in", NR, "rows of size", size; exit 1 } }'
}

# A 2-D curve has no z in the JSON model: compare the parameter, x and y.
"$pia" fit "$data/airfoil/naca2412.dat" --quiet -o "$folder/c.json" -o "$folder/c.step" -o "$folder/c.igs" >/dev/null
"$pia" eval "$folder/c.json" --samples 9 | tr ',' ' ' >"$folder/flat"
for file in c.step c.igs; do
    awk '{ print $1, $2, $3, 0 }' "$folder/flat" >"$folder/ours"
    compare "$file" 4
done
"$pia" fit "$data/surface/peaks11.csv" --grid 11x11 --quiet -o "$folder/s.json" -o "$folder/s.step" -o "$folder/s.igs" >/dev/null
"$pia" eval "$folder/s.json" --samples 9,9 | tr ',' ' ' >"$folder/ours"
for file in s.step s.igs; do
    compare "$file" 5
    "$reader" "$folder/$file" 2 2>/dev/null | grep -q '^face .* valid$'
done
echo "STEP and IGES read back"
