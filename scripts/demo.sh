#!/bin/sh
# demo.sh PIA OUT: fits real data with the command PIA, draws into OUT, and says what came of it.
set -eu
pia=$1 out=$2
mkdir -p "$out"
rm -f "$out"/*
pictures=''

# value KEY FILE: a number or a word of a JSON object.
value() {
    tr ',{}' '[\n*]' <"$2" | sed -n "s/^ *\"$1\": *//p" | tr -d '"' | head -n 1
}

# show NAME TITLE POINTS OPTION...: fits, draws data with model and history, and adds a row to the table. A tolerance that was not
# reached (status 1) is in the table for all to see.
show() {
    name=$1 title=$2 points=$3
    shift 3
    model=$out/$name.json report=$out/$name.report.json trace=$out/$name.trace.csv
    status=0
    "$pia" fit "$points" "$@" --quiet -o "$model" --trace "$trace" --json >"$report" || status=$?
    [ "$status" -le 1 ] || exit "$status"
    "$pia" plot "$model" "$points" --quiet --title "$title" --trace "$trace" -o "$out/$name.png" -o "$out/$name.pdf" >/dev/null
    pictures="$pictures $out/$name.png $out/$name.pdf"
    printf '%-8s %-8s %7s %9s %11s %13.4g %13.4g %9.3f\n' "$name" "$(value method "$report")" "$(value point_count "$report")" \
        "$(value control_count "$report")" "$(value iterations "$report")" "$(awk -F , 'NR == 2 { print $3 }' "$trace")" \
        "$(value max_error "$report")" "$(value fit "$report")"
}

printf '%-8s %-8s %7s %9s %11s %13s %13s %9s\n' data method points 'control' iterations 'error before' 'error after' seconds
show airfoil 'RAE 2822 airfoil' data/airfoil/rae2822.dat --method pia --tolerance 1e-6
show coast 'Coast of Great Britain' data/coast/greatbritain_wdb2.csv --closed --method pia --tolerance 1e-4
show terrain 'Jacksboro fault, Tennessee' data/dem/jacksboro_121x161.csv --grid 121x161 --method pia --tolerance 1
show peaks 'peaks(11), 30 iterations' data/surface/peaks11.csv --grid 11x11 --method pia --iterations 30
printf '\nErrors are the largest distances at the parameters, in the units of the points. Pictures:\n'
for picture in $pictures; do
    echo "  $picture"
done
