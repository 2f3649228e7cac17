#!/usr/bin/env bash
# check-packages.sh [--update]  builds the Debian packages and looks at them: what they depend on and hold, as written
# down in tests/packages (--update writes it anew), that packing twice makes the same bytes, what lintian says. Then, for
# root and where debootstrap is, installs them on a bare Debian 12, does the main job there, upgrades, removes them.
# shellcheck disable=SC2317  # functions are called by name
set -euo pipefail
cd "$(dirname "$0")/.."
export LC_ALL=C
build=$PWD/build/package
packages=$build/packages
golden=tests/packages
status=0
say() { echo "check-packages: $*"; }

cmake --preset package > /dev/null
cmake --build --preset package
rm -f "$packages"/*.deb
(cd "$build" && cpack -G DEB > "$packages/cpack.log" 2>&1) || { cat "$packages/cpack.log"; exit 1; }
say "$(find "$packages" -maxdepth 1 -name '*.deb' | wc -l) packages after $SECONDS s"

# What is needed, and which programs, libraries and plugins are in it: without versions of others, with "(=)" of ours.
relations() {
  local field
  for field in Depends Recommends Suggests; do
    dpkg-deb -f "$1" "$field" | tr , '\n' |
      sed -E "s/^ *//; s/ \(= [^)]*\)/ (=)/; s/ \([<>][^)]*\)//g; /^$/d; s/^/$field: /" | sort -u
  done
}
contents() {
  dpkg-deb --fsys-tarfile "$1" | tar -t | sed -nE 's|^\./usr/((bin\|lib\|libexec)/.*[^/])$|\1|p' |
    sed -E "s/$(dpkg-architecture -qDEB_HOST_MULTIARCH)/MULTIARCH/; s/\.so\.[0-9]+\.[0-9]+(\.[0-9]+)?$/.so.VERSION\1/
            s/\.VERSION\.[0-9]+$/.FULL_VERSION/" | sort
}
for deb in "$packages"/*.deb; do
  name=$(dpkg-deb -f "$deb" Package)
  for kind in relations contents; do
    file=$golden/$name.${kind/relations/depends}
    $kind "$deb" > "$packages/now"
    if [[ ${1:-} == --update ]]; then
      if [[ -s $packages/now ]]; then cp "$packages/now" "$file"; else rm -f "$file"; fi
    elif [[ -e $file || -s $packages/now ]] && ! diff -u --label "$file" --label "of the package" \
        "$([[ -e $file ]] && echo "$file" || echo /dev/null)" "$packages/now"; then
      status=1
    fi
  done
done
for file in "$golden"/*.depends "$golden"/*.contents; do
  name=$(basename "${file%.*}")
  compgen -G "$packages/${name}_*.deb" > /dev/null || { say "there is no package $name ($file)"; status=1; }
done
((status == 0)) || say "if this is meant: scripts/check-packages.sh --update"

# Whatever an install puts somewhere is in exactly one package.
rm -rf "$packages/whole"
DESTDIR=$packages/whole cmake --install "$build" > /dev/null
(cd "$packages/whole" && find . ! -type d ! -name LICENSE | sort) > "$packages/whole.txt"
for deb in "$packages"/*.deb; do
  dpkg-deb --fsys-tarfile "$deb" | tar -t | sed '/\/$/d'
done | sort > "$packages/packed.txt"
! uniq -d "$packages/packed.txt" | grep . || { say "the files above are in two packages"; status=1; }
! comm -23 "$packages/whole.txt" "$packages/packed.txt" | grep . ||
  { say "the files above are in no package"; status=1; }
rm -rf "$packages/whole"

# The same bytes each time, without paths of this machine.
(cd "$build" && cpack -G DEB -B "$packages/again" > "$packages/cpack.log" 2>&1) ||
  { cat "$packages/cpack.log"; exit 1; }
for deb in "$packages"/*.deb; do
  cmp "$deb" "$packages/again/$(basename "$deb")" || { say "packing again makes other bytes"; status=1; }
  ! dpkg-deb --fsys-tarfile "$deb" | grep -aoF -m 1 "$PWD" ||
    { say "$(basename "$deb") knows where it was built"; status=1; }
done
rm -rf "$packages/again"

# Whatever lintian warns of has a reason in cmake/packages/*.lintian-overrides; five kinds at most.
lintian --allow-root --fail-on error,warning --tag-display-limit 0 "$packages"/*.deb || status=1
kinds=$(grep -hv '^#' cmake/packages/*.lintian-overrides | sed -E 's/^[^:]*: *//; s/ .*//' | sort -u)
(($(wc -w <<< "$kinds") <= 5)) || { say "too many kinds of warnings are overridden: $kinds"; status=1; }
say "looked at after $SECONDS s"

if [[ $(id -u) != 0 ]]; then
  say "not root: SKIPPED installing on a bare Debian 12"
elif ! command -v debootstrap > /dev/null; then
  say "no debootstrap (scripts/install-deps.sh): SKIPPED installing on a bare Debian 12"
elif ! unshare --mount --propagation private true 2> /dev/null; then
  say "nothing may be mounted here: SKIPPED installing on a bare Debian 12"
else
  unshare --mount --propagation private tests/packages/bare.sh "$packages" || status=1
fi
if ((status == 0)); then say "all is well after $SECONDS s"; else say "failed"; fi
exit $status
