#!/bin/sh
# Stands in for avrdude and the chip behind it. In the folder CHIP: `commands`, the command lines it
# was given; lfuse, hfuse, efuse, lock, flash and eeprom, the chip's memories; `fault`, what is broken.
set -eu

echo "$*" >>"$CHIP/commands"
fault=$(cat "$CHIP/fault" 2>/dev/null || true)

if [ "$fault" = absent ]; then
    echo 'avrdude: program enable: target does not answer' >&2
    exit 1
fi

case $* in
*flash:w:*) rm -f "$CHIP/flash" "$CHIP/lock" ;;
esac
while [ $# -gt 0 ]; do
    option=$1
    shift
    [ "$option" = -U ] || continue
    memory=${1%%:*}
    rest=${1#*:}
    operation=${rest%%:*}
    data=${rest#*:}
    data=${data%:*}
    shift
    case $operation:$memory in
    r:*) cat "$CHIP/$memory" ;;
    w:?fuse) [ "$fault" = fuses_stay ] || echo "$data" >"$CHIP/$memory" ;;
    w:lock) echo "$data" >"$CHIP/lock" ;;
    w:flash | w:eeprom)
        [ "$memory" = flash ] || rm -f "$CHIP/eeprom"
        cat "$data" >>"$CHIP/$memory"
        if [ "$fault" = "bad_$memory" ]; then
            echo "avrdude: verification error, first mismatch at byte 0x0000" >&2
            exit 1
        fi
        ;;
    esac
done
