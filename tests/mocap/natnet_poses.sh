#!/bin/sh
# natnet_poses.sh PROGRAM: what our decoder makes of frames of every version of NatNet against what
# another one does, the package natnet from PyPI. Skipped where python3 does not have it.
set -eu

if ! python3 -c 'import natnet' 2>/dev/null; then
    echo "skipped: python3 has no natnet (python3 -m pip install natnet, in a venv that is in PATH)"
    exit 77
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$1" >"$work/poses"
python3 "$(dirname "$0")/natnet_poses.py" "$work/poses"
