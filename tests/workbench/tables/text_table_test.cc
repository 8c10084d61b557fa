#include "workbench/tables/text_table.h"

#include <gtest/gtest.h>

namespace graspbench {
namespace {

TEST(TextTable, AlignsNumbersRightAndTextLeft) {
  TextTable table({"hand", "trials", "rate"});
  table.AddRow({"tum", "9", "90.0 %"});
  table.AddRow({"shadow", "210", "n/a"});
  EXPECT_EQ(table.Format(),
            "hand    trials    rate\n"
            "tum          9  90.0 %\n"
            "shadow     210     n/a\n");
}

TEST(TextTable, CountsCharactersNotBytes) {
  TextTable table({"a", "b"});
  table.AddRow({"Röthling", "x"});
  EXPECT_EQ(table.Format(), "a         b\nRöthling  x\n");
}

}  // namespace
}  // namespace graspbench
