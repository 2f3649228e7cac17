#!/bin/sh
# formats.sh ROOT  outside of the container nobody asks a feature for its class, but where a comment above says why; and
#                  help texts are shown to people, where they are listed here, and read by no program.
cd "$1" || exit 2
most=3
found=$(grep -rnE 'dynamic_cast<(const )?[A-Za-z]*Data *[*&]' container/robot container/records mcl sim realsensors plugins app python \
          --include=*.cpp --include=*.hpp)
count=$(echo "$found" | grep -c .)
status=0
if [ "$count" -gt "$most" ]; then
  echo "$count casts to the class of a format, at most $most are expected; ask by its format (isOf, readingAs):"
  echo "$found"
  status=1
fi
echo "$found" | while IFS=: read -r file line _; do
  [ -n "$file" ] || continue
  sed -n "$((line - 1))p" "$file" | grep -q '^ *//' || { echo "$file:$line: a cast without the reason above it"; exit 1; }
done || status=1
# Who shows help texts: the protocol's description, `ortung check` and Python.
shown="app/files/Check.cpp
board/server/src/PlaybackRun.cpp
board/server/src/ServedWorld.cpp
python/src/ContainerBindings.cpp"
found=$(grep -rlE '[.>]wordsHelp\(\)' container mcl sim play board realsensors plugins app python --include=*.cpp --include=*.hpp | sort)
if [ "$found" != "$shown" ]; then
  echo "wordsHelp() is for people; what a program wants to know is in format(). Found it in"
  echo "$found"
  status=1
fi
exit $status
