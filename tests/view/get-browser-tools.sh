#!/bin/sh
# get-browser-tools.sh DIR: what drives a browser, judges how accessible a page is, and speaks
# Foxglove's protocol as Foxglove does, from npm into DIR, unless it is there. The newest that run
# on Debian 12's node. The browser itself is Debian's.
#
# Always ends with 0: where they cannot be had the tests are skipped, and say so.
set -eu

tools='playwright-core@1.61.1 ws@8.23.0 axe-core@4.14.1
    @foxglove/ws-protocol@0.8.0 @foxglove/rosmsg@5.0.5 @foxglove/rosmsg2-serialization@2.0.4'
done=$1/.complete

[ "$(cat "$done" 2>/dev/null)" != "$tools" ] || exit 0
echo "Fetching browser tools for tests/view:" $tools
mkdir -p "$1" &&
    npm install --prefix "$1" --no-save --no-package-lock --ignore-scripts --no-audit --no-fund \
        --loglevel=error --fetch-retries=1 $tools &&
    echo "$tools" >"$done" ||
    echo "No browser tools for tests/view: what needs them will be skipped"
