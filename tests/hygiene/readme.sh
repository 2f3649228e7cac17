#!/bin/sh
# readme.sh ROOT  the README's robot program is the example that the tests build and run.
cd "$1" || exit 2
shown=$(awk '/^## /{ in_part = /A robot program/ } /^```/{ in_code = 0 } in_part && in_code { print }
             /^```cpp/{ in_code = 1 }' README.md)
[ -n "$shown" ] || { echo "README.md shows no robot program"; exit 1; }
[ "$shown" = "$(sed -n '/^#include/,$p' examples/localize.cpp)" ] || {
  echo "README.md: the robot program is not examples/localize.cpp"
  exit 1
}
