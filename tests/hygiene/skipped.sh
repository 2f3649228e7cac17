#!/bin/sh
# skipped.sh ROOT  scripts/skipped.py counts what was skipped, and says why, by reason.
folder=$(mktemp -d) || exit 2
trap 'rm -r "$folder"' EXIT
cat > "$folder/tests.xml" <<'END'
<testsuite>
  <testcase name="a"><system-out>fine</system-out></testcase>
  <testcase name="b"><skipped message=""/><system-out>x.cpp:7: Skipped
real log mrclam is not here: /x/../shared/data
[  SKIPPED ] b</system-out></testcase>
  <testcase name="c"><skipped message=""/><system-out>y.cpp:9: Skipped
"/x/../shared/data/d" is not here</system-out></testcase>
  <testcase name="d"><skipped message=""/><system-out>z.cpp:1: Skipped
this machine has no AVX2</system-out></testcase>
</testsuite>
END
"$1/scripts/skipped.py" "$folder/tests.xml" > "$folder/told" || exit 1
cat > "$folder/expected" <<'END'
skipped: 3 of 4 tests, which say nothing of what they hold:
     2 real recordings are not here (../shared/data)
     1 this machine has no AVX2
END
diff "$folder/expected" "$folder/told" || exit 1
echo '<testsuite><testcase name="a"/></testsuite>' > "$folder/tests.xml"
test "$("$1/scripts/skipped.py" "$folder/tests.xml")" = "skipped: none of 1 tests"
