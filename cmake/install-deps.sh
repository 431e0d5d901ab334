#!/bin/sh
# install-deps.sh TASK...: installs the Debian packages that the tasks need and that are missing.
# Tasks: host (build muster), demo, firmware, flash, package, test, bench (beside what test needs).
set -eu

build='cmake ninja-build'
host="$build gcc libc6-dev pkg-config libsimavr-dev libelf-dev libfyaml-dev libmuparser-dev libbluetooth-dev
    libcminpack-dev libjansson-dev libsystemd-dev libwebsockets-dev libzstd-dev zlib1g-dev"
firmware="$build gcc-avr binutils-avr avr-libc"
package='scdoc gzip file dpkg-dev'
checks="$package gnuplot-nox avrdude clang-14 libclang-rt-14-dev qemu-system-x86 cpio xz-utils
    python3-venv chromium"
# These are often had from elsewhere.
command -v node >/dev/null || checks="$checks nodejs"
command -v npm >/dev/null || checks="$checks npm"

packages=
for task; do
    case $task in
    host) packages="$packages $host" ;;
    demo) packages="$packages $host $firmware gnuplot-nox" ;;
    firmware) packages="$packages $firmware" ;;
    flash) packages="$packages $host $firmware avrdude" ;;
    package) packages="$packages $host $firmware $package" ;;
    test) packages="$packages $host $firmware $checks" ;;
    bench) packages="$packages mosquitto" ;;
    *)
        echo "install-deps.sh: $task: no such task" >&2
        exit 2
        ;;
    esac
done
packages=$(printf '%s\n' $packages | sort -u)

if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
    echo "Not a Debian system: see to it that there is what these packages hold:" $packages
    exit 0
fi

installed=$(dpkg-query -W -f '${Package} ${db:Status-Status}\n' $packages 2>/dev/null |
    sed -n 's/ installed$//p' | sort -u)
missing=$(printf '%s\n' $packages | grep -vxF "$installed" || true)
[ -n "$missing" ] || exit 0

if [ "$(id -u)" -eq 0 ]; then
    as_root=env
elif command -v sudo >/dev/null; then
    as_root='sudo env'
else
    echo "These packages are missing, and there is no sudo to install them. As root, type:" >&2
    echo "    apt-get update && apt-get install --no-install-recommends" $missing >&2
    exit 1
fi

echo "Installing" $missing
$as_root apt-get -q update
$as_root DEBIAN_FRONTEND=noninteractive apt-get -qy install --no-install-recommends $missing
