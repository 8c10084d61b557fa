#include "core/base/text/data_table.h"

#include <gtest/gtest.h>

#include <cmath>

namespace graspbench {
namespace {

// As spreadsheets of two countries write it: a byte order mark, quotes, carriage returns, tabs.
TEST(DataTable, ReadsWhatSpreadsheetsWrite) {
  for (const std::string text : {"\xef\xbb\xbfname,size_m\r\n\"a, b\",0.5\r\n\r\nc,\r\n",
                                 "name\tsize_m\na, b\t0.5\nc\t\n", "name;size_m\na, b;0.5\nc;\n"}) {
    Diagnostics problems;
    DataTable table(text, "t.csv", problems);
    ASSERT_EQ(table.num_rows(), 2u);
    EXPECT_EQ(table.Text(0, "name"), "a, b");
    EXPECT_EQ(table.Number(0, "size_m"), 0.5);
    EXPECT_TRUE(std::isnan(table.Number(1, "size_m")));
    EXPECT_EQ(table.Text(1, "nothing"), "");
    EXPECT_EQ(problems.Format(), "");
  }
}

// RFC 4180, section 2.7: a quote inside a quoted cell is written twice.
TEST(DataTable, TwoQuotesInAQuotedCellAreOne) {
  Diagnostics problems;
  const DataTable table(
      "a,b,\"c \"\"x\"\"\"\n\"=F(\"\"u\"\",\"\"v\"\")\",\"\",\"\"\"\"\na\"\"b, \"x,\"\"\" ,1\n",
      "t.csv", problems);
  EXPECT_EQ(problems.Format(), "");
  ASSERT_EQ(table.num_rows(), 2u);
  EXPECT_EQ(table.Text(0, "a"), "=F(\"u\",\"v\")");
  EXPECT_EQ(table.Text(0, "b"), "");
  EXPECT_EQ(table.Text(0, "c \"x\""), "\"");
  EXPECT_EQ(table.Text(1, "a"), "a\"\"b");  // not quoted: as it is
  EXPECT_EQ(table.Text(1, "b"), "x,\"");
}

TEST(DataTable, EveryFaultHasItsLine) {
  Diagnostics problems;
  DataTable table("a,b,a\n1,2,3\n1,2\n1,x,3\n", "t.csv", problems);
  table.Require("c");
  EXPECT_TRUE(std::isnan(table.Number(1, "b")));
  std::vector<int> lines;
  for (const Diagnostic& entry : problems.entries()) lines.push_back(entry.line);
  EXPECT_EQ(lines, (std::vector<int>{1, 3, 1, 4})) << problems.Format();
  Diagnostics empty;
  DataTable nothing("", "t.csv", empty);
  EXPECT_EQ(empty.num_errors(), 1);
}

}  // namespace
}  // namespace graspbench
