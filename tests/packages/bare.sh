#!/usr/bin/env bash
# bare.sh PACKAGES  runs inside.sh on a bare Debian 12 with these packages. For root, in a mount namespace of its own,
# with which its mounts end. Debian comes from where this machine's apt gets it, and is kept in ~/.cache/ortung.
set -euo pipefail
packages=$1
here=$(cd "$(dirname "$0")" && pwd)
cache=${XDG_CACHE_HOME:-$HOME/.cache}/ortung
base=$cache/bookworm-$(dpkg --print-architecture).tar.zst
mkdir -p "$cache/archives/partial" "$cache/lists/partial"

# shellcheck disable=SC2016  # apt's own variables
targets=$(apt-get indextargets --format '$(ORIGIN) $(REPO_URI) $(RELEASE) $(COMPONENT)' 'Created-By: Packages' |
  awk '$1 == "Debian" && $3 ~ /^bookworm/ { print "deb", $2, $3, $4 }' | sort -u)
mirror=$(awk '$3 == "bookworm" && $4 == "main" { print $2 }' <<< "$targets" | head -1)
[[ -n $mirror ]] || { echo "bare.sh: this machine's apt knows no Debian 12: SKIPPED"; exit 0; }

root=$(mktemp -d)
chmod 755 "$root"
mounted=()
leave() {
  ((${#mounted[@]} == 0)) || umount "${mounted[@]}" || return 0  # then it is not ours to remove
  rm -rf --one-file-system "$root"
}
trap leave EXIT
if [[ ! -e $base ]]; then
  include=()
  [[ $mirror != https:* ]] || include=(--include=ca-certificates)
  debootstrap --variant=minbase "${include[@]}" bookworm "$root" "$mirror" > "$cache/debootstrap.log" ||
    { tail -5 "$cache/debootstrap.log"; exit 1; }
  rm -f "$root"/var/cache/apt/archives/*.deb
  tar -C "$root" -I zstd -cf "$base.part" .
  mv "$base.part" "$base"
else
  tar -C "$root" -I zstd -xpf "$base"
fi

cp /etc/resolv.conf /etc/hosts "$root/etc/"
echo "$targets" > "$root/etc/apt/sources.list"
apt-config dump Acquire | grep -i '::Proxy' > "$root/etc/apt/apt.conf.d/proxy" || true
printf '#!/bin/sh\nexit 101\n' > "$root/usr/sbin/policy-rc.d"  # no services
chmod +x "$root/usr/sbin/policy-rc.d"
mkdir "$root/packages" "$root/packages/newer"
cp "$packages"/*.deb "$here/inside.sh" "$root/packages/"

# The same once more, as a later version.
for deb in "$packages"/*.deb; do
  version=$(dpkg-deb -f "$deb" Version)
  dpkg-deb --raw-extract "$deb" "$root/newer"
  sed -i -E "s/(Version: |\(= )$version/\1$version+newer/g" "$root/newer/DEBIAN/control"
  dpkg-deb --root-owner-group -Znone --build "$root/newer" "$root/packages/newer" > /dev/null
  rm -rf "$root/newer"
done

mounts() {
  mount "${@:1:$#-1}" "$root/${!#}"
  mounted+=("$root/${!#}")
}
mounts --bind "$cache/archives" var/cache/apt/archives
mounts --bind "$cache/lists" var/lib/apt/lists
mounts -t proc proc proc
mounts -t tmpfs tmpfs tmp
mounts --bind /dev dev
env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive \
  ${http_proxy:+http_proxy="$http_proxy"} ${https_proxy:+https_proxy="$https_proxy"} \
  chroot "$root" sh /packages/inside.sh
