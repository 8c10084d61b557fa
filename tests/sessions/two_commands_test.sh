#!/usr/bin/env bash
# workbench/run and tests/run in a folder where setup, cmake, ctest and graspbench only say how they
# were called: what is built, what is listed as left out, and that the verdict is the last line.
# Usage: two_commands_test.sh SOURCE FOLDER
set -euo pipefail
source=$1 folder=$2
rm -rf "$folder"
mkdir -p "$folder"/{workbench,tests,build/release,bin}
cp "$source/workbench/run" "$folder/workbench/"
cp "$source/tests/run" "$folder/tests/"
touch "$folder/build/release/build.ninja"
make_program() { cat >"$1"; chmod +x "$1"; }
make_program "$folder/workbench/setup" <<<'#!/bin/sh'
make_program "$folder/build/release/graspbench" <<<'#!/bin/sh
echo graspbench "$@"'
make_program "$folder/bin/cmake" <<<'#!/bin/sh
echo cmake "$@" >>"$CALLS"'
make_program "$folder/bin/ctest" <<'END'
#!/bin/bash
[[ $* == *"--preset slow -N"* ]] && { echo "Total Tests: 7"; exit; }
while [[ $1 != --output-junit ]]; do shift; done
cat >"$2" <<'XML'
	<testcase name="a_tests" classname="a_tests" time="0.5" status="run">
		<system-out>Running main()
[       OK ] A.passes (0 ms)
/a_test.cc:5: Skipped
no &lt;R&gt; on this machine

[  SKIPPED ] A.skips (0 ms)
[  PASSED  ] 1 test.
[  SKIPPED ] 1 test, listed below:
[  SKIPPED ] A.skips

  YOU HAVE 1 DISABLED TEST
</system-out>
	</testcase>
	<testcase name="script" classname="script" time="0" status="notrun">
		<skipped message="SKIP_RETURN_CODE=77"/>
		<system-out>skipped: no node
</system-out>
	</testcase>
	<testcase name="B.sleeps" classname="B.sleeps" time="0" status="disabled">
		<system-out>Disabled</system-out>
	</testcase>
XML
echo "100% tests passed, 0 tests failed out of 3"
echo "The following tests did not run:"
END
export CALLS=$folder/calls PATH=$folder/bin:$PATH

fail() { echo "$1"; exit 1; }
expect() { [[ $2 == "$3" ]] || fail "$1
---- expected
$3
---- found
$2"; }

printed=$("$folder/workbench/run" --trials 3)
expect "workbench/run ends with the program" "$printed" "graspbench run --trials 3"
grep -q -- "--build .*--target graspbench manual$" "$CALLS" ||
  fail "workbench/run does not build the manual: $(cat "$CALLS")"

printed=$("$folder/tests/run" -R A)
expect "what was left out, and the verdict" "$(sed -n '/^Left out:$/,$p' <<<"$printed")" \
"Left out:
A.skips: no <R> on this machine
a_tests: 1 disabled test
script: skipped: no node
B.sleeps: Disabled
tests with the label slow: 7; run ctest --preset slow

100% tests passed, 0 tests failed out of 3"
rm -rf "$folder"
