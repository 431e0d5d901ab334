#!/bin/sh
# get-kernel.sh DIR: puts into DIR what tests/rfcomm boots, unless it is there: Debian's kernel with
# its modules in the order in which they load, a shell, and hciconfig. Nothing is installed.
#
# Always ends with 0: whoever has no such packages is told so, and the test is skipped.
set -eu

dir=$1
[ ! -f "$dir/vmlinux" ] || exit 0

# The first that can be had. 6.1.0-55 and -56 are not among them: they crash when a robot that is
# absent is dialled.
kernels='6.1.0-50 6.1.0-54 6.1.0-53 6.1.0-47'

# In the order in which one needs the other. A module that a kernel has built in is not missed.
modules='virtio virtio_ring virtio_pci_legacy_dev virtio_pci_modern_dev virtio_pci
    netfs fscache 9pnet 9pnet_virtio 9p overlay
    crc16 rfkill ecc ecdh_generic bluetooth rfcomm hci_vhci'

give_up() {
    echo "No kernel for tests/rfcomm, which will be skipped: $*"
    exit 0
}

[ "$(dpkg --print-architecture 2>/dev/null)" = amd64 ] || give_up "it takes Debian on amd64"
for command in apt-get xz; do
    command -v $command >/dev/null || give_up "there is no $command"
done

work=$(mktemp -d)
trap 'rm -rf "$work"; exit 0' EXIT
chmod 755 "$work"
mkdir "$work/debs" "$work/root" "$work/lists" "$work/kernel" "$work/kernel/modules"
[ "$(id -u)" -ne 0 ] || chown _apt "$work/debs" # the user that apt downloads as

# download OPTION...: the tools, and the first of the kernels that there is.
download() (
    cd "$work/debs"
    apt-get "$@" -qq download busybox-static bluez || return 1
    for kernel in $kernels; do
        ! apt-get "$@" -qq download "linux-image-$kernel-amd64" || return 0
    done
    return 1
)

# With package lists of its own where the machine's are missing or too old.
download_anew() {
    cat >"$work/apt.conf" <<END_OF_CONF
Dir::State::Lists "$work/lists";
#clear APT::Update::Post-Invoke;
#clear APT::Update::Post-Invoke-Success;
END_OF_CONF
    apt-get -c "$work/apt.conf" -qq update && download -c "$work/apt.conf"
}

echo "Fetching a kernel for tests/rfcomm"
download 2>/dev/null || download_anew >"$work/log" 2>&1 ||
    give_up "apt says: $(grep -m 1 '^[EW]: ' "$work/log")"

for deb in "$work"/debs/*.deb; do
    case $deb in
    */busybox*) files=./bin/busybox ;;
    */bluez*) files=./bin/hciconfig ;;
    */linux-image*) files='./boot/vmlinuz-* *.ko' ;;
    esac
    # Unquoted, but for tar to match.
    (set -f && dpkg-deb --fsys-tarfile "$deb" | tar -x -C "$work/root" --wildcards $files)
done
cp "$work"/root/bin/* "$work/kernel"

number=10
for module in $modules; do
    found=$(find "$work/root/lib" -name "$module.ko")
    [ -z "$found" ] || cp "$found" "$work/kernel/modules/$number-$module.ko"
    number=$((number + 1))
done

# number_at OFFSET TYPE: a number out of the header of the kernel.
number_at() {
    od -A n -j "$1" -N "${2#u}" -t "$2" "$image" | tr -d ' '
}

# What unpacks itself takes seconds to do so in an emulator. The header says where the packed kernel
# is (boot protocol 2.08): number of sectors before, offset and length.
image=$(echo "$work"/root/boot/vmlinuz-*)
start=$((($(number_at 497 u1) + 1) * 512 + $(number_at 584 u4)))
tail -c +$((start + 1)) "$image" | head -c "$(number_at 588 u4)" |
    xz -dc --single-stream >"$work/kernel/vmlinux" || give_up "${image##*/} is not packed by xz"

mkdir -p "$(dirname "$dir")"
rm -rf "$dir"
mv "$work/kernel" "$dir"
