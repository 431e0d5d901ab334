#!/bin/sh
# Every arithmetic function of the headers is tried by tests/avr/arithmetic.h.
set -eu

root=$(dirname "$0")/../..
trials=$root/tests/avr/arithmetic.h
failures=0
found=0

for header in common/host/multiply.h common/fixed.h common/formation.h common/trajectory.h \
    firmware/core/motion.h firmware/core/sweep.h firmware/core/lookout.h \
    firmware/core/rival.h; do
    for function in $(sed -n 's/^[a-z][a-z0-9_ ]* \([a-z0-9_]*\)(.*/\1/p' "$root/$header"); do
        found=$((found + 1))
        grep -qw "$function" "$trials" || {
            echo "$header: nobody tries $function"
            failures=$((failures + 1))
        }
    done
done
echo "$found functions"
exit $((failures > 0 || found < 30))
