# Completion of muster's command line for bash.

# The keys that a scenario may set; those of lists and formations depend on the file.
_muster_keys='allocation body duration formation motion.k motion.k_theta motion.law motion.omega_max
    motion.v_max name network.delay network.loss network.range trajectory.omega trajectory.v'

_muster_options() {
    case $1 in
    sim) echo '--robots --firmware --out --seed --threads --set --no-trace --real-time --check --quiet --help' ;;
    paper) echo '--out --only --robots --firmware --scenarios --threads --quiet --help' ;;
    eeprom) echo '--id --out --help' ;;
    esac
}

_muster() {
    local command=${COMP_WORDS[1]} word=${COMP_WORDS[COMP_CWORD]} option=${COMP_WORDS[COMP_CWORD - 1]}
    COMPREPLY=()

    if [ "$COMP_CWORD" -eq 1 ]; then
        mapfile -t COMPREPLY < <(compgen -W 'sim paper eeprom --help --version' -- "$word")
        return
    fi
    # readline splits --option=value at the equals sign.
    if [ "$option" = = ]; then
        option=${COMP_WORDS[COMP_CWORD - 2]}
    elif [ "$word" = = ]; then
        word=
    fi
    case $option in
    --robots) mapfile -t COMPREPLY < <(compgen -W 'avr native' -- "$word") ;;
    --set)
        compopt -o nospace
        mapfile -t COMPREPLY < <(compgen -S = -W "$_muster_keys" -- "$word")
        ;;
    --firmware) mapfile -t COMPREPLY < <(compgen -f -X '!*.elf' -- "$word"; compgen -d -- "$word") ;;
    --only) mapfile -t COMPREPLY < <(compgen -W '1 5 6 7 8 9 10 11 14 15 16 17 18 19' -- "$word") ;;
    --scenarios) mapfile -t COMPREPLY < <(compgen -d -- "$word") ;;
    --out)
        if [ "$command" = eeprom ]; then
            mapfile -t COMPREPLY < <(compgen -f -- "$word")
        else
            mapfile -t COMPREPLY < <(compgen -d -- "$word")
        fi
        ;;
    --seed | --threads | --id) ;;
    *)
        case $word in
        -*) mapfile -t COMPREPLY < <(compgen -W "$(_muster_options "$command")" -- "$word") ;;
        *)
            [ "$command" = sim ] || return
            compopt -o filenames
            mapfile -t COMPREPLY < <(compgen -f -X '!*.yaml' -- "$word"; compgen -d -- "$word")
            ;;
        esac
        ;;
    esac
}

complete -F _muster muster
