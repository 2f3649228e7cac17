#!/usr/bin/env bash
# hooks_test.sh HOOKS  the hooks for git refuse what they should, in a repository of its own.
set -euo pipefail
hooks=$(realpath "$1")
command -v git >/dev/null || { echo "skipped: git is not installed"; exit 77; }
repository=$(mktemp -d)
trap 'rm -rf "$repository"' EXIT
cd "$repository"
export GIT_CONFIG_GLOBAL=/dev/null GIT_CONFIG_NOSYSTEM=1 GIT_AUTHOR_NAME=a GIT_AUTHOR_EMAIL=a@b.c GIT_COMMITTER_NAME=a GIT_COMMITTER_EMAIL=a@b.c
git init -q .
git config core.hooksPath "$hooks"
cat > .clang-format <<<'BasedOnStyle: Google'
git add . && git commit -qm "style: Google's"

refused() {
  if git commit -qm "$1" 2> why; then echo "a commit was let through: $1"; exit 1; fi
  grep -q "$2" why || { echo "expected '$2' in:"; cat why; exit 1; }
}
echo 'int one = 1;' > one.cpp && git add one.cpp
refused "one" "expected 'folder: what it does now'"
git commit -qm "one: is there"
seq -f 'line %.0f' 150 > long.txt && git add long.txt
refused "text: many lines" "its body gives no reason"
git commit -qm "text: many lines" -m "Since a test wants them."
git mv long.txt moved.txt
git commit -qm "text: only moved"
if command -v "${CLANG_FORMAT:-clang-format-19}" >/dev/null; then
  echo 'int   two=2;' > two.cpp && git add two.cpp
  refused "two: is there" "not formatted"
fi
git reset -q --hard
git commit -q --no-verify --allow-empty -m "nobody says where"
if "$hooks/commit-msg" --check HEAD~1..HEAD > why; then echo "a range was let through"; exit 1; fi
grep -q "nobody says where" why
"$hooks/commit-msg" --check HEAD~3..HEAD~1
echo "the hooks refuse what they should"
