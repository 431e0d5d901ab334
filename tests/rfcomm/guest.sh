#!/bin/sh
# guest.sh MUSTER CONTROLLER HCICONFIG: `muster serve` and its robots over the kernel's RFCOMM, in the
# machine that fleet.sh boots. Of five robots one is never there, one is out of range for a while, and
# one loses the adapter that it is dialled by.
set -eu

muster=$1
controller=$2
hciconfig=$3
here=$(dirname "$0")
work=$(mktemp -d)
cd "$work"

# now: s since the machine was switched on.
look_at_clock() {
    read -r now rest </proc/uptime
}

say() {
    look_at_clock
    echo "$now s: $*"
}

fail() {
    say "FAIL: $*"
    tail -n 40 ./*.out ./*.err run/events.csv run/summary.json 2>/dev/null || true
    exit 1
}

# await WHAT COMMAND...: until the command says yes, for 30 s at most.
await() {
    what=$1
    look_at_clock
    until=$((${now%.*} + 30))
    shift
    until "$@"; do
        look_at_clock
        [ "${now%.*}" -lt $until ] || fail "waited in vain: $what"
        sleep 0.05
    done
    say "$what"
}

says() {
    grep -qsE -e "$2" "$1"
}

# has FILE WORDS, lacks FILE WORDS: in a line of it.
has() {
    says "$1" "$2" || fail "$1 lacks: $2"
}

lacks() {
    ! says "$1" "$2" || fail "$1 has: $2"
}

is_back() {
    [ "$(grep -c "^[0-9.-]*,$1,link_up," run/events.csv)" -eq 2 ]
}

plug_in() {
    mkfifo air
    "$controller" 6 <>air 2>controller.err &
    await 'the adapters are plugged in' test -e /sys/class/bluetooth/hci5
    for adapter in 0 1 2 3 4 5; do
        "$hciconfig" "hci$adapter" up pscan || fail "hci$adapter does not come up"
    done
}

# eight: a site and a scenario of eight robots on one adapter, made of those here.
eight() {
    sed '/id: 1/,$d' "$here/site.yaml" >eight.yaml
    sed '/id: 1/,$d' "$here/mission.yaml" >mission.yaml
    for robot in 1 2 3 4 5 6 7 8; do
        echo "  - {id: $robot, link: 'rfcomm:02:00:00:00:00:1$robot', adapter: hci0}" >>eight.yaml
        echo "  - {id: $robot, pose: [0, -$robot, 0], candidate: true}" >>mission.yaml
    done
    sed -n '/^body/,$p' "$here/mission.yaml" |
        sed 's/L: \[[^]]*/&, 2, 2, 2/; s/psi: \[[^]]*/&, 0, 1, 2/' >>mission.yaml
}

start_robots() {
    "$muster" arena "$here/mission.yaml" --unicast --rate 60 >arena.out 2>arena.err &
    await 'the arena is there' says arena.out '^arena: '
    for robot in 1 2 3 4; do
        "$muster" robot --robots native --id $robot --link "rfcomm:1@02:00:00:00:00:0$robot" \
            --arena 127.0.0.1:47600 >robot-$robot.out 2>robot-$robot.err &
    done
    for robot in 1 2 3 4; do
        await "robot $robot listens" says robot-$robot.out "^robot $robot: "
    done
}

plug_in

eight
status=0
"$muster" check eight.yaml >eight.out 2>eight.err || status=$?
[ $status -eq 1 ] || fail "eight robots on one adapter end with $status"
has eight.err 'hci0: an adapter has at most 7 robots'

start_robots
"$muster" serve "$here/site.yaml" --out run >serve.out 2>serve.err &
serve=$!
await 'robot 5 is not waited for' says serve.err 'the mission begins without robot 5 '
await 'the mission goes on' says serve.err 'running, t = [3-9]'

echo cut 4 >air
await 'robot 4 is lost' says serve.err 'robot 4: .* by hci0: .*out of range'
echo mend 4 >air
await 'robot 4 is back' is_back 4

echo unplug 5 >air
await 'robot 3 is lost' says serve.err 'robot 3: .* by hci5: .*adapter is down or unplugged'

status=0
wait $serve || status=$?
say "serve has ended with $status"
[ $status -eq 0 ] || fail "it should have ended with 0"

# Robots 1 to 3 have no channel in their address, and nobody here answers SDP.
for robot in 1 2 3 4; do
    has run/events.csv "^-[0-9.]*,$robot,link_up,rfcomm:02:00:00:00:00:0$robot by hci[05]"
done
# The others of robot 4's adapter: its last packets must not hold up theirs.
lacks run/events.csv ',[12],link_down,'
sed '1,/,4,link_down,/d' run/events.csv >after.csv
has after.csv ',4,role,F'
has after.csv ',4,vertex_won,'
has run/summary.json '"links_lost": 2,'
has run/summary.json '"end": "the mission is over"'
grep -E ',(link_up|link_down|election|stop),' run/events.csv
