#!/bin/sh
# run.sh CASE PIA JSON ROOT: runs the commands of a case in a new folder and compares what they print.
#
#   # a remark
#   $ pia fit data/nasty/one_point.csv      a command; PATH has pia and json, data/ is the data of the project
#   text                                    a line it prints on standard output; * stands for anything
#   ! pia: *: too few*                      a line it prints on standard error
#   ...                                     whatever else it prints there (also: ! ...)
#   ? 3                                     its exit status; 0 when nothing is said
#
# Empty lines are passed over, here and in what is printed.
set -u
case=$1 root=$4
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir "$work/bin" "$work/here"
ln -s "$2" "$work/bin/pia"
ln -s "$3" "$work/bin/json"
ln -s "$root/data" "$work/here/data"
PATH=$work/bin:$PATH
# Fonts are cached by the system's library until the program ends.
LSAN_OPTIONS=suppressions=$root/tests/cli/lsan.txt:print_suppressions=0
export PATH LSAN_OPTIONS
cd "$work/here" || exit 2
failed=0

# matches WANTED PRINTED
matches() {
    exec 3<"$1" 4<"$2"
    while IFS= read -r wanted <&3; do
        [ "$wanted" = ... ] && return 0
        IFS= read -r printed <&4 || [ -n "$printed" ] || return 1
        pattern=$(printf '%s\n' "$wanted" | sed 's/[][?\\]/\\&/g')
        # shellcheck disable=SC2254
        case $printed in $pattern) ;; *) return 1 ;; esac
    done
    ! IFS= read -r printed <&4 && [ -z "$printed" ]
}

complain() {
    failed=1
    echo "$case: \$ $command"
    echo "  $1; it printed, and told on standard error:"
    sed 's/^/  | /' "$work/printed"
    sed 's/^/  ! /' "$work/told"
}

run() {
    [ -n "$command" ] || return 0
    sh -c "$command" >"$work/printed" 2>"$work/told" </dev/null
    status=$?
    sed -i '/^$/d' "$work/printed" "$work/told"
    if [ "$status" != "$wanted_status" ]; then
        complain "exit status $status instead of $wanted_status"
    elif ! matches "$work/wanted" "$work/printed"; then
        complain "standard output is not as wanted"
    elif ! matches "$work/wanted_told" "$work/told"; then
        complain "standard error is not as wanted"
    fi
}

begin() {
    command=$1 wanted_status=0
    : >"$work/wanted"
    : >"$work/wanted_told"
}

begin ''
while IFS= read -r line; do
    case $line in
    '$ '*) run; begin "${line#'$ '}" ;;
    '! '*) printf '%s\n' "${line#'! '}" >>"$work/wanted_told" ;;
    '? '*) wanted_status=${line#'? '} ;;
    '# '* | '') ;;
    *) printf '%s\n' "$line" >>"$work/wanted" ;;
    esac
done <"$case"
run
exit $failed
