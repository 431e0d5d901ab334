#!/bin/sh
# capture.sh MUSTER: a recording that is played comes out as it went in, and what cannot be recorded
# is said.
set -eu

muster=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

fail() {
    echo "FAIL: $*"
    cat err
    exit 1
}

# ends STATUS WORDS ARG...: the exit status, and the words on stderr.
ends() {
    wanted=$1
    words=$2
    shift 2
    status=0
    "$muster" capture "$@" >out 2>err </dev/null || status=$?
    [ "$status" -eq "$wanted" ] || fail "capture $* ends with $status, not $wanted"
    [ -z "$words" ] || grep -qF -e "$words" err || fail "capture $* does not say: $words"
}

# Each frame has a body of its own: none is skipped for the next one on a slow machine.
cat >walk.csv <<'END'
t,body,id,x,y,z,qx,qy,qz,qw,tracked
0.000000,one,7,1,-2.5,0.25,0,0,0.6,0.8,1
0.000000,"t,""wo",,0.333333333,2e-09,12345.6789,0,0,0,1,0
0.008333,three,0,1,2,3,0,0,0,1,1
0.016667,,-5,1,2,3,1,0,0,0,1
END
cat >site.yaml <<'END'
schema: 1
name: lab
mocap: {protocol: poses, file: walk.csv}
robots:
  - {id: 1, link: "tcp:127.0.0.1:1"}
END

ends 0 '3 frames' --seconds 1 site.yaml
cmp walk.csv out || fail "what is recorded is not what was played"
ends 0 '' --seconds 1 --quiet --out again.csv site.yaml
cmp walk.csv again.csv || fail "--out holds something else"
[ ! -s err ] && [ ! -s out ] || fail "--quiet is not"

sed '3s/,0$/,no/' walk.csv >bad.csv
ends 1 'line 3: tracked: 0 or 1 is allowed' --seconds 1 --quiet --set mocap.file=bad.csv site.yaml
ends 1 'no frame has come' --seconds 1 --quiet --set mocap.file=bad.csv site.yaml
ends 1 'cannot write none/walk.csv' --seconds 1 --out none/walk.csv site.yaml
ends 1 'written' --seconds 1 --out /dev/full site.yaml
ends 2 'one site at a time' site.yaml site.yaml
ends 2 'which site?'
ends 2 'a whole number' --seconds -1 site.yaml
ends 2 'nowhere.yaml' nowhere.yaml
