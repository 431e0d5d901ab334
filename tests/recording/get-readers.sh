#!/bin/sh
# get-readers.sh DIR: other people's readers of recordings, against which ours are held, from PyPI
# into a virtual environment in DIR, unless they are there.
#
# Always ends with 0: where they cannot be had the tests are skipped, and say so.
set -eu

readers='mcap==1.6.0 mcap-ros2-support==0.6.0 rosbags==0.11.9'
done=$1/.complete

[ "$(cat "$done" 2>/dev/null)" != "$readers" ] || exit 0
echo "Fetching readers for tests/recording:" $readers
python3 -m venv --clear "$1" &&
    "$1/bin/pip" install --quiet --disable-pip-version-check $readers &&
    echo "$readers" >"$done" ||
    echo "No readers for tests/recording: what needs them will be skipped"
