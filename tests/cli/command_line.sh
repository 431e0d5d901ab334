#!/bin/sh
# command_line.sh MUSTER ROOT: what users and scripts rely on when they type a command: exit status,
# words, and that a refusal starts nothing.
set -eu

muster=$1
root=$2
work=$(mktemp -d)
child=
trap 'kill $child 2>/dev/null || true; rm -rf "$work"' EXIT
cd "$work"

fail() {
    echo "FAIL: $*"
    echo "exit status $status; stdout:"
    cat out
    echo "stderr:"
    cat err
    exit 1
}

run() {
    status=0
    "$muster" "$@" >out 2>err </dev/null || status=$?
}

# accepts WORDS ARG...: exit status 0, and the words on stdout.
accepts() {
    words=$1
    shift
    run "$@"
    [ "$status" -eq 0 ] || fail "$* is refused"
    grep -qF -e "$words" out || fail "$* does not say: $words"
}

# refuses WORDS ARG...: exit status 2, the words on stderr, nothing on stdout and nothing begun.
refuses() {
    words=$1
    shift
    run "$@"
    [ "$status" -eq 2 ] || fail "$* should end with 2"
    grep -qF -e "$words" err || fail "$* does not say: $words"
    [ ! -s out ] || fail "$* writes to stdout"
    [ ! -e runs ] || fail "$* has begun a run"
}

cat >good.yaml <<'END'
schema: 1
name: good
duration: 2
robots:
  - {id: 1, pose: [0, 0, 0], candidate: true}
  - {id: 2, pose: [-1, 0, 0]}
trajectory: {start: [0, 0, 0], v: 0.3, omega: 0}
formations:
  row: {L: [0, 1], psi: [0, pi]}
formation: row
END

# spoil SED-SCRIPT: good.yaml with a mistake in it, as bad.yaml.
spoil() {
    sed "$1" good.yaml >bad.yaml
}

# Help and version.
accepts 'Usage: muster' --help
accepts 'eeprom' --help
accepts 'muster 0.' --version
accepts 'SCENARIO.yaml' sim --help
accepts '--set=KEY.PATH=VALUE' sim --help
accepts '--id=N' eeprom --help
accepts '--only=FIGURE' paper --help

# What --help names, the manual and the completion name too.
for command in sim paper serve check id param calibrate doctor flash capture robot arena; do
    for option in $("$muster" $command --help | sed -n 's/^ .* \(--[a-z-]*\).*/\1/p' | grep -v usage); do
        grep -q -e "    $command) .*$option[ ']" "$root/server/completion/muster.bash" ||
            fail "no completion of $option"
        [ "$option" = --help ] || grep -qF -e "*$option*" "$root/docs/man/muster-$command.1.scd" ||
            fail "no $option in the manual"
    done
done

