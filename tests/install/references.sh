#!/bin/sh
# references.sh ROOT: every paper that a record names is in docs/refs.bib.
set -eu
cd "$1"
status=0
for key in $(grep -rhoE '\.reference = "[^"]+"' src | cut -d '"' -f 2 | sort -u); do
    grep -q "^@[a-z]*{$key,$" docs/refs.bib || { echo "docs/refs.bib has no $key"; status=1; }
done
exit $status
