#!/usr/bin/env bash
# test-slurm.sh PROGRAM [FOLDER]  whether a Slurm cluster that loses a node in the middle gives the same bits as one process.
#
# Starts munged, slurmctld and two nodes on loopback, in a folder of their own; submits 24 tasks with examples/cluster/slurm.sh:
# learning in 12 shards, and a sweep of 12 evaluations; kills node n2 with all that runs on it (kill -9) in the middle; merges,
# and compares with what one process makes. Ends with 77 where Slurm is not installed, or by whom it can't be started.
set -euo pipefail
project=$(cd "$(dirname "$0")/.." && pwd)
program=$(realpath "${1:?usage: test-slurm.sh PROGRAM [FOLDER]}")
for need in munged slurmctld slurmd sbatch; do
  command -v "$need" > /dev/null || { echo "skipped: $need is not installed (apt-get install slurmctld slurmd slurm-client munge)"; exit 77; }
done
[[ $(id -u) == 0 ]] || { echo "skipped: a cluster on loopback needs root"; exit 77; }

folder=$(mktemp -d "${TMPDIR:-/tmp}/ortung-slurm.XXXXXX")
chmod 755 "$folder" # munged wants that all the way up
daemons=()
finish() {
  [[ -n ${SLURM_CONF:-} ]] && scancel --quiet --user=root 2> /dev/null || true
  pkill -9 -f "slurmstepd.*$folder" 2> /dev/null || true
  kill -9 "${daemons[@]}" 2> /dev/null || true
  wait 2> /dev/null || true
  if [[ ${failed:-1} == 0 ]]; then rm -rf "$folder"; else echo "what is left lies in $folder"; fi
}
trap finish EXIT

echo "cluster: munge, a controller and two nodes"
mkdir -p "$folder"/{ctl,n1,n2,log,munge,sock,out/parts}
chmod 700 "$folder/munge"
chmod 711 "$folder/sock"
head -c 1024 /dev/urandom > "$folder/munge/key"
chmod 400 "$folder/munge/key"
munged --foreground --num-threads=2 --key-file="$folder/munge/key" --socket="$folder/sock/munge" --pid-file="$folder/munge/pid" \
  --log-file="$folder/munge/log" --seed-file="$folder/munge/seed" > "$folder/log/munged" 2>&1 &
daemons+=($!)
host=$(hostname -s)
ports=($(python3 - <<'P'
import socket
sockets = [socket.socket() for _ in range(3)]
for one in sockets:
    one.bind(("127.0.0.1", 0))
print(*[one.getsockname()[1] for one in sockets])
P
))
cat > "$folder/slurm.conf" <<C
ClusterName=ortung
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=${ports[0]}
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket=$folder/sock/munge,cred_expire=5
CredType=cred/munge
MpiDefault=none
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
ReturnToService=2
JobRequeue=1
SchedulerType=sched/backfill
SchedulerParameters=sched_interval=1,sched_min_interval=0,batch_sched_delay=0,bf_interval=1,requeue_delay=0
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SlurmctldTimeout=10
SlurmdTimeout=5
KillWait=2
SlurmdParameters=config_overrides
StateSaveLocation=$folder/ctl
SlurmctldPidFile=$folder/ctl.pid
SlurmctldLogFile=$folder/log/slurmctld.log
SlurmdSpoolDir=$folder/%n
SlurmdPidFile=$folder/%n.pid
SlurmdLogFile=$folder/log/%n.log
NodeName=n1 NodeHostname=$host NodeAddr=127.0.0.1 Port=${ports[1]} CPUs=2 RealMemory=1000
NodeName=n2 NodeHostname=$host NodeAddr=127.0.0.1 Port=${ports[2]} CPUs=2 RealMemory=1000
PartitionName=all Nodes=n1,n2 Default=YES MaxTime=10 State=UP
C
export SLURM_CONF=$folder/slurm.conf
# wait_for SECONDS COMMAND...  until the command succeeds
wait_for() {
  local end=$((SECONDS + $1))
  shift
  until "$@"; do
    ((SECONDS < end)) || { echo "waited in vain for: $*"; squeue || true; sinfo -N -l || true; return 1; }
    sleep 0.2
  done
}
wait_for 60 test -S "$folder/sock/munge"
slurmctld -c -D > "$folder/log/ctl" 2>&1 &
daemons+=($!)
slurmd -N n1 -D > "$folder/log/d1" 2>&1 &
daemons+=($!)
slurmd -N n2 -D > "$folder/log/d2" 2>&1 &
second=$!
daemons+=($second)
both_idle() { [[ $(sinfo -h -N -o %T 2> /dev/null | grep -c '^idle$') == 2 ]]; }
wait_for 60 both_idle

source "$project/tests/clusters/lib.sh"
echo "one process: tables, and the sweep"
make_sweep "$folder/out" 300 --cell 0.05

echo "24 tasks on two nodes, one of which dies"
export ORTUNG=$program TMPDIR=$folder
script=$project/examples/cluster/slurm.sh
begin=$SECONDS
sbatch --quiet --array=1-12 "$script" sweep run sweep.toml --dir many
sbatch --quiet --array=1-12 "$script" "${learning[@]}" --out "parts/{i}.part"
runs_on_second() { [[ $(squeue -h -t R -w n2 -o %i 2> /dev/null | wc -l) -ge 2 ]]; }
wait_for 60 runs_on_second
lost=$(squeue -h -t R -w n2 -o %i | tr '\n' ' ')
# The node with everything on it, as if its plug was pulled: its daemon, what would report of the tasks, and the tasks.
on_second() {
  local process
  for process in $(pgrep -f "$program"; pgrep slurm_script); do
    grep -qzx "SLURMD_NODENAME=n2" "/proc/$process/environ" 2> /dev/null && grep -qzx "SLURM_CONF=$SLURM_CONF" "/proc/$process/environ" &&
      echo "$process"
  done
}
kill -STOP "$second"
mapfile -t tasks < <(on_second)
mapfile -t reporting < <(for task in "${tasks[@]}"; do ps -o ppid= -p "$task"; done | xargs -r ps -o pid=,comm= -p | awk '$2 == "slurmstepd" { print $1 }')
kill -9 "$second" "${reporting[@]}" "${tasks[@]}" 2> /dev/null || true
echo "killed n2 with tasks $lost(processes ${tasks[*]}, reported by ${reporting[*]})"
[[ -n $lost && ${#tasks[@]} -gt 0 && ${#reporting[@]} -gt 0 ]]
all_done() { [[ $(squeue -h -o %i 2> /dev/null | wc -l) == 0 ]]; }
wait_for 170 all_done
again=$(grep -ci "requeue.* job" "$folder/log/slurmctld.log" || true)
echo "all tasks ended after $((SECONDS - begin)) s, of which $again began again on the other node"
[[ $again -gt 0 ]]

"$program" merge parts/*.part --out many.ortung
cmp field.ortung many.ortung
check_sweep many
[[ -z $(find parts many -name '.*' -type f) && $(ls parts | wc -l) == 12 ]]
echo "the same bits, and nothing left over"
failed=0
