# A Slurm of one node, all in $folder/cluster, without systemd; as root. Sourced.
cluster=$folder/cluster
port=$((20000 + $$ % 10000 * 2))
daemons=()
# Ended by their process ids; the folder stays, for those who look for a reason.
end_cluster() { [[ ${#daemons[@]} -eq 0 ]] || kill "${daemons[@]}" 2>/dev/null || true; }
trap end_cluster EXIT

start_cluster() {
  mkdir -p "$cluster"/{state,spool,run}
  (umask 077; mkdir "$cluster/munge"; head -c 128 /dev/urandom >"$cluster/munge/key")
  munged --force --foreground --key-file "$cluster/munge/key" --socket "$cluster/run/munge" \
    --pid-file "$cluster/munge/pid" --log-file "$cluster/munge/log" \
    --seed-file "$cluster/munge/seed" 2>"$cluster/munge/err" &
  daemons+=($!)
  cat >"$cluster/slurm.conf" <<END
ClusterName=test
SlurmctldHost=$(hostname -s)(127.0.0.1)
SlurmctldPort=$port
SlurmdPort=$((port + 1))
AuthType=auth/munge
AuthInfo=socket=$cluster/run/munge
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
  wait_for "munge's socket" test -S "$cluster/run/munge"
  slurmctld -D -f "$SLURM_CONF" >"$cluster/slurmctld.log" 2>&1 &
  daemons+=($!)
  slurmd -D -f "$SLURM_CONF" >"$cluster/slurmd.log" 2>&1 &
  daemons+=($!)
  wait_for "an idle node" bash -c '[[ $(sinfo -h -o %t 2>/dev/null) == idle ]]'
}

wait_for() {
  local what=$1 i
  shift
  for ((i = 0; i < ${patience:-600}; ++i)); do  # tenths of a second
    "$@" && return
    sleep 0.1
  done
  echo "waited in vain for $what"
  squeue || true
  tail -n 5 "$cluster"/*.log
  exit 1
}

no_jobs_left() { [[ -z $(squeue -h 2>/dev/null) ]]; }
