#!/bin/sh
# unique_names.sh ROOT: a file is named by its last part alone, in messages and in talk.
set -eu
cd "$1"
twice=$(find src cli include -name '*.[ch]' | sed 's|.*/||' | sort | uniq -d)
[ -z "$twice" ] || { echo "more than one file is called: $twice"; exit 1; }
