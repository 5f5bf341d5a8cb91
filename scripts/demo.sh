#!/bin/sh
# demo.sh PIA OUT: fits real data with the command PIA, draws into OUT, and says what came of it.
set -eu
pia=$1 out=$2
mkdir -p "$out"
rm -f "$out"/*
pictures=

# value KEY FILE: a number or a word of a JSON object.
value() {
    tr ',{}' '[\n*]' <"$2" | sed -n "s/^ *\"$1\": *//p" | tr -d '"' | head -n 1
}

# show NAME POINTS OPTION...: fits, draws data with model and history, and adds a row to the table. A tolerance that was not reached
# (status 1) is in the table for all to see.
show() {
    name=$1 points=$2
    shift 2
    status=0
    "$pia" fit "$points" "$@" -o "$out/$name.json" --trace "$out/$name.trace.csv" --json >"$out/$name.report.json" || status=$?
    [ "$status" -le 1 ] || exit "$status"
    picture=$out/$name.png
    "$pia" plot "$out/$name.json" "$points" -o "$picture"
    pictures="$pictures $picture"
    before=$(awk -F , 'NR == 2 { print $3 }' "$out/$name.trace.csv")
    report=$out/$name.report.json
    printf '%-10s %-8s %8s %8s %6s %11.4g %11.4g %9.3f\n' "$name" "$(value method "$report")" "$(value point_count "$report")" \
        "$(value control_count "$report")" "$(value iterations "$report")" "$before" "$(value max_error "$report")" "$(value fit "$report")"
}

printf '%-10s %-8s %8s %8s %6s %11s %11s %9s\n' data method points control steps before after seconds
show airfoil data/airfoil/rae2822.dat --method pia --tolerance 1e-6
show coast data/coast/greatbritain_wdb2.csv --closed --method pia --tolerance 1e-4
show terrain data/dem/jacksboro_121x161.csv --grid 121x161 --method pia --tolerance 1
show peaks data/surface/peaks11.csv --grid 11x11 --method pia --iterations 30
echo
echo 'pictures, with the largest error before and after in the units of the points above:'
for picture in $pictures; do
    echo "  $picture"
done
