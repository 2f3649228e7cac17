#!/bin/sh
# run.sh FOLDER  One recording is the same record, robot and world from MCAP, .db3 and bags of ROS 1, which rosbag writes; 77: skipped.
# ORTUNG_PROGRAM is `ortung`.
set -u
here=$(cd "$(dirname "$0")" && pwd)
skip() {
  echo "run.sh: Skipped"  # as GoogleTest says it, for scripts/skipped.py
  echo "$1"
  exit 77
}
python=""
for one in python3 /usr/bin/python3; do
  "$one" -c 'import rosbag, nav_msgs.msg, sensor_msgs.msg, tf2_msgs.msg' 2> /dev/null && python=$one && break
done
[ -n "$python" ] || skip "python3-rosbag is not here, nor the messages of ROS 1"
command -v zstd > /dev/null 2>&1 || skip "zstd is not here"
rm -rf "$1" && mkdir -p "$1" && cd "$1" || exit 1
"$python" "$here/twins.py" . || exit 1
zstd -q run.db3 -o run.db3.zstd && zstd -q run.mcap -o run.mcap.zstd || exit 1

import() {  # import KIND FILE OUT
  "$ORTUNG_PROGRAM" import "$1" "$2" --option images=/image --out "$3.rec" --robot-file "$3.toml" --world "$3.world.toml" \
    > "$3.txt" 2>&1 || { cat "$3.txt"; exit 1; }
}
# What names the file itself differs: a robot file has its name. Worlds are the same up to the name of their map.
same() {  # same A B WHAT
  for kind in rec world.pgm; do
    cmp "$1.$kind" "$2.$kind" || { echo "$3 gives another $kind"; exit 1; }
  done
  sed "/^#/d; /^name/d" "$2.toml" > "$2.robot"
  sed '/^#/d; /^name/d' "$1.toml" | cmp - "$2.robot" || { echo "$3 gives another robot"; exit 1; }
}
import mcap run.mcap mcap
[ "$(wc -c < mcap.rec)" -gt 1000 ] || { echo "the record is too short"; exit 1; }
for file in run.db3 run.db3.zstd run.mcap.zstd none.bag bz2.bag lz4.bag bare.bag killed.bag; do
  name=$(echo "$file" | tr . _)
  import bag "$file" "$name"
  same mcap "$name" "$file"
done
grep -q "killed.bag is unfinished" killed_bag.txt || { echo "nothing tells that killed.bag is unfinished"; exit 1; }
echo "the same from 9 files: $(wc -c < mcap.rec) bytes of a record"
