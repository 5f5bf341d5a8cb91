#!/bin/sh
# exports.sh PACKAGE HEADER: the shared library exports the functions that the header declares, all of them and nothing else.
set -eu
package=$1 header=$2
gcc -E -P "$header" | grep -o 'pia_[a-z0-9_]*(' | tr -d '(' | sort -u >"$package/declared"
nm -D --defined-only "$(find "$package/moved" -name libpia.so)" | awk '{ print $3 }' | sort >"$package/exported"
echo "$(wc -l <"$package/exported") functions"
diff "$package/declared" "$package/exported"
