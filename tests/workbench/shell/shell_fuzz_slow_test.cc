/** @file A million lines for the shell. */

#include <iostream>

#include "tests/workbench/shell/shell_fuzz.h"

namespace graspbench {
namespace {

TEST(ShellFuzzSlow, AMillionLinesDoNoHarm) {
  Shell shell;
  FuzzCount count;
  {
    const Silence silence;
    count = FuzzShell(shell, "million", 1000000);
  }
  EXPECT_GT(count.num_refused, 500000);
  EXPECT_GT(count.num_done, 50000);
  std::cout << count.num_refused << " refused, " << count.num_done << " carried out\n";
}

}  // namespace
}  // namespace graspbench
