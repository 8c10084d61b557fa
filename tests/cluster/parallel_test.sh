#!/usr/bin/env bash
# GNU parallel, two of its jobs terminated, and started again with its list of what is done: the same
# bytes as one run.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"
require parallel seq pgrep
make_sessions 12

work() {
  parallel --jobs 2 --joblog "$folder/joblog" --resume-failed \
    "$program" work "$folder/parts" --shard "{}/7" ::: 5 2 7 1 4 6 3 >>"$folder/parallel.log" 2>&1
}
work &
parallel=$!
for ((i = 0; i < 600; ++i)); do
  compgen -G "$folder/parts/journal/*of7-0.jsonl" >/dev/null && break
  sleep 0.1
done
# Below the function's own shell: parallel, and below that the two workers.
kill -TERM $(pgrep -P "$(pgrep -P "$parallel")")
wait "$parallel" && { echo "no job was stopped, so nothing was tested"; exit 1; }
grep -q "trials are left; finished trials are kept" "$folder/parallel.log"
work
"$program" merge "$folder/parts" >"$folder/merge.log" 2>&1
compare_sessions

# The same by the program's own script, on a plan of its own.
rm -r "$folder/parts"
"$program" run --object golf_ball,tea_light --trials 12 --plan-only --out "$folder/parts"
"$program" submit "$folder/parts" --engine parallel --array 5 >>"$folder/parallel.log" 2>&1
compare_sessions
