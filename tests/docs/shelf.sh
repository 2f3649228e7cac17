#!/bin/sh
# shelf.sh ORTUNG ROOT SHELF CMAKE BUILD  makes the files that pages take for granted: a hall with its tables, records of a robot in
# it, and an installed Ortung. All short and coarse; the pages' own commands make longer and finer ones.
set -e
ortung=$1 root=$2 shelf=$3 cmake=$4 build=$5
rm -rf "$shelf"
mkdir -p "$shelf"
cd "$shelf"
ln -s "$root/maps" maps
"$cmake" --install "$build" --prefix "$shelf/installed" > install.log 2>&1 || { cat install.log; exit 1; }
cp maps/robots/pioneer.toml robot.toml
cp maps/fields/arena.toml world.toml
"$ortung" learn --world world.toml --robot robot.toml --cell 0.1 --out hall.ortung
cp hall.ortung tables.ortung
"$ortung" learn --world world.toml --robot maps/robots/laboratory.toml --cell 0.2 --out lab.ortung
"$ortung" import sim world.toml --with-robot maps/robots/laboratory.toml --option duration=25 --out lab.rec
"$ortung" learn --world maps/fields/f2000.toml --robot maps/robots/pioneer_posts.toml --out posts.ortung
"$ortung" learn --world maps/fields/f2000.toml --robot maps/robots/pioneer.toml --out f2000.ortung
cp "$root/examples/cluster/particles.toml" "$root/python/examples/workers.py" .
"$ortung" import sim maps/fields/msl.toml --with-robot maps/robots/msl_camera.toml --option duration=1 --option pictures=on --out msl.rec
# A match without those who come as clients.
awk 'BEGIN { RS = ""; ORS = "\n\n" } !/name = "blue4"/' maps/scenes/f2000_match.toml | sed 's|"\.\./|"maps/|' > my_match.toml
seed=0
for name in run run1 run2 run3 other; do
  seed=$((seed + 1))
  "$ortung" import sim world.toml --with-robot robot.toml --option duration=25 --option seed=$seed --out $name.rec
done
# A bag of ROS 2 of a robot with a scanner in a hall.
"$ortung" import sim maps/fields/f2000_hall.toml --with-robot maps/robots/pioneer_lrf.toml --option duration=40 --out hall_drive.rec
"$ortung" export mcap record:hall_drive.rec --robot maps/robots/pioneer_lrf.toml --world maps/fields/f2000_hall.toml --out hall.mcap
