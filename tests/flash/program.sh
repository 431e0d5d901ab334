#!/bin/sh
# firmware/program.sh, judged by the command lines it gives avrdude and by what is then in the chip.
set -u

here=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failures=0

# A build tree with an image and a muster whose EEPROM images name their id.
tree=$work/tree
mkdir -p "$tree/firmware" "$tree/build/firmware"
cp "$here/../../firmware/program.sh" "$tree/firmware/"
echo image >"$tree/build/firmware/muster.hex"
echo loader >"$tree/build/firmware/loader.hex"
cat >"$tree/build/muster" <<'END'
#!/bin/sh
[ "$1 $2 $4" = "eeprom --id --out" ] && echo "id $3" >"$5"
END
chmod +x "$tree/build/muster"

export CHIP=$work/chip AVRDUDE=$here/avrdude.sh
unset AVRDUDE_FLAGS PART

# A chip as delivered, at an ISP programmer on a port.
new_chip() {
    case_name=$1
    rm -rf "$CHIP"
    mkdir "$CHIP"
    touch "$CHIP/commands"
    echo 0xe1 >"$CHIP/lfuse"
    echo 0x99 >"$CHIP/hfuse"
    echo 0xfd >"$CHIP/efuse"
    export PROGRAMMER=stk500v2 PORT=/dev/ttyUSB0
}

ready_chip() {
    new_chip "$1"
    echo 0x3f >"$CHIP/lfuse"
    echo 0x84 >"$CHIP/hfuse"
    echo 0xff >"$CHIP/efuse"
}

program() {
    status=0
    "$tree/firmware/program.sh" "$@" >"$work/said" 2>&1 || status=$?
}

fail() {
    failures=$((failures + 1))
    echo "$case_name: $1"
    sed 's/^/    /' "$work/said"
}

expect_status() { [ "$status" -eq "$1" ] || fail "exit status $status, expected $1"; }
expect_said() { grep -qF -e "$1" "$work/said" || fail "did not say: $1"; }
expect_memory() {
    [ "$(cat "$CHIP/$1" 2>/dev/null)" = "$2" ] || fail "$1 holds '$(cat "$CHIP/$1" 2>&1)', expected '$2'"
}

# The exact command lines, from standard input; CONNECT stands for how the chip is reached.
expect_commands() {
    sed "s|CONNECT|-p m128 -c $PROGRAMMER${PORT:+ -P $PORT}|" >"$work/expected"
    diff "$work/expected" "$CHIP/commands" >"$work/diff" || {
        fail 'other command lines than expected:'
        cat "$work/diff"
    }
}

ready_chip flash
program flash 3
expect_status 0
expect_commands <<END
CONNECT -qq -U efuse:r:-:h
CONNECT -qq -U hfuse:r:-:h
CONNECT -U flash:w:$tree/build/firmware/muster.hex:i -U flash:w:$tree/build/firmware/loader.hex:i -U eeprom:w:$tree/build/robot-3.eep:i -U lock:w:0xef:m
END
expect_memory flash 'image
loader'
expect_memory eeprom 'id 3'
expect_memory lock 0xef
expect_said 'Robot 3 is flashed and verified.'

ready_chip usb_programmer_without_a_port
PROGRAMMER=usbasp PORT=
program flash 65534
expect_status 0
expect_commands <<END
CONNECT -qq -U efuse:r:-:h
CONNECT -qq -U hfuse:r:-:h
CONNECT -U flash:w:$tree/build/firmware/muster.hex:i -U flash:w:$tree/build/firmware/loader.hex:i -U eeprom:w:$tree/build/robot-65534.eep:i -U lock:w:0xef:m
END
expect_memory eeprom 'id 65534'

ready_chip further_options
AVRDUDE_FLAGS='-B 10 -b 57600' program flash 3
expect_status 0
[ "$(grep -c -e ' -P /dev/ttyUSB0 -B 10 -b 57600 ' "$CHIP/commands")" -eq 3 ] ||
    fail 'AVRDUDE_FLAGS not in all command lines'

new_chip flash_refused_with_m103c
program flash 3
expect_status 1
expect_commands <<END
CONNECT -qq -U efuse:r:-:h
END
expect_said M103C
expect_said ATmega103
expect_said 'make fuses PROGRAMMER=stk500v2 PORT=/dev/ttyUSB0'

