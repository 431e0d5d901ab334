#!/bin/sh
# scan-skips.sh OBJDUMP ELF: fails when simavr 1.6 would execute the image wrongly.
#
# A skip (cpse, sbrc, sbrs, sbic, sbis) must know how long the instruction after it is. simavr 1.6
# masks that word with 0xfc0f and so takes adiw and sbiw with a K whose low four bits are 0xc to
# 0xf for a jmp or call of 32 bits: it skips one instruction too many. The chip is right.
set -eu

objdump=$1
elf=$2

listing=$("$objdump" -d "$elf")
printf '%s\n' "$listing" | awk -F '\t' -v elf="$elf" '
    /^[0-9a-f]+ <.*>:$/ {
        owner = $0
        gsub(/^[^<]*<|>:$/, "", owner)
        next
    }
    NF < 2 { next }
    {
        # Address, bytes, mnemonic; data has no mnemonic. The low bits of K come second in the
        # first byte printed, whatever radix the operand is shown in.
        if (skip != "" && $3 ~ /^(adiw|sbiw)$/ && $2 ~ /^.[c-f]/) {
            gsub(/[ :]/, "", $1)
            printf "%s: 0x%s in %s: %s right after %s is skipped wrongly by simavr 1.6\n",
                elf, $1, owner, $3, skip > "/dev/stderr"
            hits++
        }
        skip = $3 ~ /^(cpse|sbrc|sbrs|sbic|sbis)$/ ? $3 : ""
        seen += $3 != ""
    }
    END {
        if (!seen) {
            printf "%s: no code found in it\n", elf > "/dev/stderr"
        }
        exit hits || !seen
    }'
