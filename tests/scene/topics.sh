#!/bin/sh
# topics.sh PROGRAM READERS: what ROS 2's tools make of a scene's messages: PyPI's rosbags and
# mcap-ros2-support. Skipped where READERS has them not.
set -eu

python=$2/bin/python3
if ! "$python" -c 'import mcap_ros2, rosbags' 2>/dev/null; then
    echo "skipped: there are no rosbags and mcap-ros2-support in $2 (tests/recording/get-readers.sh)"
    exit 77
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$1" "$work/messages"
"$python" "$(dirname "$0")/topics.py" "$work/messages"
