#!/usr/bin/env bash
# The five commands of the manual's page machines, as it prints them, by somebody without root in a Slurm of one node.
# Usage, as root: walk.sh URL FOLDER [USER]. Not part of the suite: it builds the program. FOLDER must
# be reachable for the user, and its home is FOLDER/home.
set -euo pipefail
url=$1
folder=$(realpath -m "$2")
user=${3:-nobody}
rm -rf "$folder"
mkdir -p "$folder/home"
chown "$user" "$folder/home"
page=$(realpath "$(dirname "${BASH_SOURCE[0]}")/../../workbench/manual/pages/machines.md")
source "$(dirname "${BASH_SOURCE[0]}")/cluster.sh"
export PATH=$PATH:/usr/sbin
start_cluster

# The block that begins with the clone, each line a command of the person's.
mapfile -t commands < <(sed -n '/^git clone URL/,/^```$/{/^```$/!p}' "$page")
[[ ${#commands[@]} -ge 4 && ${#commands[@]} -le 5 ]] || { echo "no such block in $page"; exit 1; }
cd "$folder/home"
for command in "${commands[@]}"; do
  command=${command//URL/$url}
  echo "\$ $command"
  printf '%s\n' "$command" >>"$folder/typed"
done
typed=$(cat "$folder/typed")
run_as_user() { runuser -u "$user" -- env HOME="$folder/home" SLURM_CONF="$SLURM_CONF" "$@"; }
run_as_user bash -euc "$typed"
patience=36000 wait_for "the end of the jobs" no_jobs_left
run_as_user bash -euc "cd graspbench && build/release/graspbench status results/pilot && ls -l results/pilot/report/index.html"
