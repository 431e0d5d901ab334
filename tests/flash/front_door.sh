#!/bin/sh
# What is said to make arrives at avrdude.
set -eu

here=$(cd "$(dirname "$0")" && pwd)
CHIP=$(mktemp -d)
trap 'rm -rf "$CHIP"' EXIT
export CHIP
echo 0x3f >"$CHIP/lfuse"
echo 0x84 >"$CHIP/hfuse"
echo 0xff >"$CHIP/efuse"

make -s -C "$here/../.." fuses AVRDUDE="$here/avrdude.sh" PROGRAMMER=avrisp2 PORT=usb AVRDUDE_FLAGS='-B 10'

diff - "$CHIP/commands" <<'END'
-p m128 -c avrisp2 -P usb -B 10 -qq -U lfuse:r:-:h
-p m128 -c avrisp2 -P usb -B 10 -qq -U hfuse:r:-:h
-p m128 -c avrisp2 -P usb -B 10 -qq -U efuse:r:-:h
END
