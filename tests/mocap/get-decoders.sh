#!/bin/sh
# get-decoders.sh DIR: other people's decoders, against which ours are held, from PyPI into a virtual
# environment in DIR, unless they are there.
#
# Always ends with 0: where they cannot be had the tests are skipped, and say so.
set -eu

decoders='natnet==0.3.0 qtm-rt==3.1.0'
done=$1/.complete

[ "$(cat "$done" 2>/dev/null)" != "$decoders" ] || exit 0
echo "Fetching decoders for tests/mocap:" $decoders
python3 -m venv --clear "$1" &&
    "$1/bin/pip" install --quiet --disable-pip-version-check $decoders &&
    echo "$decoders" >"$done" ||
    echo "No decoders for tests/mocap: what needs them will be skipped"
