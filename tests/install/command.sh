#!/bin/sh
# command.sh PACKAGE VERSION: the installed command finds its library after the move, and its plug-in where there is one.
set -eu
"$1/moved/bin/pia" --version | grep -F "$2"
plugin=$(find "$1/moved" -name pia-occt)
"$1/moved/bin/pia" list parts | grep -A1 '^  occt' | grep -q "$([ -n "$plugin" ] && echo 'in this build' || echo 'not in this build')"
