#include "human_study/study/design/study_levels.h"

#include <gtest/gtest.h>

#include "core/base/diagnostics.h"
#include "core/base/text/data_table.h"

namespace graspbench {
namespace {

using Names = std::vector<std::string>;

TEST(ReadFactors, EqualNumbersAreOneLevelAsFirstWritten) {
  Diagnostics problems;
  DataTable table("size,pace\n10.0,10\n0.030,1.0\n10,b\n3e-2,1\n", "trials.csv", problems);
  const std::vector<Factor> factors = ReadFactors({"size", "pace"}, table);
  EXPECT_EQ(factors[0].levels, (Names{"0.030", "10.0"}));
  EXPECT_EQ(factors[0].numbers, (std::vector<double>{0.03, 10.0}));
  EXPECT_EQ(FindLevel(factors[0].levels, "3e-2"), "0.030");
  EXPECT_EQ(FindLevel(factors[0].levels, "10"), "10.0");
  // With one word among them they are names, and 1.0 and 1 two of them.
  EXPECT_EQ(factors[1].levels, (Names{"10", "1.0", "b", "1"}));
  EXPECT_TRUE(factors[1].numbers.empty());
  EXPECT_EQ(FindLevel(factors[1].levels, "1"), "1");
}

TEST(WarnOfLookAlikes, NamesBothSpellings) {
  Diagnostics problems;
  const DataTable table("participant\nP00\nP01\np00\nP00\n", "trials.csv", problems);
  WarnOfLookAlikes("participant", table, problems);
  ASSERT_EQ(problems.entries().size(), 1u);
  EXPECT_EQ(problems.entries()[0].line, 4);
  EXPECT_EQ(problems.entries()[0].text,
            "participant: \"p00\" and \"P00\" count as two; if they are one, spell them alike");
  EXPECT_EQ(problems.num_errors(), 0);
}

}  // namespace
}  // namespace graspbench
