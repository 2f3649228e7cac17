#!/bin/sh
# inside.sh  on a bare Debian 12 with our packages in /packages (bare.sh): installs, works, compiles, upgrades, removes.
# shellcheck disable=SC2046,SC2012  # names of packages and plugins are words
set -e
cd /packages
start=$(date +%s)
say() { echo "packages: $* ($(($(date +%s) - start)) s)"; }
fail() {
  echo "packages: $*" >&2
  exit 1
}
quietly() { "$@" > /tmp/log 2>&1 || { tail -30 /tmp/log; fail "$* failed"; }; }
install() { quietly apt-get install -y -q --no-install-recommends -o APT::Keep-Downloaded-Packages=true "$@"; }
# All files but those that come and go by themselves; no package's list of its own.
files() {
  find / -xdev \( -path /packages -o -path /proc -o -path /tmp -o -path /root -o -path /var/lib/apt -o \
    -path /var/cache -o -path /var/log -o -path /var/lib/dpkg \) -prune -o -print | sort
}
ours() { dpkg-query -W -f '${Package} ${Source} ${db:Status-Abbrev}\n' | awk '$2 == "ortung" { print $1 }'; }

# A robot's libraries need nothing that is not there.
quietly dpkg -i ./libortung0_*.deb
quietly dpkg --purge libortung0
say "libortung0 installs on what is there"
quietly apt-get update -q

# What others provide comes first, so that what we leave behind can be told.
install $(apt-get install -s --no-install-recommends ./*.deb cmake make g++ pkg-config |
  sed -n 's/^Inst \([^ ]*\) .*/\1/p' | grep -vxF "$(for deb in *.deb; do dpkg-deb -f "$deb" Package; done)")
files > /tmp/before
say "what they depend on is installed"

# The program without the simulator, if it is in a package of its own.
if dpkg-deb -c ./ortung_*.deb | grep -q ' \./usr/bin/ortung$'; then
  install ./libortung0_*.deb ./libortung-run0_*.deb ./ortung_*.deb
  ortung --version > /dev/null || fail "ortung alone does not run"
  ortung plugins > /tmp/plugins || fail "ortung alone finds no plugins"
  ! ortung learn --help > /tmp/told 2>&1 || fail "ortung learns without the simulator"
  grep -q 'ortung-sim' /tmp/told || fail "ortung does not say which package learns: $(cat /tmp/told)"
  say "ortung works alone: $(grep -c '\.so$' /tmp/plugins) plugins"
fi

install ./libortung0_*.deb ./libortung-run0_*.deb ./ortung*.deb
say "installed: $(ours | tr '\n' ' ')"
cd /tmp
maps=/usr/share/ortung/maps
ortung --version
ortung plugins > /tmp/plugins
folder=$(dirname "$(dpkg -L ortung | grep 'ortung_lrf_data\.so$')")
[ "$(grep -c "^$folder/.*\.so$" plugins)" = "$(ls "$folder" | wc -l)" ] || fail "not all plugins load: $(cat plugins)"
say "all $(ls "$folder" | wc -l) plugins load"

ortung learn --world $maps/fields/arena.toml --robot $maps/robots/pioneer.toml --out tables.ortung > log
ortung import sim $maps/fields/arena.toml --with-robot $maps/robots/pioneer.toml --option duration=10 --option seed=3 \
  --out run.rec > log
ortung localize --source record:run.rec --robot $maps/robots/pioneer.toml --tables tables.ortung > poses
poses=$(grep -vc '^#' poses)
[ "$poses" -gt 30 ] || fail "only $poses poses"
if ortung demo --help | grep -q -- '--once'; then
  ortung demo --once || fail "the demo does not localize its robot"
fi
say "learned, simulated, localized: $poses poses"

# A node of ROS 2 begins to listen, and ends when it is told to.
if command -v ortung-ros2 > /dev/null; then
  ROS_LOCALHOST_ONLY=1 ortung-ros2 --folder ros2 > told 2>&1 &
  node=$!
  for _ in $(seq 100); do
    grep -q listening told && break
    sleep 0.1
  done
  kill $node && wait $node || fail "ortung-ros2: $(cat told)"
  say "ortung-ros2: $(head -1 told)"
fi

install /packages/libortung-dev_*.deb
cmake -S /usr/share/doc/ortung/examples -B build > log || fail "$(cat log)"
cmake --build build > log 2>&1 || fail "$(cat log)"
[ "$(build/localize $maps/robots/pioneer.toml tables.ortung record:run.rec | wc -l)" = "$poses" ] ||
  fail "the example does not localize"
cc /usr/share/doc/ortung/examples/avoid.c -o avoid $(pkg-config --cflags --libs ortung-client)
say "examples compile and run"
install /packages/libortung*-dev_*.deb
mkdir all
cat > all/CMakeLists.txt << 'END'
cmake_minimum_required(VERSION 3.25)
project(all CXX)
find_package(ortung REQUIRED COMPONENTS sim vision devices)
END
cmake -S all -B all/build > log 2>&1 || fail "$(cat log)"

install /packages/python3-ortung_*.deb
python3 -c '
import ortung
env = ortung.make("goalkeeper-v0", striker="shot")
observation, info = env.reset(seed=1)
observation, reward, terminated, truncated, info = env.step([0.5, 0.0])
print("packages: python observes", observation.shape, "of", len(ortung.environments()), "environments")'

# The documentation is a site without anything from elsewhere; its scripts are Debian's.
site=/usr/share/doc/ortung/html
for file in index.html docs/index.html docs/start/demo.html reference/keys.html reference/cpp/index.html searchindex.js \
  _static/searchtools.js _static/scripts/furo.js ../examples/notebooks/own_sensor.ipynb; do
  [ -s $site/$file ] || fail "the documentation has no $file"
done
! grep -rlE '<(script|img|link rel="stylesheet")[^>]*(src|href)="(https?:)?//' $site --include='*.html' ||
  fail "the pages above fetch something"
say "documentation: $(find $site -name '*.html' | wc -l) pages"

install /packages/newer/*.deb
[ "$(dpkg-query -W -f '${Version}\n' $(ours) | sort -u | grep -c newer)" = 1 ] || fail "not all were upgraded"
ortung --version > log
for file in $(dpkg -L $(ours) | sort -u); do
  [ -e "$file" ] || fail "the upgrade lost $file"
done
say "upgraded"

quietly dpkg --purge $(ours)
files > /tmp/after
diff /tmp/before /tmp/after || fail "the files above were left, or taken away"
say "removed, and nothing is left"
