#!/bin/sh
# cmake/scan-skips.sh finds what simavr 1.6 executes wrongly, and nothing else.
set -eu

scan=$(dirname "$0")/../../cmake/scan-skips.sh
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failures=0

# verdict EXPECTED NAME, assembly on standard input: EXPECTED is the number of hits.
verdict() {
    { echo '.global main'; echo 'main:'; cat; } >"$work/$2.S"
    avr-gcc -mmcu=atmega128 "$work/$2.S" -o "$work/$2.elf"
    status=0
    "$scan" avr-objdump "$work/$2.elf" 2>"$work/report" || status=$?
    hits=$(wc -l <"$work/report")
    if [ "$hits" -ne "$1" ] || [ "$status" -ne $((hits > 0)) ]; then
        echo "$2: expected $1 hits, got $hits and exit status $status"
        cat "$work/report"
        failures=$((failures + 1))
    fi
}

verdict 5 every_skip <<'END'
    cpse r24, r25
    adiw r24, 12
    sbrc r24, 7
    adiw r24, 13
    sbrs r24, 7
    sbiw r26, 14
    sbic 0x10, 1
    sbiw r28, 15
    sbis 0x10, 1
    adiw r30, 63
    ret
END
grep -q 'every_skip.elf: 0x[0-9a-f]* in main: adiw right after cpse' "$work/report" || {
    echo "every_skip: the report does not say where"
    failures=$((failures + 1))
}

verdict 4 every_high_part_of_k <<'END'
    sbrc r24, 7
    adiw r24, 12
    sbrc r24, 7
    adiw r24, 28
    sbrc r24, 7
    adiw r24, 44
    sbrc r24, 7
    adiw r24, 60
    ret
END

verdict 1 across_a_label <<'END'
    sbrc r24, 7
loop:
    adiw r24, 15
    rjmp loop
END

verdict 0 low_k <<'END'
    sbrc r24, 7
    adiw r24, 11
    sbrs r24, 7
    sbiw r24, 59
    sbis 0x10, 1
    adiw r24, 0x10
    ret
END

verdict 0 something_between <<'END'
    sbrc r24, 7
    inc r24
    adiw r24, 15
    sbrs r24, 7
    jmp main
    sbiw r24, 15
    ret
END

verdict 0 constants_in_flash <<'END'
    ret
    .type table, @object
table:
    .word 0xfd87, 0x960f
    .size table, . - table
END

if "$scan" avr-objdump "$work/missing.elf" 2>/dev/null; then
    echo "missing.elf: a file that is not there passed"
    failures=$((failures + 1))
fi

exit $((failures > 0))
