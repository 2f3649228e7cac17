#!/usr/bin/env bash
# manuals_test.sh PROGRAM SCRIPTS  man pages and completion tell what the program says of itself.
set -euo pipefail
program=$1
scripts=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { echo "$*"; exit 1; }

"$program" --describe > "$work/description.json"
"$scripts/manuals.py" "$work/description.json" 1.2.3 "$work"
commands=$(wc -l < "$work/description.json")
pages=$(find "$work/man" -name '*.1.gz' | wc -l)
[[ $pages == $((commands + 1)) ]] || fail "$pages pages for $commands commands and the program"
page=$(zcat "$work/man/ortung-show.1.gz")
for text in '.TH ORTUNG-SHOW 1 "" "Ortung 1.2.3"' '\fB\-\-scale\fR \fIauto|linear|log\fR' 'default: auto' '.SH SEE ALSO'; do
  [[ $page == *"$text"* ]] || fail "ortung-show.1 lacks $text: $page"
done
# Every option of every command stands in its page.
python3 - "$work" <<'END'
import gzip, json, pathlib, sys
work = pathlib.Path(sys.argv[1])
for line in (work / "description.json").read_text().splitlines():
    command = json.loads(line)
    page = gzip.decompress((work / "man" / (command["name"].replace(" ", "-") + ".1.gz")).read_bytes()).decode()
    for option in command["options"]:
        for name in option["names"]:
            assert "\\fB" + name.replace("-", "\\-") + "\\fR" in page, (command["name"], name)
    assert not any(part.startswith("'") for part in page.splitlines()), command["name"]
END
"$scripts/manuals.py" "$work/description.json" 1.2.3 "$work/again"
diff -r "$work/man" "$work/again/man" || fail "the same description makes other pages"

# shellcheck disable=SC1091  # made above
source "$work/completions/ortung.bash"
completed() { # completed WORD...  what is offered for the last word
  COMP_WORDS=("$@")
  COMP_CWORD=$(($# - 1))
  _ortung
  echo "${COMPREPLY[*]-}"
}
expect() {
  local expected=$1 found
  shift
  found=$(completed "$@")
  [[ $found == "$expected" ]] || fail "for '$*' offered: '$found', expected '$expected'"
}
expect 'learn learn-motion' ortung lea
expect 'map mcap' ortung export m
expect '--scale' ortung show --sc
expect 'auto linear log' ortung show --scale ''
expect '--height' ortung export map --hei
cd "$work"
touch run.rec
expect 'run.rec' ortung check ru
for shell in zsh fish; do
  command -v $shell > /dev/null || continue
  file=$work/completions/_ortung
  [[ $shell == zsh ]] || file=$work/completions/ortung.fish
  $shell -n "$file" || fail "$shell does not read its completion"
done
