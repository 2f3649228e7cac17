#!/usr/bin/env bash
# lint.sh --format   whether all sources are formatted as .clang-format says; seconds
# lint.sh [FILE...]  that, and clang-tidy with our .clang-tidy; all sources without a file, which takes minutes
# lint.sh --changed  that, of the sources that changed since it last found nothing on this machine: at most 40 of them,
#                    the newest ones first
set -euo pipefail
cd "$(dirname "$0")/.."
format=${CLANG_FORMAT:-clang-format-19}
command -v "$format" >/dev/null || { echo "lint: $format is not there: install it, or set CLANG_FORMAT" >&2; exit 1; }
git ls-files -z '*.cpp' '*.hpp' '*.c' '*.h' | xargs -0 "$format" --dry-run --Werror
[[ ${1:-} != --format ]] || { echo "lint: all files are formatted"; exit 0; }
tidy=${CLANG_TIDY:-clang-tidy-19}
command -v "$tidy" >/dev/null || { echo "lint: $tidy is not there: install it, or set CLANG_TIDY" >&2; exit 1; }

# Generated headers are there once configured; nothing has to be built.
cmake --preset dev -B build/lint -DORTUNG_BENCH=ON >/dev/null
marker=${XDG_CACHE_HOME:-$HOME/.cache}/ortung/linted
if [[ ${1:-} == --changed ]]; then
  last=$(cat "$marker" 2>/dev/null || true)
  git merge-base --is-ancestor "${last:-none}" HEAD 2>/dev/null || last=$(git rev-list --max-count=20 HEAD | tail -1)
  # Sources that are compiled here; what is not has no commands for clang-tidy.
  mapfile -t files < <(git log --name-only --format= "$last..HEAD" -- '*.cpp' | awk '!seen[$0]++' |
    while read -r file; do grep -qF "\"$PWD/$file\"" build/lint/compile_commands.json && echo "$PWD/$file"; done | head -40)
elif (($# == 0)); then
  mapfile -t files < <(grep -oP '"file": "\K[^"]+\.cpp(?=")' build/lint/compile_commands.json | grep -vF "$PWD/build/" | sort -u)
else
  files=("$@")
fi
((${#files[@]} == 0)) || printf '%s\0' "${files[@]}" | xargs -0 -n 1 -P "$(nproc)" "$tidy" --quiet -p build/lint
if [[ ${1:-} == --changed ]]; then
  mkdir -p "${marker%/*}"
  git rev-parse HEAD > "$marker"
fi
echo "lint: ${#files[@]} files are clean"
