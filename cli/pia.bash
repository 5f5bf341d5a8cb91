# Completion of pia for bash. Options and names come from the program itself, so that they are those of the installed version.

_pia_names() {
    pia list "$1" 2>/dev/null | sed -n 's/^  \([a-z][^ ]*\) .*/\1/p'
}

_pia() {
    local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]} command=${COMP_WORDS[1]} words=
    COMPREPLY=()
    if ((COMP_CWORD == 1)); then
        words="fit eval check info convert plot list help --help --version"
    else
        case $previous in
        --method) words=$(_pia_names methods) ;;
        --param) words=$(_pia_names params) ;;
        --knots) words=$(_pia_names placements) ;;
        --shape) words=$(_pia_names limiters) ;;
        --backend) words=$(_pia_names backends) ;;
        --*format) words=$(_pia_names formats) ;;
        --measure) words="parametric distance" ;;
        --robust) words="huber tukey" ;;
        --corners) words="auto none" ;;
        *)
            case $command:$current in
            help:*) words="fit eval check info convert plot list" ;;
            list:[!-]* | list:) words="methods params placements limiters formats backends parts" ;;
            *:-*) words=$(pia "$command" --help 2>/dev/null | grep -oE -e '^ +(-., )?--[a-z-]+' | grep -oE -e '--[a-z-]+') ;;
            esac
            ;;
        esac
    fi
    mapfile -t COMPREPLY < <(compgen -W "$words" -- "$current")
    if [[ -z $words || $previous == --param || $previous == --knots ]]; then
        mapfile -t -O ${#COMPREPLY[@]} COMPREPLY < <(compgen -f -- "$current")
    fi
}

complete -o filenames -F _pia pia
