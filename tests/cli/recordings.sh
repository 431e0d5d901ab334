#!/bin/sh
# recordings.sh MUSTER SCENARIO: what recover and replay say of recordings and of what is none.
set -eu

muster=$1
scenario=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

fail() {
    echo "FAIL: $*"
    cat out err
    exit 1
}

# ends STATUS WORDS ARG...: the exit status, and the words on stdout or stderr.
ends() {
    wanted=$1
    words=$2
    shift 2
    status=0
    "$muster" "$@" >out 2>err </dev/null || status=$?
    [ "$status" -eq "$wanted" ] || fail "$* ends with $status, not $wanted"
    cat out err | grep -qF -e "$words" || fail "$* does not say: $words"
}

"$muster" sim --robots native --quiet --set duration=1.5 --out run "$scenario"
"$muster" sim --robots native --quiet --set duration=1.5 --out again "$scenario"
cmp run/run.mcap again/run.mcap || fail 'the same run is another recording'
"$muster" sim --robots native --quiet --set duration=1.5 --out run --no-trace "$scenario"
[ ! -e run/run.mcap ] || fail '--no-trace has a recording, or leaves an old one'

ends 0 'again: was whole, 1.50 s, ' recover again
cp again/run.mcap whole.mcap
size=$(stat -c %s whole.mcap)
head -c "$((size - 1))" whole.mcap >again/run.mcap
ends 0 'other.mcap: made whole, 1.50 s, ' recover again --out other.mcap
cmp whole.mcap other.mcap || fail 'what has lost its last byte is not what it was'
cmp -s whole.mcap again/run.mcap && fail '--out changes the recording'
ends 0 'again: made whole, 1.50 s, ' recover again
cmp whole.mcap again/run.mcap || fail 'it is not what it was'
head -c "$((size / 2))" whole.mcap >torn.mcap
ends 0 'torn.mcap: made whole, ' recover torn.mcap
ends 0 'torn.mcap: was whole, ' recover torn.mcap
ends 1 'cannot write nowhere/a.mcap' recover torn.mcap --out nowhere/a.mcap
ends 2 'run.mcap: No such file' recover run
ends 2 'out is no MCAP file' recover out
ends 2 'which run?' recover
ends 2 'one run at a time' recover run again

head -c 60 whole.mcap >empty.mcap
ends 2 'nothing was recorded in empty.mcap' replay --view=0 empty.mcap
ends 2 'run.mcap: No such file' replay run
ends 2 'out is no MCAP file' replay out
ends 2 'which run?' replay
ends 2 'one run at a time' replay run again
ends 2 '--view' replay --view=70000 again
