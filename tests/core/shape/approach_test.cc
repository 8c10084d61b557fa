#include "core/shape/approach.h"

#include <gtest/gtest.h>

#include <string>

#include "core/base/diagnostics.h"
#include "core/base/text/yaml.h"

namespace graspbench {
namespace {

Approach Read(const std::string& text, Diagnostics& problems) {
  YamlMap map(ParseYaml(text, "thing.yaml", problems), "thing.yaml", "thing", problems);
  Approach approach = Approach::kAutomatic;
  ReadApproach(map, approach);
  map.FinishKnownKeys();
  return approach;
}

TEST(ApproachTest, IsReadByItsNameAndMayBeLeftOut) {
  Diagnostics problems;
  for (const ApproachRow& row : kApproaches) {
    EXPECT_EQ(Read(std::string("approach: ") + row.name, problems), row.value);
  }
  EXPECT_EQ(Read("{}", problems), Approach::kAutomatic);
  EXPECT_EQ(problems.num_errors(), 0);
}

TEST(ApproachTest, AnotherWordIsRefusedWithAHint) {
  Diagnostics problems;
  Read("\napproach: sied\n", problems);
  ASSERT_EQ(problems.num_errors(), 1);
  EXPECT_EQ(problems.entries().front().line, 2);
  EXPECT_NE(problems.entries().front().text.find("thing, approach: no approach \"sied\"; did you "
                                                 "mean \"side\"? Known: automatic, above, side"),
            std::string::npos)
      << problems.entries().front().text;
}

}  // namespace
}  // namespace graspbench
