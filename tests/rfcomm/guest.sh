#!/bin/sh
# guest.sh MUSTER CONTROLLER HCICONFIG: `muster serve` and its robots over the kernel's RFCOMM, in the
# machine that fleet.sh boots. One robot is never there, one is out of range for a while.
set -eu

muster=$1
controller=$2
hciconfig=$3
here=$(dirname "$0")
work=$(mktemp -d)
cd "$work"

fail() {
    echo "FAIL: $*"
    tail -n 30 ./*.out ./*.err run/events.csv run/summary.json 2>/dev/null || true
    exit 1
}

# await FILE WORDS: until the file has a line with the words.
await() {
    tries=600
    until grep -qF -e "$2" "$1" 2>/dev/null; do
        tries=$((tries - 1))
        [ $tries -gt 0 ] || fail "$1 never says: $2"
        sleep 0.05
    done
}

has() {
    grep -qE -e "$2" "$1" || fail "$1 has no: $2"
}

say() {
    echo "$(cut -d ' ' -f 1 /proc/uptime) s: $*"
}

# Adapters: hci0 and hci5 are the server's, hci1 to hci4 the robots' modules.
mkfifo air
"$controller" 6 <>air 2>controller.err &
tries=100
until [ -e /sys/class/bluetooth/hci5 ]; do
    tries=$((tries - 1))
    [ $tries -gt 0 ] || fail "no adapters"
    sleep 0.05
done
for adapter in 0 1 2 3 4 5; do
    "$hciconfig" "hci$adapter" up pscan || fail "hci$adapter does not come up"
done
say "adapters up"

# An adapter has seven robots at most.
sed '/id: 1/,$d' "$here/site.yaml" >eight.yaml
sed '/id: 1/,$d' "$here/mission.yaml" >mission.yaml
for robot in 1 2 3 4 5 6 7 8; do
    echo "  - {id: $robot, link: 'rfcomm:02:00:00:00:00:1$robot', adapter: hci0}" >>eight.yaml
    echo "  - {id: $robot, pose: [0, -$robot, 0], candidate: true}" >>mission.yaml
done
sed -n '/^body/,$p' "$here/mission.yaml" | sed 's/5, 1.5]/5, 2, 2, 2, 2]/; s/2, pi]/2, 0, 1, 2, 3]/' \
    >>mission.yaml
status=0
"$muster" check eight.yaml >eight.out 2>eight.err || status=$?
[ $status -eq 1 ] || fail "eight robots on one adapter end with $status"
has eight.err 'hci0: .*at most 7 robots'

"$muster" arena "$here/mission.yaml" --unicast >arena.out 2>arena.err &
await arena.out arena:
for robot in 1 2 3 4; do
    "$muster" robot --robots native --id $robot --link "rfcomm:1@02:00:00:00:00:0$robot" \
        --arena 127.0.0.1:47600 >robot-$robot.out 2>robot-$robot.err &
done
for robot in 1 2 3 4; do
    await robot-$robot.out "robot $robot:"
done
say "robots listen"

"$muster" serve "$here/site.yaml" --out run >serve.out 2>serve.err &
serve=$!
await serve.err 'the mission begins without'
await serve.err leads
has serve.err 'the mission begins without .*robot 5'
say "the mission has begun"

echo cut 4 >air
await serve.err 'robot 4: '
say "robot 4 is out of range"
echo mend 4 >air

status=0
wait $serve || status=$?
say "serve ended with $status"
[ $status -eq 0 ] || fail "serve ended with $status"
cat serve.out serve.err run/events.csv run/summary.json
