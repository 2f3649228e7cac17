#!/bin/sh
# reports.sh FOLDER  fails if a sanitizer left a report in FOLDER, and shows it. Programs that a test starts
# write there, too: those whose messages nobody reads, and those that were expected to fail.
status=0
for report in "$1"/*; do
  [ -f "$report" ] || continue
  echo "== $report"
  head -n 60 "$report"
  status=1
done
exit $status
