#include "core/trial/measures/grasp_types.h"

#include <gtest/gtest.h>

#include "core/hand/load_hand.h"

namespace graspbench {
namespace {

// Roethling 2007, section 2.3.2 and table 2.1 (the row of Iberall 1987).
TEST(GraspTypes, AreTheThesiss) {
  ASSERT_EQ(ListGraspTypeRules().size(), ListGraspTaxa().size());
  for (size_t k = 0; k < ListGraspTaxa().size(); ++k) {
    EXPECT_EQ(ListGraspTypeRules()[k].grasp, ListGraspTaxa()[k].id);
  }
  EXPECT_EQ(FindGraspTypeRule("g1")->opposition, Opposition::kPad);
  EXPECT_EQ(FindGraspTypeRule("g2")->opposition, Opposition::kPad);
  EXPECT_EQ(FindGraspTypeRule("g2")->digits, TypeDigits::kThumbAndIndex);
  EXPECT_EQ(FindGraspTypeRule("g3")->opposition, Opposition::kPalm);
  EXPECT_EQ(FindGraspTypeRule("g4")->opposition, Opposition::kSide);
  EXPECT_STREQ(FindGraspTypeRule("g5")->object, "toy_propeller");
  EXPECT_EQ(FindGraspTypeRule("new-target"), nullptr);
}

TEST(GraspTypes, DigitsThatAreNotThoseOfTheNameAreNamed) {
  const Hand hand = LoadHand("tum");
  EXPECT_EQ(FindIndexFinger(hand), "FF");
  Grasp grasp;
  const auto list = [&](const char* id, const std::vector<std::string>& digits) {
    grasp.id = id;
    grasp.digits = digits;
    return ListTypeFaults(hand, grasp).size();
  };
  EXPECT_EQ(list("g1", {"FF", "MF", "TH"}), 0u);
  EXPECT_EQ(list("g1", {"FF", "TH"}), 1u);
  EXPECT_EQ(list("g2", {"FF", "TH"}), 0u);
  EXPECT_EQ(list("g2", {"MF", "TH"}), 1u);
  EXPECT_EQ(list("g2", {"FF", "MF"}), 1u);
  EXPECT_EQ(list("g4", {"FF", "MF"}), 0u);
  EXPECT_EQ(list("g5", {"FF", "MF"}), 1u);
  EXPECT_EQ(list("new-target", {"MF", "TH"}), 0u);
  grasp.as_called_share = 0.49;
  EXPECT_EQ(list("g2", {"MF", "TH"}), 2u);
  grasp.as_called_share = 0.5;
  EXPECT_EQ(list("g2", {"FF", "TH"}), 0u);
}

TEST(GraspTypes, AHeldTrialIsAsCalledByItsOppositionAndByAllPads) {
  TrialResult result;
  result.contacts = {{"TH", true, 0.4}, {"FF", false, std::nan("")}};
  EXPECT_FALSE(IsAsCalled("g3", result)) << "not held";
  result.opposition = Opposition::kPalm;
  EXPECT_TRUE(IsAsCalled("g3", result)) << "a palm needs no digit more";
  EXPECT_FALSE(IsAsCalled("g1", result));
  result.opposition = Opposition::kPad;
  EXPECT_FALSE(IsAsCalled("g1", result)) << "a digit never touched";
  result.contacts[1].time = 0.5;
  EXPECT_TRUE(IsAsCalled("g1", result));
  EXPECT_FALSE(IsAsCalled("g4", result));
  EXPECT_FALSE(IsAsCalled("new-target", result));
}

TEST(GraspTypes, APalmThatIsSoughtIsForItsWidths) {
  GraspObject object;
  Grasp grasp;
  grasp.id = "g3";
  grasp.seeks_palm = true;
  for (const auto& [width, is_for] : {std::pair(0.039, false), std::pair(0.04, true),
                                      std::pair(0.085, true), std::pair(0.086, false)}) {
    object.size = Eigen::Vector3d(0.1, width, 0.1);
    EXPECT_EQ(IsGraspFor(grasp, object), is_for) << width;
  }
  grasp.seeks_palm = false;
  EXPECT_TRUE(IsGraspFor(grasp, object));
}

}  // namespace
}  // namespace graspbench
