#!/bin/bash
# A kind of experiment is at most three files of the product, a protocol two, a factor none: applies
# the patches to copies of what they touch, builds the objects that these are part of with the flags
# of this build, links them before the libraries as they are, and runs the result.
# check_patches.sh SOURCE BUILD
set -eu
source_folder=$1 build=$2 patches=$(dirname "$(realpath "$0")")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

fail() { echo "$*" >&2; exit 1; }

# find_compile OBJECT: the command that makes it, without input and output.
find_compile() { ninja -C "$build" -t commands "$1" | tail -1 | sed -E 's/ -MD .*//'; }

program=workbench/CMakeFiles/workbench.dir/Unity/unity_0_cxx.cxx.o
link=$(ninja -C "$build" -t commands graspbench | tail -1)
[[ $(find_compile $program) && $link == *" -o graspbench "* ]] || fail "no commands in $build"
ninja -C "$build" -t deps >"$work/deps"

# apply PATCH COUNT: into $work/PATCH; what the patch adds, and every object of the product with a
# source that it changes or whose list it makes longer, is built. Linked first, these leave nothing
# to ask the libraries for.
apply() {
  local tree=$work/$1 files file sources object copy
  files=$(sed -nE 's#^\+\+\+ b/([^ ]+).*#\1#p' "$patches/$1.patch")
  [ "$(wc -w <<<"$files")" -le "$2" ] || fail "$1.patch touches more than $2 files:" $files
  for file in $files; do
    mkdir -p "$tree/$(dirname "$file")"
    [ ! -e "$source_folder/$file" ] || cp "$source_folder/$file" "$tree/$file"
  done
  patch -s -p1 -d "$tree" <"$patches/$1.patch"
  objects= sources=
  for file in $files; do
    if [ ! -e "$source_folder/$file" ]; then
      build_object "$tree" "$tree/$file" $program
    else
      sources="$sources $file $(cd "$source_folder" &&
        grep -rl --include='*.cc' "#include \"$file\"" core datasets workbench || true)"
    fi
  done
  for object in $(list_objects "$sources"); do
    copy=$tree/$(tr / _ <<<"$object").cc
    cp "$(find_source "$object")" "$copy"
    for file in $files; do sed -i "s#\"$source_folder/$file\"#\"$tree/$file\"#" "$copy"; done
    build_object "$tree" "$copy" "$object"
  done
}

# list_objects SOURCES: those of the product that are made of any of them.
list_objects() {
  awk -v root="$source_folder/" -v sources="$1" '
    BEGIN { split(sources, names); for (i in names) if (names[i] ~ /cc$/) is_asked[root names[i]] }
    /^[^ ]/ { object = substr($1, 1, length($1) - 1) }
    ($1 in is_asked) && object ~ /^(core|datasets|workbench)\// { print object }
  ' "$work/deps" | sort -u
}

# find_source OBJECT: one file, or one that includes several.
find_source() { ninja -C "$build" -t query "$1" | awk '/^    [^|]/ { print $1; exit }'; }

# build_object TREE FILE OBJECT: as that object is; headers of the tree come first.
build_object() {
  local object compile
  object=$1/$(basename "$2" .cc).o
  compile=$(find_compile "$3")
  (cd "$build" && eval "${compile/ -I/ -I$1 -I} -o $object -c $2")
  objects="$objects $object"
}

# make_program NAME [without main]
make_program() {
  local line=${link/ -o graspbench / $objects -o $work/$1 }
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
build_object "$work/protocol" "$patches/run_protocol.cc" $program
make_program run_protocol without_main
"$work/run_protocol"

# Any setting of a session is a factor: nothing is built.
"$build/graspbench" sweep --hand tum --object golf_ball --trials 1 --out "$work/sweep" \
  --factor strategy.hold_time_s=0.5,0.7 --factor sim.gravity_m_per_s2=9.0,9.80665 >/dev/null
"$build/graspbench" status "$work/sweep" | grep '4 of 4 trials finished'
