#!/bin/sh
# stack_bound.sh FIRMWARE: cmake/stack-bound.sh knows how deep a stack can become, and says so when
# it does not. FIRMWARE is where the firmware preset has built.
set -eu

bound=$(dirname "$0")/../../cmake/stack-bound.sh
firmware=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failures=0

fail() {
    echo "$1"
    failures=$((failures + 1))
}

# measure NAME POINTERS: into $work/said and $work/report. avr-libc's start-up code calls main.
measure() {
    status=0
    "$bound" avr-objdump "$work/$1.elf" $2 >"$work/said" 2>"$work/report" || status=$?
}

assemble() {
    { echo '.global main'; cat; } >"$work/$1.S"
    avr-gcc -mmcu=atmega128 "$work/$1.S" -o "$work/$1.elf"
}

# bytes EXPECTED NAME [POINTERS], assembly on standard input. Of EXPECTED, 2 are main's return
# address.
bytes() {
    assemble "$2"
    measure "$2" "${3-}"
    if [ "$status" -ne 0 ] || ! grep -qx "stack_bound_bytes $1" "$work/said"; then
        fail "$2: expected $1 bytes, got exit status $status"
        cat "$work/said" "$work/report"
    fi
}

# refused WORDS NAME [POINTERS], assembly on standard input.
refused() {
    assemble "$2"
    measure "$2" "${3-}"
    if [ "$status" -ne 1 ] || ! grep -q "$1" "$work/report"; then
        fail "$2: expected '$1', got exit status $status"
        cat "$work/said" "$work/report"
    fi
}

bytes 2 nothing <<'END'
main:
    ret
END

bytes 8 pushes_and_calls <<'END'
main:
    push r28
    call deep
    pop r28
    rcall shallow
    ret
deep:
    push r2
    push r3
    push r4
    pop r4
    pop r3
    pop r2
    ret
shallow:
    push r2
    pop r2
    ret
END

bytes 6 jump_instead_of_call_and_return <<'END'
main:
    push r2
    pop r2
    rjmp other
other:
    push r2
    push r3
    push r4
    push r5
    pop r5
    pop r4
    pop r3
    pop r2
    ret
END

bytes 5 function_in_place_of_return <<'END'
.type other, @function
main:
    push r2
    push r3
    pop r3
    pop r2
    rjmp other
other:
    push r2
    push r3
    push r4
    pop r4
    pop r3
    pop r2
    ret
END

bytes 306 frame <<'END'
main:
    push r28
    push r29
    in r28, 0x3d
    in r29, 0x3e
    subi r28, lo8(300)
    sbci r29, hi8(300)
    in r0, 0x3f
    cli
    out 0x3e, r29
    out 0x3f, r0
    out 0x3d, r28
    adiw r28, 40
    std Y+1, r24
    sbiw r28, 40
    rcall other
    subi r28, lo8(-300)
    sbci r29, hi8(-300)
    out 0x3e, r29
    out 0x3d, r28
    pop r29
    pop r28
    ret
other:
    ret
END

bytes 8 two_bytes_at_a_time <<'END'
main:
    rcall .
    rcall .
    push r1
    push r1
    pop r0
    pop r0
    pop r0
    pop r0
    pop r0
    pop r0
    ret
END

bytes 11 handler_on_top <<'END'
main:
    push r2
    push r3
    pop r3
    pop r2
    ret
.global __vector_5
__vector_5:
    push r0
    push r1
    rcall other
    pop r1
    pop r0
    reti
.global __vector_6
__vector_6:
    reti
other:
    push r2
    pop r2
    push r3
    pop r3
    ret
END

bytes 7 pointer caller=callee <<'END'
main:
    rcall caller
    ret
caller:
    ldi r30, pm_lo8(callee)
    ldi r31, pm_hi8(callee)
    icall
    ret
callee:
    push r2
    pop r2
    ret
END

refused 'nobody says whom the pointer is to at 0x[0-9a-f]* in main' unknown_pointer caller=main <<'END'
main:
    icall
    ret
END

