#!/bin/sh
# program.sh: puts Muster into an ATmega128 through avrdude and an ISP programmer.
#
#   program.sh fuses       sets the fuses of a new chip
#   program.sh flash ID    writes the image, the boot loader, the robot's id into the EEPROM, and the
#                          lock bits
#   program.sh eeprom ID   only the EEPROM: the id, and all other parameters as they are by default
#
# From the environment: PROGRAMMER (avrdude's -c), PORT (-P, for programmers that need one), PART (-p,
# m128 unless given), AVRDUDE_FLAGS (more options for it) and AVRDUDE (which avrdude).
# Exit status: 0 done, 1 failed or refused, 2 wrong usage.
set -eu

# The fuses, from the tables "Extended, High, Low Fuse Byte" of the data sheet; 0 = programmed.
#
# lfuse  BODLEVEL 0, BODEN 0        reset below 4.0 V: 16 MHz is out of specification there
#        SUT 11, CKSEL 1111         crystal; starts 16,384 clocks + 65 ms after power is good
# hfuse  OCDEN 1, JTAGEN 0          as delivered: pins.h leaves JTAG its pins
#        SPIEN 0                    ISP stays possible
#        CKOPT 0                    full swing, for crystals above 8 MHz and near motors
#        EESAVE 0                   id and parameters outlive the chip erase before a flash
#        BOOTSZ 10, BOOTRST 0       starts in the boot loader, whose 1,024 words may write the flash
# efuse  M103C 1                    an ATmega128, not an ATmega103
#        WDTON 1                    the firmware starts the watchdog itself
# lock   BLB1 10                    the loader cannot write over itself; all else is open
lfuse_wanted=0x3f
hfuse_wanted=0x84
efuse_wanted=0xff
lock_wanted=0xef
m103c=0x02
boot_bits=0x07 # BOOTSZ and BOOTRST in hfuse
efuse_bits=0x03 # the others do not exist

root=$(cd "$(dirname "$0")/.." && pwd)

die() {
    status=$1
    shift
    printf 'program.sh: %s\n' "$@" >&2
    exit "$status"
}

chip() {
    # shellcheck disable=SC2086 # AVRDUDE_FLAGS are several words
    "${AVRDUDE:-avrdude}" -p "${PART:-m128}" -c "${PROGRAMMER:-usbasp}" ${PORT:+-P "$PORT"} \
        ${AVRDUDE_FLAGS:-} "$@"
}

read_fuse() {
    value=$(chip -qq -U "$1:r:-:h") || die 1 "cannot read the chip's $1." \
        "Is the robot powered, and are PROGRAMMER and PORT right? A new chip runs at 1 MHz: where" \
        "the programmer does not see to it, slow it down with AVRDUDE_FLAGS='-B 10'."
    case $value in
    0x[0-9a-f] | 0x[0-9a-f][0-9a-f]) echo "$value" ;;
    *) die 1 "the chip's $1 should be a byte, and avrdude says '$value'." ;;
    esac
}

# Do the bits of the mask (default: all) agree?
same() {
    [ $((($1 ^ $2) & ${3:-0xff})) -eq 0 ]
}

set_fuses() {
    lfuse=$(read_fuse lfuse)
    hfuse=$(read_fuse hfuse)
    efuse=$(read_fuse efuse)
    printf '%s %s -> %s\n' lfuse "$lfuse" "$lfuse_wanted" hfuse "$hfuse" "$hfuse_wanted" \
        efuse "$efuse" "$efuse_wanted"

    set --
    same "$hfuse" $hfuse_wanted || set -- "$@" -U hfuse:w:$hfuse_wanted:m
    same "$efuse" $efuse_wanted $efuse_bits || set -- "$@" -U efuse:w:$efuse_wanted:m
    same "$lfuse" $lfuse_wanted || set -- "$@" -U lfuse:w:$lfuse_wanted:m
    if [ $# -eq 0 ]; then
        echo "All fuses are as they should be; nothing written."
        return
    fi

    chip "$@" || die 1 "avrdude could not write the fuses."
    lfuse=$(read_fuse lfuse)
    hfuse=$(read_fuse hfuse)
    efuse=$(read_fuse efuse)
    if ! same "$lfuse" $lfuse_wanted || ! same "$hfuse" $hfuse_wanted ||
        ! same "$efuse" $efuse_wanted $efuse_bits; then
        die 1 "read back lfuse $lfuse, hfuse $hfuse, efuse $efuse: not what was written."
    fi
    echo "Fuses written and read back."
}

# make_eeprom ID GOAL: an EEPROM image, whose path is then in `eeprom`.
make_eeprom() {
    id=$1
    case $id in
    '' | *[!0-9]* | 0* | ??????*) id=0 ;;
    esac
    if [ "$id" -lt 1 ] || [ "$id" -gt 65534 ]; then
        die 2 "ID is '$1'; a robot's id is 1 to 65534: make $2 ID=3"
    fi
    eeprom=$root/build/robot-$id.eep
    "$root/build/muster" eeprom --id "$id" --out "$eeprom"
}

write_eeprom() {
    make_eeprom "$1" eeprom
    chip -U "eeprom:w:$eeprom:i" ||
        die 1 "avrdude failed: robot $id's EEPROM must be written again before it is used."
    echo "Robot $id has its EEPROM, written and verified."
}

flash() {
    make_eeprom "$1" flash
    efuse=$(read_fuse efuse)
    if [ $((efuse & m103c)) -eq 0 ]; then
        die 1 "refused: the fuse M103C is programmed (efuse $efuse)." \
            "A new chip comes like this and behaves as an ATmega103: it has no timer 3 and no second" \
            "USART, and its RAM ends before the image's stack begins. Clear the fuse with" \
            "    make fuses PROGRAMMER=${PROGRAMMER:-usbasp}${PORT:+ PORT=$PORT}"
    fi

    hfuse=$(read_fuse hfuse)
    if ! same "$hfuse" $hfuse_wanted $boot_bits; then
        die 1 "refused: the fuses BOOTSZ and BOOTRST are not as the boot loader needs them (hfuse $hfuse)." \
            "The chip would start past it or amid its words: the program might even run, but no update" \
            "could ever reach it over its link. Set the fuses with" \
            "    make fuses PROGRAMMER=${PROGRAMMER:-usbasp}${PORT:+ PORT=$PORT}"
    fi

    # The first of them erases the chip, and its lock bits with it.
    chip -U "flash:w:$root/build/firmware/muster.hex:i" \
        -U "flash:w:$root/build/firmware/loader.hex:i" -U "eeprom:w:$eeprom:i" \
        -U lock:w:$lock_wanted:m ||
        die 1 "avrdude failed: robot $id must be flashed again before it is used."
    echo "Robot $id is flashed and verified."
}

case ${1-}:$# in
fuses:1) set_fuses ;;
flash:2) flash "$2" ;;
eeprom:2) write_eeprom "$2" ;;
*) die 2 "usage: program.sh fuses, program.sh flash ID, or program.sh eeprom ID" ;;
esac
