#!/usr/bin/env bash
# check-abi.sh [TAG]  whether programs that were linked with the last release of this minor version work with the
# libraries as they are now. Builds a robot's libraries of both in build/abi and compares by abidiff what public
# headers declare; additions are fine. Ends with 1 after a change that is not, with 0 if there is no such release yet.
# STABILITY.md says what is promised.
set -euo pipefail
cd "$(dirname "$0")/.."
root=$PWD
version=$(sed -nE 's/^project\(ortung VERSION ([0-9.]+).*/\1/p' CMakeLists.txt)
minor=${version%.*}
tag=${1:-$(git tag --list "v$minor.*" --sort=-v:refname | head -n 1)}
if [[ -z $tag ]]; then
  echo "check-abi: there is no release of $minor yet, so there is nothing to keep"
  exit 0
fi
git rev-parse --quiet --verify "$tag^{commit}" >/dev/null || { echo "check-abi: there is no tag $tag" >&2; exit 2; }
command -v abidiff >/dev/null || { echo "check-abi: abidiff is not there: install abigail-tools" >&2; exit 2; }

folder=$root/build/abi
mkdir -p "$folder"
# The old sources are a worktree, which goes whatever happens.
forget() { git -C "$root" worktree remove --force "$folder/then" 2>/dev/null || true; }
trap forget EXIT
forget
rm -rf "$folder/then"
git worktree prune
git worktree add --quiet --detach "$folder/then" "$tag"

# A robot's libraries, with all that debug information tells of them; how they are optimized does not matter. Both builds
# lie at the same place below their sources, so that ccache finds what did not change.
build() { # build SOURCE NAME
  export CCACHE_BASEDIR=$1 CCACHE_NOHASHDIR=1
  (cd "$1" && cmake --preset robot -B build/abi/built -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS_DEBUG="-O0 -g" \
    -DBUILD_SHARED_LIBS=ON && cmake --build build/abi/built --target container/all mcl/all sim/all) \
    >"$folder/$2.log" 2>&1 ||
    { tail -n 20 "$folder/$2.log" >&2; echo "check-abi: $2 can't be built, see $folder/$2.log" >&2; exit 2; }
}
build "$folder/then" then
build "$root" now
public_headers() { # public_headers NUMBER SOURCE
  find "$2"/{container,mcl,sim} "$2/build/abi/built" -type d -name include -printf "--headers-dir$1\n%p\n"
}
mapfile -t headers < <(public_headers 1 "$folder/then"; public_headers 2 "$root")

status=0
compared=0
for old in "$folder"/then/build/abi/built/lib/libortung_*.so; do
  name=$(basename "$old")
  new=$folder/built/lib/$name
  compared=$((compared + 1))
  if [[ ! -e $new ]]; then
    echo "check-abi: $name of $tag is gone"
    status=1
    continue
  fi
  result=0
  abidiff --no-added-syms "${headers[@]}" "$old" "$new" >"$folder/$name.txt" 2>&1 || result=$?
  if ((result & 3)); then # abidiff itself failed
    cat "$folder/$name.txt" >&2
    exit 2
  elif ((result)); then
    cat "$folder/$name.txt"
    echo "check-abi: $name is not what programs linked with $tag expect"
    status=1
  fi
done
((compared)) || { echo "check-abi: $tag has no libraries" >&2; exit 2; }
((status)) || echo "check-abi: $compared libraries keep what $tag promised"
exit $status
