#!/bin/bash
# A kind of experiment is at most three files of the product, a protocol two, a factor none: applies
# the patches to copies of what they touch, builds that with the flags of this build, links it before
# the libraries as they are, and runs it.
# check_patches.sh SOURCE BUILD
set -eu
source_folder=$1 build=$2 patches=$(dirname "$(realpath "$0")")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

fail() { echo "$*" >&2; exit 1; }

# The command that compiles a file as those of the program's library, without input and output.
compile=$(grep -m1 '"command":.*workbench/CMakeFiles/workbench.dir/' "$build/compile_commands.json" |
  sed -E 's/^ *"command": "(.*)",$/\1/; s/\\"/"/g; s/\\\\/\\/g; s/ -o [^ ]+ -c .*//')
link=$(ninja -C "$build" -t commands graspbench | tail -1)
[ -n "$compile" ] && [[ $link == *" -o graspbench "* ]] || fail "no commands in $build"

# apply PATCH COUNT: into $work/PATCH; every touched .cc, and what includes another, to an object.
apply() {
  local tree=$work/$1 files file includer
  files=$(sed -nE 's#^\+\+\+ b/([^ ]+).*#\1#p' "$patches/$1.patch")
  [ "$(wc -w <<<"$files")" -le "$2" ] || fail "$1.patch touches more than $2 files:" $files
  for file in $files; do
    mkdir -p "$tree/$(dirname "$file")"
    [ ! -e "$source_folder/$file" ] || cp "$source_folder/$file" "$tree/$file"
  done
  patch -s -p1 -d "$tree" <"$patches/$1.patch"
  objects=
  for file in $files; do
    if [[ $file == *.cc ]]; then
      build_object "$tree" "$tree/$file"
    else
      for includer in $(grep -rl --include='*.cc' "#include \"$file\"" "$source_folder"/{core,datasets,workbench}); do
        build_object "$tree" "$includer"
      done
    fi
  done
}

# build_object TREE FILE: headers of the tree come first.
build_object() {
  local object
  object=$1/$(basename "$2" .cc).o
  (cd "$build" && eval "${compile/ -I/ -I$1 -I} -o $object -c $2")
  objects="$objects $object"
}

# make_program NAME [without main]
make_program() {
  local line=${link/ -o graspbench / -Wl,--allow-multiple-definition $objects -o $work/$1 }
  [ $# -lt 2 ] || line=${line/workbench\/CMakeFiles\/graspbench.dir\/main.cc.o/}
  (cd "$build" && eval "$line")
}

apply experiment_kind 3
make_program graspbench
"$work/graspbench" run --hand tum --object golf_ball --trials 2 --out "$work/session" >/dev/null
"$work/graspbench" heavy "$work/session" | tee "$work/told"
grep -q '^2 trials compared' "$work/told" || fail "the new kind has compared nothing"
"$work/graspbench" status "$work/session"/heavy/* | grep '4 of 4 trials finished'
"$work/graspbench" verify "$work/session" >/dev/null  # its stores are the session's

apply protocol 2
build_object "$work/protocol" "$patches/run_protocol.cc"
make_program run_protocol without_main
"$work/run_protocol"

# Any setting of a session is a factor: nothing is built.
"$build/graspbench" sweep --hand tum --object golf_ball --trials 1 --out "$work/sweep" \
  --factor strategy.hold_time_s=0.5,0.7 --factor sim.gravity_m_per_s2=9.0,9.80665 >/dev/null
"$build/graspbench" status "$work/sweep" | grep '4 of 4 trials finished'
