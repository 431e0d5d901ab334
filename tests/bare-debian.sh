#!/bin/sh
# bare-debian.sh [TARGET...]: does `make TARGET` work by itself on a fresh Debian 12?
#
# For each target (by default demo and test) makes a minimal Debian 12 with git and make in a
# temporary folder, clones the checkout's HEAD into it and types `make TARGET` there. Needs root
# and mmdebstrap. Packages come from where this machine gets its own, by the same settings of apt.
set -eu

[ $# -gt 0 ] || set -- demo test

[ "$(id -u)" -eq 0 ] || { echo "bare-debian.sh: must be run as root" >&2; exit 2; }
command -v mmdebstrap >/dev/null || { echo "bare-debian.sh: needs mmdebstrap" >&2; exit 2; }

checkout=$(cd "$(dirname "$0")/.." && pwd)
work=$(mktemp -d)
chmod 755 "$work"
trap 'rm -rf "$work"' EXIT
trap 'exit 1' HUP INT TERM

# The mirrors that are Debian's; where none are known, before a first apt-get update, mmdebstrap
# takes its own.
apt-get indextargets --format 'deb $(REPO_URI) $(RELEASE) $(COMPONENT)' \
    'Created-By: Packages' 'Origin: Debian' | grep ' bookworm' | sort -u >"$work/mirrors.list" || true
[ -s "$work/mirrors.list" ] && mirrors=$work/mirrors.list || mirrors=
apt-config dump | grep '^Acquire::' | grep -v '^Acquire::IndexTargets' >"$work/acquire.conf" || true

make_root() {
    mmdebstrap --quiet --variant=minbase --include=git,make --aptopt="$work/acquire.conf" \
        --setup-hook='mkdir -p "$1/etc/apt" "$1/etc/ssl/certs"
            for file in /etc/hosts /etc/apt/auth.conf* /etc/ssl/certs/ca-certificates.crt; do
                [ ! -e "$file" ] || cp -a "$file" "$1$(dirname "$file")"
            done' \
        bookworm "$1" ${mirrors:+"$mirrors"}
    git clone --quiet "$checkout" "$1/root/muster"
}

# The mounts are in a namespace of their own, so that nothing of them can outlive the command.
run_in_root() {
    unshare --mount sh -eu -c '
        mount -t proc proc "$1/proc"
        mount --rbind /dev "$1/dev"
        exec chroot "$1" env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin \
            ${http_proxy:+http_proxy="$http_proxy"} ${https_proxy:+https_proxy="$https_proxy"} \
            make -C /root/muster "$2"' sh "$1" "$2"
}

# What must be there afterwards, besides an exit status of 0.
left_behind() {
    case $2 in
    demo) for file in summary.json routes.png routes.svg distance_error.png distance_error.svg; do
        [ -s "$1/root/muster/runs/paper-sim-leader-fault-1/$file" ] || return 1
    done ;;
    esac
}

status=0
for target; do
    root=$work/$target
    echo "=== make $target: making a bare Debian 12"
    make_root "$root"
    echo "=== make $target: running it there"
    if run_in_root "$root" "$target" && left_behind "$root" "$target"; then
        echo "=== make $target: works on a bare Debian 12"
    else
        echo "=== make $target: FAILS on a bare Debian 12"
        status=1
    fi
    rm -rf "$root"
done
exit $status
