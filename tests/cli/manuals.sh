#!/bin/sh
# manuals.sh PIA FOLDER: every option that `pia COMMAND --help` shows stands in the manual page of the command, and no other one does.
set -eu
pia=$1 folder=$2
failed=0
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
options() { grep -oE -e '(^|[^-[:alnum:]])--[a-z][a-z-]*' | grep -oE -e '--[a-z-]*' | sort -u; }
for command in fit eval check info convert plot list; do
    page=$folder/pia-$command.1.scd
    "$pia" "$command" --help | grep -E '^ +(-., )?--' | sed 's/^\( *\(-., \)\{0,1\}--[a-z-]*\).*/\1/' | options >"$work/help"
    sed -n '/^# OPTIONS/,/^# EXAMPLES/p' "$page" | grep -E '^\*-' | options >"$work/page"
    [ -s "$work/help" ] || { echo "pia $command --help shows no options"; failed=1; }
    diff "$work/help" "$work/page" || { echo "pia $command --help (<) and $page (>) differ"; failed=1; }
done
"$pia" --help | awk '/^  [a-z]+ / && $1 != "pia" { print $1 }' | while read -r command; do
    grep -q "pia-$command\|pia $command\|\*help\*" "$folder/pia.1.scd" || { echo "pia.1.scd does not name $command"; exit 1; }
done
exit $failed
