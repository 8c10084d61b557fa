# Shared by the tests of this folder: a session in one run and the same one planned for several
# machines. Usage of a test: <test>.sh PROGRAM FOLDER; 77: skipped, after a line that says why.
set -euo pipefail
program=$1
folder=$2
export OPENBLAS_NUM_THREADS=1 LP_NUM_THREADS=0 XDG_CONFIG_HOME=$folder/config

require() {
  for tool in "$@"; do
    PATH=$PATH:/usr/sbin command -v "$tool" >/dev/null || {
      echo "skipped: $tool is missing; workbench/setup --tests installs it"
      exit 77
    }
  done
}

# One run in $folder/whole, and a plan in $folder/parts.
make_sessions() {
  rm -rf "$folder"
  mkdir -p "$folder/config"
  local session=(--object golf_ball,tea_light --trials "$1")
  "$program" run "${session[@]}" --jobs 1 --out "$folder/whole" >"$folder/whole.log" 2>&1
  "$program" run "${session[@]}" --plan-only --out "$folder/parts"
}

# The results of both are the same bytes, and nothing is damaged.
compare_sessions() {
  local file
  "$program" export "$folder/whole" --records
  "$program" export "$folder/parts" --records
  for file in session.json plan.jsonl export/trials.csv export/events.csv export/records.jsonl \
      index.sqlite report/index.html; do
    cmp "$folder/whole/$file" "$folder/parts/$file"
  done
  "$program" verify "$folder/parts"
}
