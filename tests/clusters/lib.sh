# What the tests of launchers have in common. Needs $program and $project.
# A sweep of twelve evaluations in the folder $1, with tables; the table of one process is one.csv.
make_sweep() {
  cd "$1"
  local world=$project/maps/fields/f2000.toml robot=$project/maps/robots/pioneer.toml
  "$program" learn --world "$world" --robot "$robot" --out field.ortung > /dev/null
  cat > sweep.toml <<S
command = ["eval", "--source", "sim:$world?duration=20&seed={seed}", "--robot", "$robot", "--tables", "field.ortung",
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

# Kills the first process that runs a task of the sweep in the folder $1, once there is one.
kill_a_task() {
  local victim=
  for _ in $(seq 200); do
    victim=$(pgrep -f "^$program sweep run .*--dir $1 " | head -1 || true)
    [[ -n $victim ]] && kill -9 "$victim" && echo "killed process $victim" && return
    sleep 0.05
  done
  return 1
}