# Wrong usage, each time with a way out.
refuses 'Usage: muster'
refuses "unknown command 'smi', perhaps 'sim'" smi
refuses "muster --help" nonsense
refuses "unknown option '--verison'" --verison
refuses 'which scenario?' sim
refuses 'list, get, set, save or reset?' param
refuses 'perhaps reset' param rest
refuses 'which site?' param get
refuses 'set what?' param set site.yaml
refuses "NAME=VALUE is allowed" param set site.yaml track
refuses '--from goes with set' param get site.yaml --from file.yaml
refuses 'a number from 0.5 to 1.5 is allowed' param set site.yaml left_gain=2
refuses 'left_gain is set twice' param set site.yaml left_gain=1 left_gain=1.1
refuses 'which site?' id
refuses 'an address is' id --first 1 nowhere
refuses 'is named twice' id --first 1 tcp:localhost:1 tcp:localhost:1
refuses '--robots and --set go with a site' id --first 1 --robots 2 tcp:localhost:1
refuses 'from 1 to 60 is allowed' doctor --seconds 61 site.yaml
refuses "muster sim --help" sim --nonsense good.yaml
refuses 'which site?' calibrate
refuses '--sim needs --out FILE' calibrate --sim good.yaml
refuses 'go with a site' calibrate --sim --out calibrated.yaml --dry-run good.yaml
refuses 'one scenario at a time' sim good.yaml good.yaml
refuses '--robots pic: avr or native is allowed' sim --robots pic good.yaml
refuses '--seed -1: a whole number' sim --seed -1 good.yaml
refuses '--seed 18446744073709551616: a whole number' sim --seed 18446744073709551616 good.yaml
refuses '--speed 0: 0.01 to 1000 times real time, or max, is allowed' sim --speed 0 good.yaml
refuses '--speed nan: 0.01 to 1000' sim --speed nan good.yaml
refuses '--speed 2x: 0.01 to 1000' sim --speed 2x good.yaml
refuses 'PORT, ADDRESS, ADDRESS:PORT or [ADDRESS]:PORT is allowed' sim --view=x:99999 good.yaml
refuses 'PORT, ADDRESS, ADDRESS:PORT or [ADDRESS]:PORT is allowed' serve --view=x:99999 good.yaml
refuses '--threads 0: a whole number from 1' sim --threads 0 good.yaml
refuses '--threads 2x: a whole number from 1' sim --threads 2x good.yaml
refuses '`make firmware'\''' sim --firmware missing.elf good.yaml
refuses '--only 12: there are figures 1, 5 to 11 and 14 to 19' paper --only 12
refuses '--only 20: a whole number' paper --only 20
refuses 'only options are allowed' paper 5
refuses '`make firmware'\''' paper --firmware missing.elf

refuses 'which site?' flash
refuses 'one site at a time' flash good.yaml good.yaml
refuses 'missing.elf: cannot be read' flash --firmware missing.elf good.yaml
refuses 'good.yaml: is no ELF file' flash --firmware good.yaml good.yaml

# Scenarios that are refused, with file, line, column and reason.
spoil 's/duration/duratoin/'
refuses "bad.yaml:3:1: error: unknown key 'duratoin', perhaps 'duration'" sim bad.yaml
spoil 's/L: \[0, 1\]/L: [0, 0.009]/'
refuses 'bad.yaml:9:8: error: vertices 1 and 2 of row are in one place' sim bad.yaml
spoil 's/id: 2/id: 1/'
refuses 'bad.yaml:6:10: error: two robots with the id 1' sim bad.yaml
spoil 's/, candidate: true//'
refuses 'bad.yaml:5:3: error: no robot may lead' sim bad.yaml
spoil 's/L: \[0, 1\]/L: [0, 1, 2]/'
refuses 'bad.yaml:9:12: error: more vertices than robots: 3 for 2' sim bad.yaml
spoil 's/v: 0.3/v: 83/'
refuses 'bad.yaml:7:35: error: v is 83 at t = 0 s; a number from' sim bad.yaml
spoil '$a events: [{at: 1, explode: leader}]'
refuses "bad.yaml:11:18: error: unknown key 'explode'" sim bad.yaml
: >bad.yaml
refuses 'bad.yaml:1:1: error: nothing in it' sim bad.yaml
printf 'name: \377\376\n' >bad.yaml
refuses 'bad.yaml:1:7: error: not text: byte 0xFF' sim bad.yaml
cp "$muster" bad.yaml
refuses 'bad.yaml:1:1: error: ' sim bad.yaml
refuses 'missing.yaml:1:1: error: cannot be opened: No such file' sim missing.yaml
refuses 'missing.yaml:1:1: error: cannot be opened: No such file' \
    sim --parameters missing.yaml good.yaml
printf 'schema: 1\nrobots: [{id: 1, left_gain: 2}]\n' >bad.yaml
refuses 'bad.yaml:2:29: error: left_gain is 2; a number from 0.5 to 1.5 is allowed' \
    sim --parameters bad.yaml good.yaml
refuses '<--set network.los=1>:1:9: error: unknown key' sim --set network.los=1 good.yaml
[ "$(wc -l <err)" -eq 1 ] || fail 'an error is one line'

# Looking only.
accepts 'good.yaml: good, 2 robots, 2 s: good' sim --check good.yaml
run sim --check --quiet good.yaml
[ "$status" -eq 0 ] || fail '--check --quiet'
[ ! -s out ] && [ ! -s err ] || fail '--quiet is not quiet'
refuses 'error: v is' sim --check --set trajectory.v=t=5 good.yaml
[ ! -e runs ] || fail '--check runs something'

# What is shipped, and what the documentation shows.
for scenario in "$root"/scenarios/*.yaml; do
    accepts ': good' sim --check "$scenario"
done
sed -n '/^## An example/,/^## Keys/{/^```yaml/,/^```/{//!p}}' "$root/docs/SCENARIOS.md" >example.yaml
accepts 'two-rows, 4 robots' sim --check example.yaml
for site in "$root"/docs/examples/*.yaml; do
    accepts ': good' serve --check "$site"
done
cp "$root/scenarios/paper-exp-leader-fault.yaml" .
sed -n '/^## An example/,/^## Keys/{/^```yaml/,/^```/{//!p}}' "$root/docs/SITES.md" >example.yaml
accepts 'lab, 4 robots' serve --check example.yaml
sed -n '/^## First drive/,/^## When/{/^ *```yaml/,/^ *```/{//!s/^   //p}}' "$root/docs/hardware.md" >example.yaml
accepts 'first, 1 robots' sim --check example.yaml

# Runs.
run sim --robots native --seed 7 --quiet good.yaml
[ "$status" -eq 0 ] || fail 'a good scenario'
[ ! -s out ] || fail '--quiet is not quiet'
for file in trace.csv events.csv summary.json routes.svg routes.png distance_error.svg \
    distance_error.png; do
    [ -s "runs/good-7/$file" ] || fail "no $file"
done
[ "$(wc -l <runs/good-7/trace.csv)" -eq 203 ] || fail 'the trace has a row per robot and tick'
run sim --robots native --no-trace --out 'some where' --set duration=1 good.yaml
[ "$status" -eq 0 ] || fail '--out'
[ -s 'some where/summary.json' ] || fail '--out has no summary'
[ ! -e 'some where/trace.csv' ] || fail '--no-trace has a trace'
run sim --robots native --out good.yaml good.yaml
[ "$status" -eq 1 ] || fail 'a file in place of the directory is a failed run'

# With a page, nobody looks: it goes, at the speed that was asked for, and leaves the same.
run sim --robots native --seed 7 --quiet --view=0 --speed max --out looked-at good.yaml
[ "$status" -eq 0 ] || fail '--view'
grep -q '^view: http://127.0.0.1:[0-9]*/#[0-9a-f]*$' err || fail '--view does not say where'
[ "$(wc -l <err)" -eq 1 ] || fail '--quiet --view is not quiet'
cmp -s runs/good-7/trace.csv looked-at/trace.csv || fail 'with --view the trace is another one'
cmp -s runs/good-7/events.csv looked-at/events.csv || fail 'with --view the events are others'

rm -r runs

# A run that is interrupted leaves complete files. They are made after the signals are caught.
for signal in INT TERM; do
    status=0
    "$muster" sim --robots native --real-time --quiet --out "$signal" --set duration=20 \
        good.yaml >out 2>err </dev/null &
    child=$!
    until [ -e "$signal/trace.csv" ]; do
        kill -0 $child 2>err || fail 'a run in real time ends early'
    done
    kill "-$signal" $child
    wait $child || status=$?
    child=
    [ "$status" -eq 1 ] || fail "SIG$signal should end a run with 1"
    grep -q 'interrupted' err || fail "SIG$signal is not told"
    [ -s "$signal/summary.json" ] || fail "SIG$signal loses the summary"
    [ -z "$(tail -c 1 "$signal/trace.csv")" ] || fail "SIG$signal cuts a row"
done

# A robot's id, and the default of all else, as Intel HEX.
run eeprom --id 3 --out robot.eep
[ "$status" -eq 0 ] || fail 'eeprom'
{
    echo ':100000000200090300004000400000000000000062'
    echo ':1000100000C81938188B06FFFFFFFFFFFFFFFFFF27'
    for record in 20:E0 30:D0 40:C0 50:B0 60:A0 70:90; do
        echo ":1000${record%:*}00FFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFF${record#*:}"
    done
    echo ':00000001FF'
} | cmp -s - robot.eep || fail 'not what it was'
refuses '--id 0: a whole number from 1 to 65534' eeprom --id 0 --out robot.eep
refuses '--id 65535:' eeprom --id 65535 --out robot.eep
refuses '--id 3x:' eeprom --id 3x --out robot.eep
refuses '--id and --out are needed' eeprom --id 3
