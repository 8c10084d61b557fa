#!/usr/bin/env bash
# pages_test.sh PROGRAM FOLDER: makes a page of each kind and checks all of them in Chromium.
# Skipped (77) where node, Chromium or the packages of package-lock.json are missing.
set -euo pipefail
program=$1 folder=$2
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd -P)
modules=${GRASPBENCH_NODE_MODULES:-$here}

skip() {
  echo "skipped: $1"
  exit 77
}
command -v node >/dev/null || skip "node is not installed (Debian: nodejs)"
chromium=$(command -v chromium) || skip "chromium is not installed"
[[ -d $modules/node_modules/axe-core ]] || skip "npm packages are missing; fetch them with:
  npm ci --ignore-scripts --prefix '$here'"

mkdir -p "$folder"
work=$(mktemp -d "$folder/pages.XXXXXX")
trap 'rm -rf "$work"' EXIT
cd "$work"
"$program" run --hand tum,shadow --object can,pencil --grasp all --trials 3 --out session >/dev/null 2>&1
"$program" judge session >/dev/null 2>&1
"$program" sensitivity session --set model.mass_scale=2.0 --trials 1 >/dev/null 2>&1
"$program" basin --hand tum --object tennis_ball --samples 12 --out basin >/dev/null 2>&1
"$program" campaign --hand tum --object golf_ball,can --evaluations 6 --trials 2 --out campaign \
  >/dev/null 2>&1
"$program" study demo --out study >/dev/null 2>&1
"$program" sweep --hand tum --object golf_ball,can --trials 2 --factor model.friction_scale=1,0.5 --out sweep \
  >/dev/null 2>&1
"$program" trial session shadow-pencil-g4:1 --page trial.html >/dev/null 2>&1
pages=(trial.html)
for result in session basin campaign study sweep; do
  "$program" report "$result" >/dev/null 2>&1
  pages+=("$result/report/index.html")
done
node "$here/check_pages.cjs" "$modules" "$chromium" "${pages[@]}"
