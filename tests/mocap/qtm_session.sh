#!/bin/sh
# qtm_session.sh PROGRAM: what our decoder makes of a session with QTM against what Qualisys' own
# decoder does, the package qtm_rt from PyPI. Skipped where python3 does not have it.
set -eu

if ! python3 -c 'import qtm_rt' 2>/dev/null; then
    echo "skipped: python3 has no qtm_rt (python3 -m pip install qtm-rt, in a venv that is in PATH)"
    exit 77
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$1" "$work/stream" "$work/poses.csv"
python3 "$(dirname "$0")/qtm_session.py" "$work/stream" "$work/poses.csv"
