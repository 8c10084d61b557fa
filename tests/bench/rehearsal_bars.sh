#!/bin/bash
# Rehearsed against predicted grasps on objects of no family of the program, and on scans:
#   tests/bench/rehearsal_bars.sh BUILD OUT COUNT [SCANS]
# COUNT objects of each sort (rehearsal_objects.py), SCANS a folder of more objects. 10 fresh draws of
# each hand and object, under the model and under friction x 0.8 with mass x 1.2. Pairs that are not
# robust are rehearsed with 10 draws: whether any candidate is. What is there is not run again.
# OUT/rehearsal.txt has the figures.
set -e
bench=$(dirname "$0")
program=$1/graspbench
mkdir -p "$2"
python3 "$bench/rehearsal_objects.py" "$2/objects" "$3"
objects=$2/objects${4:+,$4}
run() {  # OUT NAME OPTION..
  local resume=
  [ -d "$1/$2" ] && resume=--resume
  "$program" run --trials 10 $resume --jobs "${JOBS:-2}" --out "$1/$2" "${@:3}" >"$1/$2.txt"
}
/usr/bin/time -f '%U s of processor time to rehearse' -o "$2/time.txt" -a \
  "$program" rehearse --jobs "${JOBS:-2}" --object "$objects" --out "$2/rehearsed" >"$2/rehearsed.txt"
run "$2" fresh --object "$objects" --grasp predicted,rehearsed
files=$(echo "$2"/rehearsed/grasps/*/*.yaml | tr ' ' ',')
run "$2" wrong --object "$objects" --grasp "predicted,$files" --set model.mass_scale=1.2 \
  --set model.friction_scale=0.8
for hand in tum shadow; do
  left=$(python3 "$bench/rehearsal_figures.py" "$2" --left "$hand" "$objects")
  [ -z "$left" ] || run "$2" "oracle-$hand" --hand "$hand" --object "$left" --grasp rehearsed:40,10
done
python3 "$bench/rehearsal_figures.py" "$2" | tee "$2/rehearsal.txt"
