# Completion of muster's command line for bash.

# The keys that a scenario may set; those of lists and formations depend on the file.
_muster_keys='allocation body duration formation motion.k motion.k_theta motion.law motion.omega_max
    motion.v_max name network.delay network.loss network.range scatter trajectory.omega
    trajectory.v'

# The same of a site; those of its robots depend on the file.
_muster_site_keys='battery fence latency mocap.data_port mocap.file mocap.group mocap.interface
    mocap.jump mocap.latency mocap.port mocap.protocol mocap.repeat mocap.scale mocap.server
    mocap.unicast mocap.up mocap.version name network.delay network.loss network.range patience poses
    scenario separation wheels.max wheels.track'

_muster_options() {
    case $1 in
    arena) echo '--rate --interface --port --data-port --group --unicast --version --robots-port --up --quiet --help' ;;
    calibrate) echo '--robots --together --dry-run --out --by-hand --sim --native --firmware --seed --threads --set --quiet --help' ;;
    capture) echo '--out --seconds --set --quiet --help' ;;
    check) echo '--scenario --seconds --set --quiet --help' ;;
    doctor) echo '--seconds --robots --set --quiet --help' ;;
    flash) echo '--firmware --robots --again --force --set --quiet --help' ;;
    id) echo '--first --baud --force --robots --set --quiet --help' ;;
    param) echo '--from --out --save --robots --set --quiet --help' ;;
    plot | report) echo '--out --quiet --help' ;;
    recover) echo '--out --help' ;;
    replay) echo '--view --help' ;;
    robot) echo '--id --blank --link --robots --firmware --loader --arena --quiet --help' ;;
    serve) echo '--scenario --out --seed --set --no-trace --view --check --quiet --help' ;;
    sim) echo '--robots --firmware --parameters --out --seed --threads --set --no-trace --real-time --speed --view --check --quiet --help' ;;
    video) echo '--out --speed --from --to --width --help' ;;
    paper) echo '--out --only --robots --firmware --scenarios --threads --quiet --help' ;;
    eeprom) echo '--id --out --help' ;;
    esac
}

# Files but those of the pattern, and folders, that begin with $word.
_muster_files() {
    compopt -o filenames
    mapfile -t COMPREPLY < <(compgen -f -X "$1" -- "$word"; compgen -d -- "$word")
}

_muster() {
    local command=${COMP_WORDS[1]} word=${COMP_WORDS[COMP_CWORD]} option=${COMP_WORDS[COMP_CWORD - 1]}
    COMPREPLY=()

    if [ "$COMP_CWORD" -eq 1 ]; then
        mapfile -t COMPREPLY < <(compgen -W 'serve check id param calibrate doctor flash capture robot arena sim replay plot report video recover paper eeprom --help --version' -- "$word")
        return
    fi
    # readline splits --option=value at the equals sign.
    if [ "$option" = = ]; then
        option=${COMP_WORDS[COMP_CWORD - 2]}
    elif [ "$word" = = ]; then
        word=
    fi
    case $option in
    --robots)
        case $command in
        paper | robot | sim) mapfile -t COMPREPLY < <(compgen -W 'avr native' -- "$word") ;;
        esac
        ;;
    --set)
        compopt -o nospace
        case $command in
        sim) mapfile -t COMPREPLY < <(compgen -S = -W "$_muster_keys" -- "$word") ;;
        *) mapfile -t COMPREPLY < <(compgen -S = -W "$_muster_site_keys" -- "$word") ;;
        esac
        ;;
    --firmware | --loader) _muster_files '!*.elf' ;;
    --only) mapfile -t COMPREPLY < <(compgen -W '1 5 6 7 8 9 10 11 14 15 16 17 18 19' -- "$word") ;;
    --link)
        compopt -o nospace
        mapfile -t COMPREPLY < <(compgen -W 'pty: rfcomm tcp:' -- "$word")
        ;;
    --speed)
        case $command in
        sim) mapfile -t COMPREPLY < <(compgen -W 'max' -- "$word") ;;
        esac
        ;;
    --up) mapfile -t COMPREPLY < <(compgen -W 'y z' -- "$word") ;;
    --from | --scenario | --parameters)
        case $command in
        video) ;;
        *) _muster_files '!*.yaml' ;;
        esac
        ;;
    --scenarios) mapfile -t COMPREPLY < <(compgen -d -- "$word") ;;
    --out)
        case $command in
        calibrate | capture | eeprom | param | plot | recover | report | video) mapfile -t COMPREPLY < <(compgen -f -- "$word") ;;
        *) mapfile -t COMPREPLY < <(compgen -d -- "$word") ;;
        esac
        ;;
    --baud | --first | --seed | --threads | --id | --seconds | --rate | --interface | --group | --version | --arena | --to | --width | --*port) ;;
    *)
        case $word in
        -*) mapfile -t COMPREPLY < <(compgen -W "$(_muster_options "$command")" -- "$word") ;;
        *)
            case $command in
            arena | calibrate | capture | check | doctor | flash | id | serve | sim) _muster_files '!*.yaml' ;;
            plot | recover | replay | report | video) _muster_files '!*.mcap' ;;
            param)
                if [ "$COMP_CWORD" -eq 2 ]; then
                    mapfile -t COMPREPLY < <(compgen -W 'list get set save reset' -- "$word")
                else
                    _muster_files '!*.yaml'
                fi
                ;;
            esac
            ;;
        esac
        ;;
    esac
}

complete -F _muster muster
