#!/bin/sh
# exports.sh PACKAGE HEADER: the shared library exports functions that the header declares, and nothing else.
set -eu
package=$1 header=$2
gcc -E -P "$header" | grep -o 'pia_[a-z0-9_]*(' | tr -d '(' | sort -u >"$package/declared"
nm -D --defined-only "$(find "$package/moved" -name libpia.so)" | awk '{ print $3 }' | sort >"$package/exported"
echo "$(wc -l <"$package/exported") functions of $(wc -l <"$package/declared")"
[ -s "$package/exported" ]
undeclared=$(comm -13 "$package/declared" "$package/exported")
[ -z "$undeclared" ] || { echo "exported, but not declared: $undeclared"; exit 1; }
