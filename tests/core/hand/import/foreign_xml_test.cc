#include "core/hand/import/foreign_xml.h"

#include <gtest/gtest.h>

namespace graspbench {
namespace {

TEST(ParseNumbersTest, BlanksCommasAndSigns) {
  EXPECT_EQ(ParseNumbers(" 1 -2.5,+3e-1\n"), (std::vector<double>{1.0, -2.5, 0.3}));
  EXPECT_EQ(ParseNumbers(""), std::vector<double>());
  for (const char* text : {"1 two", "nan", "inf", "1e9", "1..2", "0x10", "1;2"}) {
    EXPECT_FALSE(ParseNumbers(text)) << text;
  }
}

TEST(NameListTest, EveryNameOnce) {
  NameList names("link");
  std::vector<std::string> changes;
  EXPECT_EQ(names.Add("a", changes), "a");
  EXPECT_TRUE(changes.empty());
  EXPECT_EQ(names.Add("a", changes), "a_2");
  EXPECT_EQ(names.Add("a", changes), "a_3");
  EXPECT_EQ(names.Add(nullptr, changes), "link_4");
  EXPECT_EQ(names.Add("b\tc", changes), "b c");
  EXPECT_EQ(names.Add("\xff", changes), "link_6");
  EXPECT_EQ(changes.size(), 4u);
}

// q2 = 1 + 2 q1, q1 = 3 - q0: q2 = 7 - 2 q0.
TEST(ResolveMimicsTest, FollowsAChainToItsDrive) {
  ForeignHand hand;
  for (const char* name : {"q0", "q1", "q2", "q3"}) {
    ForeignJoint& joint = hand.joints.emplace_back();
    joint.name = name;
    joint.kind = ForeignJoint::Kind::kRevolute;
  }
  Diagnostics problems;
  ResolveMimics({{2, 7, "q1", 2.0, 1.0}, {1, 8, "q0", -1.0, 3.0}, {3, 9, "q3", 1.0, 0.0}}, "tie",
                "h", problems, hand);
  ASSERT_TRUE(hand.joints[2].mimic);
  EXPECT_EQ(hand.joints[2].mimic->joint, 0);
  EXPECT_EQ(hand.joints[2].mimic->ratio, -2.0);
  EXPECT_EQ(hand.joints[2].mimic->offset, 7.0);
  EXPECT_FALSE(hand.joints[0].mimic);
  EXPECT_EQ(problems.Format(),
            "h:9: warning: joint \"q3\": tie of itself; the joint gets a drive of its own");
}

}  // namespace
}  // namespace graspbench
