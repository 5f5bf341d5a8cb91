#!/bin/sh
# vectors_in_line.sh ROOT: a function that takes or returns a vector becomes part of its callers. A version for newer processors hands
# it over in a register where the portable one uses memory, so that a call between the two would read something else.
set -eu
cd "$1"
vector='(pia_lanes|pia_lane_masks|lanes|masks)'
! grep -rnE "^[A-Z_]*[a-z ]*(static |inline )?$vector [a-z_]+\(|^[A-Za-z_].*[(,] ?(const )?$vector [a-z_]+[,)]" src --include='*.[ch]' |
    grep -vE 'PIA_INLINE|:typedef '
