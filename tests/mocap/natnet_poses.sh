#!/bin/sh
# natnet_poses.sh PROGRAM DECODERS: what our decoder makes of frames of every version of NatNet
# against what another one does, the package natnet from PyPI. Skipped where DECODERS has none.
set -eu

python=$2/bin/python3
if ! "$python" -c 'import natnet' 2>/dev/null; then
    echo "skipped: there is no natnet in $2 (tests/mocap/get-decoders.sh)"
    exit 77
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$1" >"$work/poses"
"$python" "$(dirname "$0")/natnet_poses.py" "$work/poses"
