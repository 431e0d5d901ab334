#!/bin/sh
# fetch-unity.sh DIR: unpacks the unit test framework Unity into DIR, unless it is there.
#
# Debian has no package of it, but the source package cjson carries it. Source packages are often
# switched off, so this reads the machine's own sources with deb in them turned into deb-src. All
# of apt's state is a temporary folder: nothing on the machine changes, and root is not needed.
set -eu

dir=$1
[ ! -f "$dir/src/unity.c" ] || exit 0

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
chmod 755 "$work"
mkdir "$work/sources" "$work/lists" "$work/cache" "$work/unity"
[ "$(id -u)" -ne 0 ] || chown _apt "$work/cache" # the user that apt downloads as

eval "$(apt-config shell list Dir::Etc::SourceList/f parts Dir::Etc::SourceParts/d)"
for file in "$list" "$parts"/*.list "$parts"/*.sources; do
    [ -f "$file" ] || continue
    case $file in
    *.list) sed -n 's/^[[:space:]]*deb[[:space:]]/deb-src /p' "$file" ;;
    *.sources) sed 's/^[Tt]ypes:.*/Types: deb-src/' "$file" ;;
    esac >"$work/sources/$(basename "$file")"
done

# Hooks on an update see to the machine's package lists, and this one does not touch those.
cat >"$work/apt.conf" <<END
Dir::Etc::SourceList "/dev/null";
Dir::Etc::SourceParts "$work/sources";
Dir::State::Lists "$work/lists";
Dir::Cache "$work/cache";
#clear APT::Update::Post-Invoke;
#clear APT::Update::Post-Invoke-Success;
END

echo "Fetching Unity, in the Debian source package cjson"
(
    cd "$work/cache"
    apt-get -c "$work/apt.conf" -qq update
    apt-get -c "$work/apt.conf" -qq source --download-only cjson
)
tar -xf "$work"/cache/cjson_*.orig.tar.* -C "$work/unity" --strip-components=3 \
    --wildcards '*/tests/unity/*'

mkdir -p "$(dirname "$dir")"
rm -rf "$dir"
mv "$work/unity" "$dir"
