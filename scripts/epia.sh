#!/bin/sh
# epia.sh PIA OUT: the examples of [2011] anew, with the command PIA: tables in OUT/tables.md, pictures beside them. docs/methods/epia.md
# shows what it makes in docs/methods/epia.
set -eu
pia=$1 out=$2 here=$(dirname "$0")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$out"
tables=$out/tables.md

# fit MODEL POINTS OPTION...: also MODEL.trace.csv and MODEL.report.json; a tolerance that is not reached (status 1) is no failure here.
fit() {
    model=$work/$1 points=$2
    shift 2
    "$pia" fit "$points" "$@" --trace "$model.trace.csv" --json --quiet -o "$model.json" >"$model.report.json" || [ $? = 1 ]
}

# draw PICTURE MODEL [POINTS] OPTION...
draw() {
    picture=$out/$1 model=$work/$2.json
    shift 2
    "$pia" plot "$model" "$@" --quiet --no-knots --no-deviation -o "$picture" >"$work/plot"
}

# row ITERATION NAME: the trace's row of an iteration, "end" for the last, as a row of a table.
row() {
    awk -F , -v at="$1" 'NR > 1 { last = $0; if ($1 == at) { found = $0 } }
        END { split(found != "" ? found : last, f, ","); printf "| %d | %d | %.6f |", f[1], f[2], f[3] }' "$work/$2.trace.csv"
}

# Fig. 2: 43 points, 13 control points, one point to be met.
awk 'BEGIN { for (i = 0; i < 43; i++) { a = 6.283185307179586 * (0.08 + 0.84 * i / 42); r = 1 + 0.28 * cos(3 * a) + 0.1 * sin(5 * a)
    printf "%.17g,%.17g\n", r * cos(a), r * sin(a) } }' >"$work/points"
awk -v box="1.5786 6.3836 1.0252 8.8742" -f "$here/box.awk" "$work/points" "$work/points" >"$work/fig2.csv"
for steps in 0 10; do
    fit "met$steps" "$work/fig2.csv" --method epia --control 13 --interpolate 20 --iterations "$steps" --stop-change 0
    draw "met-$steps.png" "met$steps" "$work/fig2.csv" --size 420x640 --title "$steps iterations"
done
{
    echo '## One point met'
    echo
    echo '| iteration | error of the point | largest error |'
    echo '| ---: | ---: | ---: |'
    awk -F , 'NR > 1 { printf "| %d | %.4f | %.4f |\n", $1, $6, $3 }' "$work/met10.trace.csv"
} >"$tables"

# Figs. 3 and 4, Table 1: the outline of a letter in the paper's box.
awk -F , '$1 == "0" { print $2 "," $3 }' "$here/../data/glyph/dejavuserif_g_outline.csv" >"$work/points"
awk -v box="0.1313 0.9454 0.0786 0.9172" -f "$here/box.awk" "$work/points" "$work/points" >"$work/g.csv"
{
    echo
    echo '## A letter'
    echo
    echo '| eta | fence | dominant | iteration | control points | e_d |'
    echo '| ---: | --- | ---: | ---: | ---: | ---: |'
} >>"$tables"
for share in 0 0.03; do
    for fence in printed balanced; do
        for eta in 0.6 0.9; do
            fit letter "$work/g.csv" --method epia --tolerance 0.0035 --method-option eta=$eta --method-option fence=$fence \
                --method-option dominant=$share
            for at in 0 15 50 end; do echo "| $eta | $fence | $share $(row $at letter)"; done >>"$tables"
        done
    done
done
for eta in 0.6 0.9; do
    for steps in 0 15 50 10000; do
        fit "g$steps" "$work/g.csv" --method epia --tolerance 0.0035 --method-option eta=$eta --method-option dominant=0 --iterations $steps
        end=$([ $steps = 10000 ] && echo end || echo $steps)
        title=$(awk -F , 'END { print $1 " iterations, " $2 " control points" }' "$work/g$steps.trace.csv")
        draw "g-$eta-$end.png" "g$steps" "$work/g.csv" --size 460x480 --title "eta $eta, $title"
    done
done

# Fig. 6, Table 2: a patch, beside the dominant columns of Park.
awk -v box="0.0129 0.6164 0.0048 0.6983 0.0382 0.9587" -f "$here/box.awk" "$here/../data/dem/jacksboro_121x161.csv" \
    "$here/../data/dem/jacksboro_121x161.csv" >"$work/patch.csv"
{
    echo
    echo '## A patch'
    echo
    echo '| tolerance | method | first control points | first e_d | iterations | control points | e_d | seconds |'
    echo '| ---: | --- | ---: | ---: | ---: | ---: | ---: | ---: |'
} >>"$tables"
# patch NAME TOLERANCE WORDS OPTION...: a row of the table, and the sizes of both nets.
patch() {
    name=$1 tolerance=$2 words=$3
    shift 3
    fit first "$work/patch.csv" --grid 121x161 --tolerance "$tolerance" "$@" --iterations 0
    fit "$name" "$work/patch.csv" --grid 121x161 --tolerance "$tolerance" "$@" --iterations 100
    net() { tr -d ' \n' <"$work/$1.json" | sed 's/.*"size_u":\([0-9]*\),"size_v":\([0-9]*\).*/\1 x \2/'; }
    seconds=$(tr ',{}' '[\n*]' <"$work/$name.report.json" | sed -n 's/^ *"fit": *//p')
    awk -F , -v tolerance="$tolerance" -v words="$words" -v first="$(net first)" -v last="$(net "$name")" -v seconds="$seconds" '
        NR == 2 { start = $3 } END { printf "| %s | %s | %s | %.6f | %d | %s | %.6f | %.3f |\n", tolerance, words, first, start, $1, last, $3, seconds }
    ' "$work/$name.trace.csv" >>"$tables"
}
# pictures NAME: the patch and its stripes of reflected light.
pictures() {
    draw "patch-$1.png" "$1" --no-control --size 640x560
    [ "$1" = first ] && return
    "$pia" eval "$work/$1.json" --samples 1300,1300 --derivative 1 --quiet -o "$work/samples.npy"
    /usr/bin/python3 "$here/zebra.py" "$work/samples.npy" 1300 1300 "$out/zebra-$1.png"
}
for tolerance in 0.0025 0.02; do
    patch epia $tolerance EPIA --method epia
    [ $tolerance = 0.02 ] || { draw patch-epia-0.png first --no-control --size 640x560; pictures epia; }
    patch park $tolerance 'dominant columns' --knots dominant-columns
    [ $tolerance = 0.02 ] || { draw patch-park-0.png first --no-control --size 640x560; pictures park; }
done
