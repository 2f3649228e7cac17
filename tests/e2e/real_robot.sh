#!/bin/sh
# real_robot.sh ROOT ORTUNG  the commands of docs/real-robot.md, as they stand there.
root=$1 ortung=$2
folder=$(mktemp -d) || exit 2
emulator=
trap '[ -z "$emulator" ] || kill $emulator 2> /dev/null; rm -rf "$folder"' EXIT
cd "$folder" || exit 2
mkdir bin && ln -s "$ortung" bin/ortung && ln -s "$root/maps" maps
PATH=$folder/bin:$PATH
port=$(python3 -c 'import socket; s = socket.socket(); s.bind(("127.0.0.1", 0)); print(s.getsockname()[1])')
awk '/^```sh$/ { shown = 1; next } /^```$/ { shown = 0 } shown' "$root/docs/real-robot.md" | sed "s/\\b7777\\b/$port/g" > commands
[ "$(grep -c '^ortung' commands)" -ge 8 ] || { echo "docs/real-robot.md shows too few commands"; exit 1; }
timeout 300 sh -ex commands > told 2>&1 || { tail -40 told; echo "a command of docs/real-robot.md fails"; exit 1; }
fail() { cat told; echo "$1"; exit 1; }

# The table of a terminal: as the page shows it, but for numbers and how sure the pose is. Faults may be told behind a line.
ortung emulate --robot maps/robots/laboratory.toml --world maps/fields/arena.toml --dev dev --wait > emulated 2>&1 &
emulator=$!
plain() { tr -d '\r' | sed -E 's/-?[0-9]+(\.[0-9]+)?/N/g; s/ +/ /g; s/ $//; s/degrees, [a-z]+$/degrees/'; }
awk '/^```text$/ { shown = 1; next } /^```$/ { shown = 0 } shown' "$root/docs/real-robot.md" | plain > expected
[ "$(wc -l < expected)" -ge 3 ] || fail "docs/real-robot.md shows no table"
shows() { while read -r line; do grep -qF -- "$line" seen || { echo "$line"; return 1; }; done < expected; }
for seconds in 8 20 60; do # a busy computer takes long to find devices, and where the robot is
  script -qec "ortung robot maps/robots/laboratory.toml --dev dev --tables lab.ortung --duration $seconds" /dev/null < /dev/null > screen 2>&1 ||
    { cat screen; echo "the robot fails at a terminal"; exit 1; }
  plain < screen > seen
  missing=$(shows) && break
done
[ -z "$missing" ] || { cat screen; echo "docs/real-robot.md: no such line at a terminal: $missing"; exit 1; }
[ "$(wc -l < poses.txt)" -gt 50 ] || fail "too few poses"
grep -q '^pose x .* tracking$' told || fail "the robot does not track"
grep -q 'sick_lms /dev/ttyUSB1: absent' told || fail "nobody told that the scanner was unplugged"
grep -q '1 clock jumps' told || fail "nobody told that the base's clock was set"
grep -q "^[0-9]* device/status/base0 9 2 " told || fail "clients do not see how the devices are"
grep -q "^[0-9]* mcl/LOCALIZATION/pose 9 " told || fail "clients do not see the pose"
grep -q "^motion kind=velocities numbers=2$" told || fail "clients do not see what MOTION takes"
grep -q "^OK LOCALIZE robot=1 state=running progress=1 " told || fail "clients do not see that it localizes"
grep -q "^value [^ ]*/LRF/[^ ]* 0 unit=m .*expected=" told || fail "clients do not see why"
