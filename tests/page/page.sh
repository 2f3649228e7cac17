#!/usr/bin/env bash
# page.sh ROOT PROGRAM  The viewer's page: types, unit tests, what is committed is what the source makes, and Chromium
# with the real program. Skipped (77) without Node.js 20.19, npm's registry or Chromium.
set -euo pipefail
cd "$1/board/web/page"
skip() {
  printf 'page.sh: Skipped\n%s\n' "$1"
  exit 77
}
node -e 'const [a, b] = process.versions.node.split(".").map(Number); process.exit(a > 20 || (a === 20 && b >= 19) ? 0 : 1)' \
  2>/dev/null || skip "this machine has no Node.js 20.19 or later"
[[ -x ${CHROMIUM:-/usr/bin/chromium} ]] || skip "this machine has no Chromium"
if [[ ! -d node_modules || package-lock.json -nt node_modules/.package-lock.json ]]; then
  npm ci --no-fund --no-audit --loglevel=error --fetch-retries=0 || skip "npm's registry is not here"
fi
npx tsc --noEmit
npx vitest run
folder=$(mktemp -d)
trap 'rm -r "$folder"' EXIT
npx vite build --outDir "$folder" --logLevel warn
diff -rq "$folder" ../built || { echo "board/web/built is not what board/web/page makes: npm run build"; exit 1; }
most=153600 # bytes of gzip, without what is loaded when it is asked for
size=$(cat ../built/index.html ../built/page.js ../built/page.css | gzip -9 | wc -c)
((size <= most)) || { echo "the page has $size bytes of gzip, more than $most"; exit 1; }
ORTUNG=$2 node --test --test-force-exit --test-reporter=spec e2e/*.test.mjs
