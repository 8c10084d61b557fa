#!/usr/bin/env bash
# GNU parallel, terminated and started again with its list of what is done: the same bytes as one run.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"
require parallel seq
make_sessions 12

work() {
  parallel --jobs 2 --joblog "$folder/joblog" --resume-failed "$@" \
    "$program" work "$folder/parts" --shard "{}/7" ::: 5 2 7 1 4 6 3 >>"$folder/parallel.log" 2>&1
}
# The first two are told to stop before their last trial; parallel starts no other one.
! work --halt now,fail=1 --timeout 0.4 --termseq TERM,20000
grep -q "left and the finished ones are kept" "$folder/parallel.log"
work
"$program" merge "$folder/parts" >"$folder/merge.log" 2>&1
compare_sessions

# The same by the program's own script, on a plan of its own.
rm -r "$folder/parts"
"$program" run --object golf_ball,tea_light --trials 12 --plan-only --out "$folder/parts"
"$program" submit "$folder/parts" --engine parallel --array 5 >>"$folder/parallel.log" 2>&1
compare_sessions
