#!/usr/bin/env bash
# check-arm.sh [--counts]  what a robot needs, for 64-bit ARM: builds it with Debian's cross compiler in build/robot-arm64, runs the
# tests of container and MCL under QEMU, and compares the poses of a robot's program with those of build/dev.
# Needs scripts/install-deps.sh arm64. --counts: only the instructions of hot calls, as a table.
set -euo pipefail
cd "$(dirname "$0")/.."
build=build/robot-arm64
# Tests whose repetitions take long under QEMU. Processors don't differ in what they hold.
long='^(container\.MotionLearning\.|mcl\.(Annealing\.|Belief\.(GoesOnInAnother|HasABound)|Biases\.|FalseSightings\.|FieldSearch\.Outlives|GlobalStart\.(SpreadsAsFar|GoesOn)|GridBelief\.Noise|GridFilter\.|LateReadings\.|Lateness\.|LearnedOdometry\.ARobot|Mcl\.(SurvivesFeatures|Recovers|ConvergesFromAny|SeesAgain)|MclGlobalStart\.(KeepsAll|IsSpread|BeginsAnew)|Momentum\.CarriesThe|Poison\.|Quadrature\.IsComeNearer|Relocalize\.|Rivals\.|Seeds/|SetPose\.Is))'
# Tests in which a program of ARM starts another, which QEMU can't for one process, or in which that fails otherwise than on Linux.
starting='^container\.(InstructionSetDeathTest\.|RunHelper\.NamesSignal)'
cmake --preset robot-arm64 > /dev/null

count_all() {
  cmake --build --preset robot-arm64 --target counted_calls > /dev/null
  cc -O2 -shared -fPIC -o "$build/count_instructions.so" tests/arm/count_instructions.c
  # Instructions that the program took with some repeats.
  took() {
    qemu-aarch64 -plugin "$build/count_instructions.so" "$build/bin/counted_calls" "$@" 2>&1 > /dev/null |
      sed -n 's/^instructions: //p'
  }
  echo "| call | each | portable | NEON |"
  echo "|---|---|---|---|"
  while read -r call each; do
    things=$(qemu-aarch64 "$build/bin/counted_calls" "$call" portable 0)
    row="| \`$call\` | $each |"
    for set in portable neon; do
      row+=$(awk -v more="$(took "$call" "$set" 12)" -v less="$(took "$call" "$set" 2)" -v n="$things" \
        'BEGIN { printf " %.2f |", (more - less) / (10 * n) }')
    done
    echo "$row"
  done << 'END'
costs beam and sample
costs_steps beam and sample
weigh_rays beam and sample
weigh_end_points beam and sample
uniform number
gaussian number
motion sample
weights sample
bins_estimate sample
END
}
if [[ ${1:-} == --counts ]]; then
  count_all
  exit 0
fi

cmake --build --preset robot-arm64 --target container_test mcl_test ortung_client ortung_plugins localize own_readings avoid avoid_c
# Sums must not be fused with products, or bits differ from those of other processors. Eigen's product of large matrices has such
# instructions by hand; it is compiled for the solvers, which never call it for matrices of 3 and 5 rows.
for library in "$build"/lib/libortung_*.so "$build"/lib/ortung/plugins/*.so; do
  fused=$(aarch64-linux-gnu-objdump -dC --no-show-raw-insn "$library" |
    awk '/^[0-9a-f]+ </ { name = $0 } /\t(fn?madd|fn?msub|fmla|fmls)\t/ && name !~ /(gebp_kernel|lhs_process_one_packet)</ { print name }' | sort -u)
  [[ -z $fused ]] || { echo "check-arm: $library fuses sums with products: $fused" >&2; exit 1; }
done
ctest --test-dir "$build" -j "$(nproc)" -R '^(container|mcl)\.' -E "$long|$starting" --output-on-failure

if [[ -x build/dev/bin/ortung && -x build/dev/bin/localize ]]; then
  work=$build/poses
  mkdir -p "$work"
  build/dev/bin/ortung learn --world maps/fields/arena.toml --robot maps/robots/pioneer.toml --out "$work/tables.ortung" --force
  build/dev/bin/ortung import sim maps/fields/arena.toml --with-robot maps/robots/pioneer.toml --option duration=5 \
    --out "$work/run.rec" --force
  run=(maps/robots/pioneer.toml "$work/tables.ortung" "record:$work/run.rec")
  qemu-aarch64 "$build/bin/localize" "${run[@]}" > "$work/arm.txt"
  build/dev/bin/localize "${run[@]}" | cmp - "$work/arm.txt"
  echo "check-arm: $(wc -l < "$work/arm.txt") poses are those of this machine"
fi