refused 'nobody knows where the jump goes' unknown_jump <<'END'
main:
    ijmp
END

bytes 3 into_the_boot_loader <<'END'
main:
    push r2
    jmp 0x1f802
END

refused 'no code at 0x1f7fe' before_the_boot_loader <<'END'
main:
    jmp 0x1f7fe
END

refused 'recursion: main calls itself' recursion <<'END'
main:
    rcall main
    ret
END

refused 'recursion: [a-z]* calls itself, maybe through others' mutual_recursion <<'END'
main:
    rcall ping
    ret
ping:
    rcall pong
    ret
pong:
    rcall ping
    ret
END

refused 'the stack grows in a loop' growth <<'END'
main:
    push r2
    rjmp main
END

refused 'SP is set from nobody knows what' stack_from_elsewhere <<'END'
main:
    in r28, 0x3d
    in r29, 0x3e
    add r28, r24
    adc r29, r25
    out 0x3e, r29
    out 0x3d, r28
    ret
END

refused 'returns with 1 bytes on the stack' unbalanced <<'END'
main:
    push r2
    ret
END

refused 'a handler can be interrupted' nested_handlers <<'END'
main:
    ret
.global __vector_5
__vector_5:
    sei
    reti
END

refused 'variables and stack need 3 bytes more than there are' too_much <<'END'
main:
    push r2
    pop r2
    ret
    .comm variables, 4096
END

measure missing ''
[ "$status" -eq 1 ] || fail "missing.elf: a file that is not there passed"

# agrees FILE: the compiler says in FILE what each function in C takes.
agrees() {
    awk -F '\t' '
        FNR == NR { n = split($1, part, ":"); says[part[n], $2] = known[part[n]] = 1; next }
        {
            split($0, field, " ")
            if (field[1] != "function" || !(field[2] in known))
                next
            compared++
            if (!((field[2], field[3]) in says)) {
                print field[2] ": " field[3] " bytes, the compiler says otherwise"
                wrong = 1
            }
        }
        END { print compared + 0 " functions compared"; exit wrong || !compared }' "$1" "$work/said"
}

cat >"$work/program.c" <<'END'
volatile unsigned char sink;
static __attribute__((noinline)) void fill(unsigned char *at, unsigned char count)
{
    while (count--)
        at[count] = sink;
}
static __attribute__((noinline)) long mix(long a, long b, unsigned way)
{
    unsigned char room[200];
    long sum = 0;

    for (long i = a; i < b; i++) {
        fill(room, (unsigned char)way);
        switch (way) {
        case 0: sum += a + i; break;
        case 1: sum ^= a; break;
        case 2: sum -= b * i; break;
        case 3: sum /= i; break;
        case 4: fill(room, 3); break;
        case 5: sum |= b; break;
        case 6: sum = ~sum; break;
        case 7: sum = i; break;
        case 8: fill(room, 5); break;
        }
    }
    return sum + room[3];
}
int main(void)
{
    return mix(sink, sink, sink);
}
END
for options in -Os -O2 '-Os -mcall-prologues'; do
    (cd "$work" && avr-gcc -mmcu=atmega128 -fstack-usage $options program.c -o program.elf)
    measure program ''
    if [ "$status" -ne 0 ] || ! agrees "$work/program.su"; then
        fail "program.c with $options: exit status $status"
        cat "$work/report"
    fi
done
avr-objdump -d "$work/program.elf" >"$work/listing"
for routine in __tablejump2__ __prologue_saves__; do
    grep -q "jmp.*<$routine" "$work/listing" || fail "program.c: nothing jumps to $routine"
done

# And of the robot's own image; what is not compiled any more may still lie about.
cp "$firmware/muster.stack" "$work/said"
sed -n 's/.* -o \([^ ]*\)\.obj .*/\1.su/p' "$firmware/compile_commands.json" |
    grep -v '^tests/' | while read -r file; do
        [ ! -e "$firmware/$file" ] || cat "$firmware/$file"
    done >"$work/image.su"
agrees "$work/image.su" || fail "muster.elf: not what the compiler says"

exit $((failures > 0))
