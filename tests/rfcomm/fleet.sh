#!/bin/sh
# fleet.sh MUSTER CONTROLLER KERNEL: boots a machine that has Bluetooth and judges guest.sh, which runs
# in it. KERNEL is a folder made by get-kernel.sh; where it is missing the test is skipped: 77.
set -eu

muster=$1
controller=$2
kernel=$3
here=$(cd "$(dirname "$0")" && pwd)

skip() {
    echo "SKIPPED: $*"
    exit 77
}

[ -f "$kernel/vmlinux" ] || skip "no kernel in $kernel; make deps fetches it, or says why it cannot"
for command in qemu-system-x86_64 cpio; do
    command -v $command >/dev/null || skip "there is no $command; make deps installs it"
done

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
trap 'exit 1' HUP INT TERM

mkdir -p "$work/root/bin" "$work/root/proc" "$work/root/host" "$work/root/over"
cp -r "$kernel/modules" "$work/root"
cp "$kernel/busybox" "$work/root/bin"
cp "$here/init" "$work/root"
echo "chroot . /bin/sh '$here/guest.sh' '$muster' '$controller' '$kernel/hciconfig'" >"$work/root/job"
(cd "$work/root" && find . | cpio -o -H newc --quiet) >"$work/initramfs"

# Emulated throughout: a /dev/kvm that only looks like one would hang.
timeout 150 qemu-system-x86_64 -accel tcg -machine pc -m 512 -nodefaults -display none -no-reboot \
    -serial stdio -kernel "$kernel/vmlinux" -initrd "$work/initramfs" \
    -append 'console=ttyS0 quiet oops=panic panic=-1 reboot=t mitigations=off nokaslr cryptomgr.notests' \
    -virtfs local,path=/,mount_tag=host,security_model=none,readonly=on,multidevs=remap \
    </dev/null 2>&1 | tr -d '\r' | tee "$work/console"

# QEMU ends with 0 whatever happened in there.
grep -q '^GUEST_RC=0$' "$work/console" || {
    echo "FAIL: the guest did not end well, or not within 150 s"
    exit 1
}
