#include "workbench/experiments/machines/shell_quote.h"

#include <gtest/gtest.h>

namespace graspbench {
namespace {

TEST(QuoteForShell, QuotesOnlyWhatAShellWouldRead) {
  EXPECT_EQ(QuoteForShell("results/pilot-1_a.yaml"), "results/pilot-1_a.yaml");
  EXPECT_EQ(QuoteForShell(""), "''");
  EXPECT_EQ(QuoteForShell("my pilot"), "'my pilot'");
  EXPECT_EQ(QuoteForShell("$(reboot)"), "'$(reboot)'");
  EXPECT_EQ(QuoteForShell("it's"), "'it'\\''s'");
}

}  // namespace
}  // namespace graspbench
