# What the tests of launchers have in common. Needs $program and $project.
# make_sweep FOLDER SECONDS [OPTION...]  a sweep of twelve evaluations of so many seconds in the folder, with tables that are learned with these
# options, and in one.csv what one process makes of it. Leaves the words that have learned the tables in `learning`.
make_sweep() {
  cd "$1"
  local world=$project/maps/fields/f2000.toml robot=$project/maps/robots/pioneer.toml
  learning=(learn --world "$world" --robot "$robot" "${@:3}")
  "$program" "${learning[@]}" --out field.ortung > /dev/null
  cat > sweep.toml <<S
command = ["eval", "--source", "sim:$world?duration=$2&seed={seed}", "--robot", "$robot", "--tables", "field.ortung",
           "--set", "mcl.particles={particles}", "--seed", "{seed}", "--no-times"]
[vary]
particles = [1000, 5000]
seed = "1..6"
S
  "$program" sweep run sweep.toml --dir one --jobs 2
  "$program" sweep table one --by particles,seed --csv one.csv > /dev/null
}

# Compares the sweep in the folder $1 with the one above: complete, the same bits, and nothing left over.
check_sweep() {
  "$program" sweep status "$1"
  "$program" sweep table "$1" --by particles,seed --csv check.csv --force > /dev/null
  cmp one.csv check.csv
  [[ -z $(ls "$1/tasks" "$1/failed" | grep -v : || true) ]]
}

# Kills the first process that runs a task of the sweep in the folder $1 of the working folder, once there is one. Other tests have sweeps
# of that name, too.
kill_a_task() {
  local victim=
  for _ in $(seq 200); do
    for victim in $(pgrep -f "^$program sweep run .*--dir [^ ]*$1 "); do
      [[ $(readlink "/proc/$victim/cwd") == "$PWD" ]] && kill -9 "$victim" && echo "killed process $victim" && return
    done
    sleep 0.05
  done
  return 1
}
