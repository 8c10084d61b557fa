#!/bin/bash
# Every bar of the regulated grip, one setting after the other:  tests/bench/grip_bars.sh BUILD OUT
# BUILD is the build folder; OUT gets a file of trials and shares for each setting. A setting whose
# file is there is not run again.
set -e
bench=$1/tests/bench/grip_bench
mkdir -p "$2"
run() {
  local file=$2/$3.txt
  [ -s "$file" ] && return
  "$1" --threads 2 --list trials=10 seed=7 strategy.touch_speed=0.25 "${@:4}" >"$file.part"
  mv "$file.part" "$file"
}
for force in 0.7 1.5 3; do
  run "$bench" "$2" "force-$force" strategy.grip=force "strategy.grip_force_n=$force"
done
for margin in 1.5 2 4; do
  run "$bench" "$2" "margin-$margin" strategy.grip=margin "strategy.grip_margin=$margin" \
    strategy.grip_force_n=0
done
run "$bench" "$2" people strategy.grip=margin strategy.grip_margin=2 strategy.grip_force_n=0.7
run "$bench" "$2" sensed-1.5 strategy.grip=force strategy.grip_force_n=1.5 touch=sensed
run "$bench" "$2" people-1-ms strategy.grip=margin strategy.grip_margin=2 strategy.grip_force_n=0.7 \
  sim.step_s=0.001 trials=6
for hand in tum shadow; do
  run "$bench" "$2" "thresholds-$hand" --thresholds "hands=$hand" strategy.grip=margin \
    strategy.grip_force_n=0
done
