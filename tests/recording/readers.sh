#!/bin/sh
# readers.sh MUSTER READERS SCENARIO: other people's readers find in a recording what is in the run's
# CSV files, also in one that was cut short and made whole again. Skipped where READERS has none.
set -eu

muster=$1
python=$2/bin/python3
if ! "$python" -c 'import mcap_ros2, rosbags' 2>/dev/null; then
    echo "skipped: there are no rosbags and mcap-ros2-support in $2 (tests/recording/get-readers.sh)"
    exit 77
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
here=$(dirname "$0")

"$muster" sim --robots native --quiet --set duration=14 --out "$work/run" "$3"
"$python" "$here/compare.py" "$work/run"

mkdir "$work/torn"
cp "$work/run/trace.csv" "$work/run/events.csv" "$work/torn"
head -c "$(($(stat -c %s "$work/run/run.mcap") * 5 / 6))" "$work/run/run.mcap" >"$work/torn/run.mcap"
"$muster" recover "$work/torn"
"$python" "$here/compare.py" "$work/torn" cut
