#!/bin/sh
# tolerance.sh PIA OUT: how the fewest control points are found, with the command PIA: pictures in OUT. docs/methods/tolerance.md shows what
# it makes in docs/methods/tolerance.
set -eu
pia=$1 out=$2 here=$(dirname "$0")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$out"

# fit NAME POINTS OPTION...: MODEL.json and its trace; stopped early it does not reach the tolerance (status 1).
fit() {
    model=$work/$1 points=$2
    shift 2
    "$pia" fit "$points" "$@" --trace "$model.csv" --quiet -o "$model.json" >"$work/said" || [ $? = 1 ]
}

# A letter, closed, while knots are found: iterations 1, 3, the last of growing, and the end.
awk -F , '$1 == "0" { print $2 "," $3 }' "$here/../data/glyph/dejavuserif_g_outline.csv" >"$work/g.csv"
for steps in 1 3 5 1000; do
    fit letter "$work/g.csv" --closed --tolerance 2 --iterations $steps
    name=$([ $steps = 1000 ] && echo end || echo $steps)
    title=$(awk -F , 'END { printf "iteration %d: %d control points, error %.3g", $1, $2, $3 }' "$work/letter.csv")
    "$pia" plot "$work/letter.json" "$work/g.csv" --quiet --size 460x480 --no-deviation --title "$title" -o "$out/letter-$name.png" >"$work/said"
done

# Largest error over control points, an iteration a dot, in tolerances: right and down while knots are added, left while they are spared.
fit a_letter "$work/g.csv" --closed --tolerance 2
fit an_airfoil "$here/../data/airfoil/rae2822.dat" --tolerance 1e-4
fit a_coast "$here/../data/coast/greatbritain_wdb2.csv" --closed --tolerance 0.01
fit a_terrain "$here/../data/dem/jacksboro_121x161.csv" --grid 121x161 --tolerance 10
awk -f "$here/paths.awk" "a letter=2=$work/a_letter.csv" "an airfoil=1e-4=$work/an_airfoil.csv" "a coast=0.01=$work/a_coast.csv" \
    "terrain=10=$work/a_terrain.csv" >"$out/paths.svg"
