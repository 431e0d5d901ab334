#!/bin/sh
# qtm_session.sh PROGRAM DECODERS: what our decoder makes of a session with QTM against what
# Qualisys' own decoder does, the package qtm-rt from PyPI. Skipped where DECODERS has none.
set -eu

python=$2/bin/python3
if ! "$python" -c 'import qtm_rt' 2>/dev/null; then
    echo "skipped: there is no qtm-rt in $2 (tests/mocap/get-decoders.sh)"
    exit 77
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$1" "$work/stream" "$work/poses.csv"
"$python" "$(dirname "$0")/qtm_session.py" "$work/stream" "$work/poses.csv"
