#include "workbench/text/typed_words.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "datasets/plan/scene_names.h"

namespace graspbench {
namespace {

using Words = std::vector<std::string>;

TEST(TypedWords, AreSplitAtBlanksOutsideOfQuotes) {
  EXPECT_EQ(SplitWords(""), Words());
  EXPECT_EQ(SplitWords("  \t "), Words());
  EXPECT_EQ(SplitWords(" goto\t1.25s\r"), Words({"goto", "1.25s"}));
  EXPECT_EQ(SplitWords("save 'my grasp.yaml'"), Words({"save", "my grasp.yaml"}));
  EXPECT_EQ(SplitWords("'a b'c ''"), Words({"a bc", ""}));
  EXPECT_EQ(SplitWords("it's \"it's\""), Words({"it's", "it's"}));
}

TEST(TypedWords, EndAtAComment) {
  EXPECT_EQ(SplitWords("# all of it"), Words());
  EXPECT_EQ(SplitWords("run # to the end"), Words({"run"}));
  EXPECT_EQ(SplitWords("save a#b '#c'"), Words({"save", "a#b", "#c"}));
}

TEST(TypedWords, AQuoteWithoutEndIsRefused) {
  EXPECT_THROW(SplitWords("save 'my grasp"), Error);
  EXPECT_THROW(SplitWords("\""), Error);
}

TEST(TypedWords, NamesAreComparedWithoutCase) {
  EXPECT_EQ(MakeComparable("Light Bulb"), "light_bulb");
  EXPECT_EQ(MakeComparable("TUM-Hand"), "tum_hand");
}

TEST(TypedWords, NumbersMayCarryTheirUnit) {
  EXPECT_EQ(ParseNumber("1.25", "the time", "s", 0.0, 10.0), 1.25);
  EXPECT_EQ(ParseNumber("1.25s", "the time", "s", 0.0, 10.0), 1.25);
  EXPECT_EQ(ParseNumber("-3deg", "the angle", "deg", -5.0, 5.0), -3.0);
  for (const char* wrong : {"", "s", "nan", "inf", "1e999", "1 2", "1ms", "11", "-1", "0x"}) {
    EXPECT_THROW(ParseNumber(wrong, "the time", "s", 0.0, 10.0), Error) << wrong;
  }
  EXPECT_EQ(ParseCount("7", "the draw", 0, 9), 7);
  for (const char* wrong : {"", "1.5", "ten", "-1", "10", "99999999999999999999"}) {
    EXPECT_THROW(ParseCount(wrong, "the draw", 0, 9), Error) << wrong;
  }
}

}  // namespace
}  // namespace graspbench
