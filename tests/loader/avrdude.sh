#!/bin/sh
# avrdude itself gives a virtual robot its program, through the robot's link.
set -eu

muster=$1
firmware=$2

work=$(mktemp -d)
robot=
trap '[ -z "$robot" ] || kill "$robot"; rm -rf "$work"' EXIT

# It waits in its boot loader: its first program does nothing but to call that.
mkfifo "$work/said"
"$muster" robot --id 3 --firmware "$firmware/tests/calling.elf" --link tcp:127.0.0.1:0 --quiet \
    >"$work/said" &
robot=$!
read -r _ _ link <"$work/said"

program() {
    avrdude -c stk500v2 -p m128 -P "net:${link#tcp:}" -U "flash:w:$firmware/muster.hex:i"
}

program

cat >"$work/site.yaml" <<END
schema: 1
name: one-robot
mocap: {protocol: natnet, server: 127.0.0.1}
robots:
  - {id: 3, link: "$link"}
END

# The seal's last four bytes, the low one first.
wanted=$(sed -n 's/^:08FBF800........\(..\)\(..\)\(..\)\(..\).*/\4\3\2\1/p' "$firmware/muster.hex")

assert_runs_it() {
    "$muster" param get "$work/site.yaml" image >"$work/image"
    grep -i -q "$wanted" "$work/image" || {
        echo "the robot should run $wanted; it says:"
        cat "$work/image"
        exit 1
    }
}

# And now it runs that one, without power in between as well.
assert_runs_it
kill -USR1 "$robot"
assert_runs_it

# The program makes way for a programmer by itself.
program
assert_runs_it
