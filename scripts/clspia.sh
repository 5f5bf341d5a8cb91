#!/bin/sh
# clspia.sh PIA DATA OUT: the examples of [2023] on real data of the folder DATA, with the command PIA: tables in OUT/tables.md, pictures
# beside them.
# docs/methods/clspia.md shows what it makes in docs/methods/clspia.
set -eu
pia=$1 data=$2 out=$3 here=$(dirname "$0")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$out"
tables=$out/tables.md

# fit MODEL POINTS OPTION...: also MODEL.csv, its trace, and MODEL.report.json.
fit() {
    model=$work/$1 points=$2
    shift 2
    "$pia" fit "$points" "$@" --trace "$model.csv" --json --quiet -o "$model.json" >"$model.report.json"
}

# draw PICTURE MODEL [POINTS] OPTION...
draw() {
    picture=$out/$1 model=$work/$2.json
    shift 2
    "$pia" plot "$model" "$@" --quiet --no-knots -o "$picture" >"$work/plot"
}

# at ITERATION COLUMN NAME: a figure of the trace; of its last row where it is shorter.
at() {
    awk -F , -v at="$1" -v column="$2" 'NR > 1 { value = $column; if ($1 == at) exit } END { printf "%.2e", value }' "$work/$3.csv"
}

# told KEY NAME: a number of the report; short KEY NAME: three digits of it.
told() {
    tr ',{}' '[\n*]' <"$work/$2.report.json" | sed -n "s/^ *\"$1\": *//p" | head -1
}
short() {
    told "$1" "$2" | awk '{ printf "%.3g", $1 }'
}

