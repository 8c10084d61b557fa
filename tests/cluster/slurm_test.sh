#!/usr/bin/env bash
# A job array of Slurm on this machine, two of its jobs terminated and submitted again: the same
# bytes as one run. A cluster of one node, all in one folder, without systemd; as root.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"
require munged slurmctld slurmd sbatch
[[ $(id -u) -eq 0 ]] || { echo "skipped: slurmd needs root"; exit 77; }
export PATH=$PATH:/usr/sbin
make_sessions 20

cluster=$folder/cluster
port=$((20000 + $$ % 10000 * 2))
daemons=()
# Ended by their process ids; the folder stays, for those who look for a reason.
end_cluster() { [[ ${#daemons[@]} -eq 0 ]] || kill "${daemons[@]}" 2>/dev/null || true; }
trap end_cluster EXIT

start_cluster() {
  mkdir -p "$cluster"/{state,spool}
  (umask 077; mkdir "$cluster/munge"; head -c 128 /dev/urandom >"$cluster/munge/key")
  munged --force --foreground --key-file "$cluster/munge/key" --socket "$cluster/munge/socket" \
    --pid-file "$cluster/munge/pid" --log-file "$cluster/munge/log" \
    --seed-file "$cluster/munge/seed" 2>"$cluster/munge/err" &
  daemons+=($!)
  cat >"$cluster/slurm.conf" <<END
ClusterName=test
SlurmctldHost=$(hostname -s)(127.0.0.1)
SlurmctldPort=$port
SlurmdPort=$((port + 1))
AuthType=auth/munge
AuthInfo=socket=$cluster/munge/socket
CredType=cred/munge
SlurmUser=root
SlurmdUser=root
StateSaveLocation=$cluster/state
SlurmdSpoolDir=$cluster/spool
SlurmctldPidFile=$cluster/slurmctld.pid
SlurmdPidFile=$cluster/slurmd.pid
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
AccountingStorageType=accounting_storage/none
JobAcctGatherType=jobacct_gather/none
SchedulerParameters=sched_interval=1
ReturnToService=2
MpiDefault=none
NodeName=$(hostname -s) NodeAddr=127.0.0.1 CPUs=2 State=UNKNOWN
PartitionName=short Nodes=ALL Default=YES MaxTime=10 State=UP
END
  export SLURM_CONF=$cluster/slurm.conf
  wait_for "munge's socket" test -S "$cluster/munge/socket"
  slurmctld -D -f "$SLURM_CONF" >"$cluster/slurmctld.log" 2>&1 &
  daemons+=($!)
  slurmd -D -f "$SLURM_CONF" >"$cluster/slurmd.log" 2>&1 &
  daemons+=($!)
  wait_for "an idle node" bash -c '[[ $(sinfo -h -o %t 2>/dev/null) == idle ]]'
}

wait_for() {
  local what=$1 i
  shift
  for ((i = 0; i < 600; ++i)); do
    "$@" && return
    sleep 0.1
  done
  echo "waited in vain for $what"
  squeue || true
  tail -n 5 "$cluster"/*.log
  exit 1
}

no_jobs_left() { [[ -z $(squeue -h 2>/dev/null) ]]; }
some_work_begun() { compgen -G "$folder/parts/journal/*of7-0.jsonl" >/dev/null; }

start_cluster
mkdir -p "$XDG_CONFIG_HOME/graspbench"
printf 'partition: short\ntime: "00:05:00"\noptions: [--nice=0]\n' \
  >"$XDG_CONFIG_HOME/graspbench/cluster.yaml"

"$program" submit "$folder/parts" --engine slurm --array 7
wait_for "a journal" some_work_begun
# The two that run finish their trial and exit with 75. Then scancel tries once more and complains
# that they have ended.
mapfile -t jobs < <(squeue -h -n graspbench-work -t running -o %A)
scancel --batch --signal=TERM "${jobs[@]}" 2>/dev/null || true
wait_for "the end of the jobs" no_jobs_left
num_stopped=$(cat "$folder"/parts/logs/work-*.log | grep -c "left and the finished ones are kept")
[[ $num_stopped -ge 1 ]] || { echo "no job was stopped, so nothing was tested"; exit 1; }

"$program" submit "$folder/parts" --engine slurm --array 7
wait_for "the end of the jobs" no_jobs_left
compare_sessions
