#!/usr/bin/env bash
# Every command in the README's table of results starts: its options exist and its inputs are found.
# Plans are made and not run. A map is interrupted after some seconds: 75, or 130 while it prepares.
# The page how-good.md of the manual runs selftest.
# Usage: readme_commands_test.sh README PROGRAM_FOLDER FOLDER
set -euo pipefail
readme=$1 folder=$3
export PATH=$2:$PATH
rm -rf "$folder"
mkdir -p "$folder"
cd "$folder"
mkdir objects
graspbench new object objects/thing >output 2>&1 || { cat output; exit 1; }

mapfile -t commands < <(sed -n 's/^| .*| `\(graspbench [^`]*\)`[^|]* |$/\1/p' "$readme")
if [[ ${#commands[@]} -ne 6 ]]; then
  echo "$readme: the table has ${#commands[@]} commands; expected 6"
  exit 1
fi
for command in "${commands[@]}"; do
  line=${command//FOLDER/objects}
  case $line in
    *" selftest") line+=" --help" ;;
    *" map "*) line="timeout --preserve-status --signal=INT 4 $line" ;;
    *) line+=" --plan-only" ;;
  esac
  status=0
  bash -c "$line" >output 2>&1 || status=$?
  if [[ $status -ne 0 && ! ($line == timeout* && $status =~ ^(75|130)$) ]]; then
    echo "$command: exit $status"
    cat output
    exit 1
  fi
done
cd /
rm -rf "$folder"