# Figs. 8 and 14, Table 1: six curves and two surfaces, the largest of the constraints' errors.
{
    echo '## Errors of the constraints against iterations'
    echo
    echo '| data | points | control points | met | recipe: 1 | 10 | 50 | 100 | iterations to 1e-10 | `clspia` | `clspia-pcg` |'
    echo '| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |'
} >"$tables"
number=0
: >"$work/curve.traces"
: >"$work/surface.traces"
while read -r kind file options; do
    number=$((number + 1))
    name=$kind$number
    # shellcheck disable=SC2086
    {
        fit "${name}_recipe" "$data/$file" $options --method clspia --method-option recipe=paper --stop-gradient 1e-10 --iterations 100000
        fit "${name}_clspia" "$data/$file" $options --method clspia --stop-gradient 1e-10 --iterations 100000
        fit "${name}_pcg" "$data/$file" $options --method clspia-pcg --stop-gradient 1e-10
    }
    file=$(basename "$file")
    echo "${file%.*}=$work/${name}_recipe.csv" >>"$work/$kind.traces"
    every=${options##*every:}
    points=$(told point_count "${name}_pcg")
    echo "| $file | $points | $(told control_count "${name}_pcg") | $(((points + every - 1) / every)) |" \
        "$(at 1 6 "${name}_recipe") | $(at 10 6 "${name}_recipe") | $(at 50 6 "${name}_recipe") | $(at 100 6 "${name}_recipe") |" \
        "$(told iterations "${name}_recipe") | $(told iterations "${name}_clspia") | $(told iterations "${name}_pcg") |" >>"$tables"
done <<END
curve airfoil/sc20714.dat --control 30 --interpolate every:20
curve airfoil/rae2822.dat --control 25 --interpolate every:16
curve series/ecg208_30s.csv --fit-function --control 300 --interpolate every:270
curve coast/greatbritain_wdb2.csv --closed --control 200 --interpolate every:600
curve glyph/dejavuserif_S_scan269.csv --columns x,y --closed --control 40 --interpolate every:27
curve curve3d/tum_fr2_desk.csv --control 150 --interpolate every:700
surface scan/owl_face_101x101.csv --grid 101x101 --control 13,13 --interpolate every:171
surface scan/blackvase_61x205.csv --grid 61x205 --closed=v --control 35,30 --interpolate every:209
END
for kind in curve surface; do
    # shellcheck disable=SC2046
    awk -v column=6 -v heading='largest error of the constraints, recipe=paper' -f "$here/chart.awk" $(cat "$work/$kind.traces") >"$out/errors-${kind}s.svg"
done

# Figs. 12 and 13: the two surfaces, beside their points.
draw surface-1.png surface7_pcg "$data/scan/owl_face_101x101.csv" --grid 101x101 --no-control --size 640x560
draw surface-2.png surface8_pcg "$data/scan/blackvase_61x205.csv" --grid 61x205 --no-control --size 640x560

# Fig. 10: control points, then constraints added progressively.
outline=$data/coast/contour_volcano_150m.csv
{
    echo
    echo '## Control points and constraints added progressively'
    echo
    echo '| control points | points met | largest error | RMS error | error of the constraints |'
    echo '| ---: | ---: | ---: | ---: | ---: |'
} >>"$tables"
for pair in 18:16 26:16 40:16 40:47 40:8; do
    control=${pair%:*} every=${pair#*:}
    met=$(((184 + every - 1) / every)) name=p${control}_$every
    fit "$name" "$outline" --closed --control "$control" --interpolate "every:$every"
    draw "progressive-$control-$met.png" "$name" "$outline" --no-deviation --size 420x420 --title "$control control points, $met met"
    echo "| $control | $met | $(short max_error "$name") | $(short rms_error "$name") | $(short constraint_error "$name") |" >>"$tables"
done

# Fig. 11: LSPIA beside CLSPIA, on the foil's edges.
foil=$data/airfoil/sc20714.dat
{
    echo
    echo '## LSPIA beside CLSPIA'
    echo
    echo '| method | largest error | RMS error | largest error at the points met |'
    echo '| --- | ---: | ---: | ---: |'
} >>"$tables"
fit lspia "$foil" --control 24 --method lspia
fit clspia "$foil" --control 24 --method clspia-pcg --interpolate every:34
for name in lspia clspia; do
    "$pia" check "$work/$name.json" "$foil" -o "$work/$name.deviations.csv" >"$work/check"
    kept=$(awk '(NR - 1) % 34 == 0 && $1 > most { most = $1 } END { printf "%.2e", most }' "$work/$name.deviations.csv")
    echo "| \`$name\` | $(short max_error $name) | $(short rms_error $name) | $kept |" >>"$tables"
    draw "foil-$name.png" $name "$foil" --size 700x300 --title "$name"
done

# Fig. 15: 10,001 points, 40 of them met.
awk 'BEGIN { for (i = 0; i <= 10000; i++) { a = 6.283185307179586 * i / 10000; r = 1 + 0.3 * cos(5 * a) + 0.1 * sin(13 * a) + 0.02 * cos(47 * a)
    printf "%.17g,%.17g\n", r * cos(a), r * sin(a) } }' >"$work/flower.txt"
fit flower "$work/flower.txt" --closed --control 300 --interpolate every:250 --method clspia-pcg
{
    echo
    echo '## Many points'
    echo
    echo "10,001 points, 300 control points, 40 points met: $(told iterations flower) iterations of \`clspia-pcg\`, largest error" \
        "$(short max_error flower), error of the constraints $(short constraint_error flower)."
} >>"$tables"
draw flower.png flower "$work/flower.txt" --no-control --no-deviation --size 460x460

# Fig. 17: before and after the shape limiter.
{
    echo
    echo '## Shape kept'
    echo
    echo '| limiter | largest error | RMS error | inflections |'
    echo '| --- | ---: | ---: | --- |'
} >>"$tables"
for shape in none inflection-paper inflection; do
    fit "shape-$shape" "$foil" --control 20 --method lspia --shape $shape --iterations 400
    draw "shape-$shape.png" "shape-$shape" "$foil" --no-deviation --size 700x300 --title "--shape $shape"
    told=$(sed -n 's/.*"inflections: \([^"]*\)".*/\1/p' "$work/shape-$shape.report.json")
    echo "| \`$shape\` | $(short max_error "shape-$shape") | $(short rms_error "shape-$shape") | $told |" >>"$tables"
done
