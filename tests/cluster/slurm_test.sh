#!/usr/bin/env bash
# A job array of Slurm on this machine, two of its jobs terminated and submitted again: the same
# bytes as one run. As root.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"
require munged slurmctld slurmd sbatch
[[ $(id -u) -eq 0 ]] || { echo "skipped: slurmd needs root"; exit 77; }
export PATH=$PATH:/usr/sbin
make_sessions 12

source "$(dirname "${BASH_SOURCE[0]}")/cluster.sh"
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
num_stopped=$(cat "$folder"/parts/logs/work-*.log | grep -c "trials are left; finished trials are kept")
[[ $num_stopped -ge 1 ]] || { echo "no job was stopped, so nothing was tested"; exit 1; }

"$program" submit "$folder/parts" --engine slurm --array 7
wait_for "the end of the jobs" no_jobs_left
compare_sessions
