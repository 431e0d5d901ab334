#!/bin/sh
# package.sh CPACK BUILD ROOT: is the Debian package built, does it hold what it should, and does what is
# unpacked from it find its own files?
set -eu

cpack=$1
build=$2
root=$3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

fail() {
    echo "FAIL: $*"
    exit 1
}

"$cpack" --config "$build/CPackConfig.cmake" -B "$work" >log 2>&1 || {
    cat log
    fail 'cpack'
}
dpkg-deb -x muster_*.deb unpacked
dpkg-deb -f muster_*.deb Depends >depends

# What the tree has of each kind is in the package.
expected='usr/bin/muster usr/share/bash-completion/completions/muster usr/share/doc/muster/copyright
    usr/share/muster/muster.elf usr/share/muster/muster.hex
    usr/share/muster/loader.elf usr/share/muster/loader.hex usr/lib/udev/rules.d/60-muster.rules
    usr/lib/systemd/system/muster@.service'
for scenario in "$root"/scenarios/*.yaml; do
    expected="$expected usr/share/muster/scenarios/${scenario##*/}"
done
for example in "$root"/docs/examples/*; do
    expected="$expected usr/share/doc/muster/examples/${example##*/}"
done
for page in "$root"/docs/man/*.scd; do
    page=$(basename "$page" .scd)
    expected="$expected usr/share/man/man${page##*.}/$page.gz"
done
for file in $expected; do
    [ -s "unpacked/$file" ] || fail "no $file in the package"
done

# Nothing of the build machine's folders, and nobody's but root's.
dpkg-deb -c muster_*.deb >contents
grep -qv ' root/root ' contents && fail 'a file that is not root'\''s'
grep -q "$(printf '%s' "$root" | sed 's|^/||')" contents && fail 'a path of the source tree'
for library in libc6 libfyaml0 libmuparser2 libcminpack1 libbluetooth3 libsystemd0; do
    grep -q "$library" depends || fail "does not depend on $library"
done

# Unpacked anywhere, it runs its own image on its own scenarios.
unpacked/usr/bin/muster sim --quiet --no-trace --out run --set duration=0.1 \
    unpacked/usr/share/muster/scenarios/paper-law-straight.yaml || fail 'the installed muster does not run'
for example in unpacked/usr/share/doc/muster/examples/*; do
    unpacked/usr/bin/muster serve --check --quiet "$example" ||
        fail "${example##*/} is not good where it is installed"
done
rm unpacked/usr/share/muster/muster.elf
unpacked/usr/bin/muster sim --out run unpacked/usr/share/muster/scenarios/paper-law-straight.yaml \
    2>words && fail 'runs without its image'
grep -qF "$work/unpacked/usr/share/muster/muster.elf" words || fail "looks elsewhere: $(cat words)"
rm -r unpacked/usr/share/muster/scenarios
unpacked/usr/bin/muster paper --robots native --only 1 --out paper 2>words &&
    fail 'makes figures without scenarios'
grep -qF "$work/unpacked/usr/share/muster/scenarios" words || fail "looks elsewhere: $(cat words)"