# As delivered; as they were before there was a loader; right but for one bit of each.
for hfuse in 0x99 0x81 0x85 0x86 0x80; do
    ready_chip "flash_refused_with_hfuse_$hfuse"
    echo $hfuse >"$CHIP/hfuse"
    program flash 3
    expect_status 1
    expect_commands <<END
CONNECT -qq -U efuse:r:-:h
CONNECT -qq -U hfuse:r:-:h
END
    expect_said "BOOTSZ and BOOTRST are not as the boot loader needs them (hfuse $hfuse)"
    expect_said 'make fuses PROGRAMMER=stk500v2 PORT=/dev/ttyUSB0'
done

for id in '' 0 -1 65535 99999 100000 3.5 0x10 007 three '3 4'; do
    ready_chip "id_'$id'"
    program flash "$id"
    expect_status 2
    expect_said '1 to 65534'
    expect_commands </dev/null
done

ready_chip flash_without_an_answer
echo absent >"$CHIP/fault"
program flash 3
expect_status 1
expect_said 'cannot read the chip'
expect_said 'target does not answer'
expect_commands <<END
CONNECT -qq -U efuse:r:-:h
END

ready_chip another_part
PART=m128a program flash 3
expect_status 0
[ "$(grep -c -e '^-p m128a -c ' "$CHIP/commands")" -eq 3 ] || fail 'PART not in all command lines'

ready_chip eeprom_alone
program eeprom 3
expect_status 0
expect_commands <<END
CONNECT -U eeprom:w:$tree/build/robot-3.eep:i
END
expect_memory eeprom 'id 3'
expect_said 'Robot 3 has its EEPROM'
program eeprom 0
expect_status 2
expect_said 'make eeprom ID=3'

ready_chip eeprom_that_is_worn_out
echo bad_eeprom >"$CHIP/fault"
program eeprom 3
expect_status 1
expect_said "robot 3's EEPROM must be written again"

ready_chip efuse_not_a_byte
echo nonsense >"$CHIP/efuse"
program flash 3
expect_status 1
expect_said "avrdude says 'nonsense'"

for memory in flash eeprom; do
    ready_chip "verification_of_$memory"
    echo "bad_$memory" >"$CHIP/fault"
    program flash 3
    expect_status 1
    expect_said 'verification error'
    expect_said 'must be flashed again'
done

new_chip fuses
program fuses
expect_status 0
expect_commands <<END
CONNECT -qq -U lfuse:r:-:h
CONNECT -qq -U hfuse:r:-:h
CONNECT -qq -U efuse:r:-:h
CONNECT -U hfuse:w:0x84:m -U efuse:w:0xff:m -U lfuse:w:0x3f:m
CONNECT -qq -U lfuse:r:-:h
CONNECT -qq -U hfuse:r:-:h
CONNECT -qq -U efuse:r:-:h
END
expect_memory lfuse 0x3f
expect_memory hfuse 0x84
expect_memory efuse 0xff
expect_said 'lfuse 0xe1 -> 0x3f'
expect_said 'hfuse 0x99 -> 0x84'
expect_said 'efuse 0xfd -> 0xff'
program flash 3
expect_status 0

ready_chip fuses_again
program fuses
expect_status 0
expect_commands <<END
CONNECT -qq -U lfuse:r:-:h
CONNECT -qq -U hfuse:r:-:h
CONNECT -qq -U efuse:r:-:h
END
expect_said 'nothing written'

ready_chip only_what_differs
echo 0xfd >"$CHIP/efuse"
program fuses
expect_status 0
[ "$(sed -n 4p "$CHIP/commands")" = "-p m128 -c $PROGRAMMER -P $PORT -U efuse:w:0xff:m" ] ||
    fail "wrote: $(sed -n 4p "$CHIP/commands")"

ready_chip bits_that_do_not_exist
echo 0x3 >"$CHIP/efuse"
program fuses
expect_status 0
expect_said 'nothing written'

new_chip fuses_that_stay
echo fuses_stay >"$CHIP/fault"
program fuses
expect_status 1
expect_said 'not what was written'

new_chip fuses_without_an_answer
echo absent >"$CHIP/fault"
program fuses
expect_status 1
expect_commands <<END
CONNECT -qq -U lfuse:r:-:h
END

ready_chip usage
program
expect_status 2
program erase
expect_status 2
program flash
expect_status 2
expect_commands </dev/null

exit $((failures > 0))
