#!/bin/sh
# bench.sh BUILD: runs every measuring program of BUILD/bench, then every comparison bench/*.py, which may start them.
set -eu
build=$1
for program in "$build"/bench/bench_*; do
    [ -x "$program" ] || continue
    printf '\n-- %s\n' "${program##*/}"
    "$program"
done
for comparison in bench/*.py; do
    [ -f "$comparison" ] || continue
    printf '\n-- %s\n' "${comparison##*/}"
    /usr/bin/python3 "$comparison" "$build"
done
