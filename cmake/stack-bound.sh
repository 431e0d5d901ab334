#!/bin/sh
# stack-bound.sh OBJDUMP ELF [CALLER=CALLEE...]: how deep the image's stack can become.
#
# Follows every way through the machine code of main() and of the interrupt handlers, and fails
# where it cannot be sure: recursion, a stack that grows in a loop, SP set in a way not known here,
# handlers that can be interrupted, and pointers to functions, unless it is told whom CALLER may
# call by them. Fails as well when variables and stack need more RAM than there is. A way ends where
# it leaves for the boot loader, which has an image and a stack of its own.
#
# Prints, in bytes: stack_bound_bytes, of main() and the deepest handler on top of it;
# ram_static_bytes, of the variables; ram_free_bytes, what is left of the RAM in that worst case;
# then the two deepest ways, and for each function what it takes itself and with all that it calls,
# return addresses included.
set -eu

objdump=$1
elf=$2
shift 2

{ "$objdump" -t "$elf" && "$objdump" -d "$elf"; } |
    awk -F '\t' -v elf="$elf" -v pointers="$*" -f "$(dirname "$0")/stack-bound.awk"
