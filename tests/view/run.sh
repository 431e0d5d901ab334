#!/bin/sh
# run.sh TOOLS ARGUMENT...: node with what get-browser-tools.sh has put into TOOLS. Skipped where
# there is no node, or there are no tools.
set -eu

skip() {
    echo "skipped: $1"
    exit 77
}
command -v node >/dev/null || skip "there is no node"
[ -e "$1/.complete" ] || skip "there are no browser tools in $1 (tests/view/get-browser-tools.sh)"
export NODE_PATH="$1/node_modules"
shift
exec node "$@"
