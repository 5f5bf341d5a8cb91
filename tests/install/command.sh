#!/bin/sh
# command.sh PACKAGE VERSION: the installed command finds its library after the move.
set -eu
"$1/moved/bin/pia" --version | grep -F "$2"
