# completion.bash PIA SCRIPT: what the completion offers for beginnings of command lines.
PATH=$(dirname "$1"):$PATH
# shellcheck source=/dev/null
source "$2"
failed=0

# offers WORD... -- WANTED...: completing the last WORD offers all of WANTED.
offers() {
    COMP_WORDS=()
    while [[ $1 != -- ]]; do
        COMP_WORDS+=("$1")
        shift
    done
    shift
    COMP_CWORD=$((${#COMP_WORDS[@]} - 1))
    _pia
    for wanted; do
        [[ " ${COMPREPLY[*]} " == *" $wanted "* ]] || {
            echo "${COMP_WORDS[*]}: $wanted is not among ${COMPREPLY[*]}"
            failed=1
        }
    done
}

offers pia '' -- fit eval check info convert plot list help
offers pia c -- check convert
offers pia fit --to -- --tolerance
offers pia fit --method p -- pia
offers pia fit --param ch -- chord
offers pia check --f -- --foot-points --format
offers pia list m -- methods
offers pia help '' -- fit plot
# Every option of every command's help is offered, and nothing else.
for command in fit eval check info convert plot list; do
    COMP_WORDS=(pia "$command" --) COMP_CWORD=2
    _pia
    diff <(pia "$command" --help | sed -nE 's/^ +(-., )?(--[a-z][a-z-]*).*/\2/p' | sort -u) <(printf '%s\n' "${COMPREPLY[@]}" | sort -u) || {
        echo "pia $command: options of the help (<) and of the completion (>) differ"
        failed=1
    }
done
cd "$(dirname "$2")" && offers pia fit pia.b -- pia.bash
exit $failed
