#include "workbench/text/glossary.h"

#include <gtest/gtest.h>

namespace graspbench {
namespace {

TEST(GlossaryText, AMeasureIsFoundByEachOfItsNamesAndColumns) {
  for (const char* word : {"GFT", "gft", "Grasp forming time", "gft_s"}) {
    const std::vector<GlossaryEntry> found = FindInGlossary(word);
    ASSERT_EQ(found.size(), 1u) << word;
    EXPECT_EQ(found[0].term, "GFT, grasp forming time");
    EXPECT_EQ(found[0].columns, "gft_s, grasp_forming_time_s");
    EXPECT_EQ(found[0].meaning, "max t_i - min t_i [s]; 0: all digits touch together");
  }
}

TEST(GlossaryText, AnotherWordIsNotFound) {
  EXPECT_TRUE(FindInGlossary("gftt").empty());
  EXPECT_TRUE(FindInGlossary("").empty());
  EXPECT_TRUE(FindInGlossary("-").empty());
}

TEST(GlossaryText, AnEntryWithoutColumnsNamesNone) {
  const std::string text = FormatGlossary(FindInGlossary("hand opening"));
  EXPECT_EQ(text.find("columns"), text.npos) << text;
}

}  // namespace
}  // namespace graspbench
