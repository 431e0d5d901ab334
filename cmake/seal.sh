#!/bin/sh
# seal.sh OBJCOPY ELF: seals a linked program (common/flash_map.h). Its length and its CRC-32, the one
# that ends what gzip writes, come into the section .seal.
set -eu

objcopy=$1
elf=$2
program_bytes_max=64256 # PROGRAM_BYTES_MAX

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# COUNT bytes of a number, the low one first.
little_endian() {
    value=$1
    for _ in $(seq "$2"); do
        # shellcheck disable=SC2059 # the format is the byte
        printf "\\$(printf %03o $((value & 255)))"
        value=$((value >> 8))
    done
}

"$objcopy" -O binary -j .text -j .data "$elf" "$work/program"
length=$(wc -c <"$work/program")
if [ "$length" -gt $program_bytes_max ]; then
    echo "$elf: $length bytes; $program_bytes_max fit below the seal of a slot" >&2
    exit 1
fi
{
    little_endian "$length" 2
    little_endian $((~length)) 2
    gzip -cn "$work/program" | tail -c 8 | head -c 4
} >"$work/seal"
"$objcopy" --update-section .seal="$work/seal" "$elf"
