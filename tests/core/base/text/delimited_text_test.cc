#include "core/base/text/delimited_text.h"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

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

TEST(ParseNumber, ADecimalCommaIsSaid) {
  std::istringstream stream("1;-350,09;1,2,3\n");
  LineReader reader(stream, "take.csv");
  std::string_view line;
  reader.Next(line);
  Cells cells;
  SplitCells(line, ';', cells);
  const auto fault = [&](size_t column) -> std::string {
    try {
      ParseNumber(cells, column, reader);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(
      fault(1),
      "take.csv:1: column 2: \"-350,09\" is not a number: it has a decimal comma; export with "
      "points");
  EXPECT_EQ(fault(2), "take.csv:1: column 3: \"1,2,3\" is not a number");
}

TEST(DataTable, Utf16IsSaidOnceAndNotShown) {
  Diagnostics problems;
  const std::string text = "participant,file\n1,a.c3d\n";
  std::string wide = "\xff\xfe";
  for (const char c : text) wide += {c, '\0'};
  const DataTable table(wide, "trials.csv", problems);
  EXPECT_EQ(
      problems.Format(),
      "trials.csv: error: is UTF-16 (\"Unicode text\" of a spreadsheet); save it as UTF-8, for "
      "instance as \"CSV UTF-8\"");
}

TEST(Diagnostics, EqualTextsAreOneLineWithTheirNumber) {
  Diagnostics problems;
  for (int line = 2; line < 302; ++line) problems.Warn("a.csv", line, "empty");
  problems.Warn("a.csv", 7, "other");
  problems.Fail("a.csv", 8, "empty");
  problems.Fail("a.csv", 9, "empty");
  problems.Warn("a.csv", 0, "whole");
  problems.Warn("a.csv", 0, "whole");
  EXPECT_EQ(problems.Format(),
            "a.csv:2: warning: empty (and 299 more lines: 3, 4, 5 ..)\n"
            "a.csv:7: warning: other\n"
            "a.csv:8: error: empty (and 1 more line: 9)\n"
            "a.csv: warning: whole (and 1 more line)");
  EXPECT_EQ(problems.num_errors(), 2);
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
