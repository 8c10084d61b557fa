#include "core/grasp/standard_grasp.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "core/base/units.h"
#include "core/grasp/grasp_file.h"
#include "core/hand/load_hand.h"

namespace graspbench {
namespace {

// Roethling 2007: yaw 90 deg for two finger pinch and three finger special, 75 deg for the others;
// d and alpha are the same for every hand.
TEST(GraspTaxa, CarryTheHandIndependentParameters) {
  ASSERT_EQ(ListGraspTaxa().size(), 6u);
  for (const GraspTaxon& taxon : ListGraspTaxa()) {
    const bool is_ninety = taxon.id == "g4" || taxon.id == "g5";
    EXPECT_NEAR(taxon.alpha, RadFromDeg(is_ninety ? 90.0 : 75.0), 1e-12) << taxon.id;
    EXPECT_EQ(taxon.approach_distance, 0.1);
  }
  try {
    FindGraspTaxon("g9");
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::kNotFound);
    EXPECT_STREQ(e.what(), "no grasp \"g9\"; did you mean \"g1\"? Known: g1, g2, g3, g4, g5, g6");
  }
}

TEST(StandardGrasps, StayWithinTheJointLimitsOfEveryHand) {
  for (const std::string& id : ListHands()) {
    const Hand hand = LoadHand(id);
    const auto grasps = LoadStandardGrasps(hand);
    EXPECT_FALSE(grasps.empty()) << id;
    for (const Grasp& grasp : grasps) {
      for (int j = 0; j < hand.num_joints(); ++j) {
        for (double q : {grasp.q_pre[j], grasp.q_target[j]}) {
          EXPECT_GE(q, hand.joints[j].lower - 1e-6) << id << " " << grasp.id;
          EXPECT_LE(q, hand.joints[j].upper + 1e-6) << id << " " << grasp.id;
        }
      }
      EXPECT_GE(grasp.digits.size(), 2u);
    }
  }
}

class BrokenGraspsTest : public testing::Test {
 protected:
  /** Message for the given grasps of the three-finger hand; empty when they are accepted. */
  std::string ReadWith(const std::string& grasps) {
    const std::filesystem::path folder =
        std::filesystem::path(testing::TempDir()) /
        testing::UnitTest::GetInstance()->current_test_info()->name();
    std::filesystem::create_directories(folder);
    Hand hand = LoadHand("tum");
    hand.folder = folder.string();
    WriteFileAtomically(folder / "hand.yaml", grasps);
    try {
      LoadStandardGrasps(hand);
      return "";
    } catch (const Error& e) {
      std::string text = e.what();
      const std::string prefix = folder.string() + "/";
      for (size_t at; (at = text.find(prefix)) != std::string::npos;) text.erase(at, prefix.size());
      return text;
    }
  }
};

TEST_F(BrokenGraspsTest, EveryProblemIsToldWithItsLine) {
  EXPECT_EQ(ReadWith("grasps:\n"
                     "  g2:\n"
                     "    digits: [TH, FX]\n"
                     "    tilt_deg: flat\n"
                     "    pre_deg: {TH: [0, 0, 0], FF: [0, 0], MF: [0, 0, 0]}\n"
                     "    target_deg: {TH: [0, 99, 0], FF: [0, 0, 0], MF: [0, 0, 0]}\n"
                     "  g7: {}\n"),
            "the grasps of hand \"tum\" cannot be used:\n"
            "hand.yaml:4: error: grasp g2, tilt_deg: expected a finite number\n"
            "hand.yaml:3: error: grasp g2, digits: the hand has no digit \"FX\"; did you mean "
            "\"FF\"? Known: FF, MF, TH\n"
            "hand.yaml:5: error: grasp g2, pre_deg, FF: expected 3 angles, one for each driven "
            "joint from base to tip, found 2\n"
            "hand.yaml:6: error: grasp g2, target_deg, TH: joint THq2 at 99.000000 deg is outside "
            "its limits\n"
            "hand.yaml:7: error: grasps: unknown key \"g7\"; did you mean \"g1\"? Known: g1, g2, "
            "g3, g4, g5, g6");
}

TEST_F(BrokenGraspsTest, AWrongApproachAndGapAreTold) {
  const std::string problems = ReadWith(
      "grasps:\n"
      "  g3:\n"
      "    digits: [TH, FF]\n"
      "    tilt_deg: 0\n"
      "    palm_gap_m: 0.5\n"
      "    approach: up\n"
      "    pre_deg: {TH: [0, 0, 0], FF: [0, 0, 0], MF: [0, 0, 0]}\n"
      "    target_deg: {TH: [0, 0, 0], FF: [0, 0, 0], MF: [0, 0, 0]}\n");
  EXPECT_NE(problems.find("hand.yaml:5: error: grasp g3, palm_gap_m"), problems.npos) << problems;
  EXPECT_NE(problems.find("hand.yaml:6: error: grasp g3, approach: no approach \"up\". Known: "
                          "automatic, above, side"),
            problems.npos)
      << problems;
}

TEST_F(BrokenGraspsTest, AHandWithoutGraspsHasNone) { EXPECT_EQ(ReadWith("name: x\n"), ""); }

// Iberall's oppositions are what a finished grasp is looked at for; one taxonomy knows no pinch.
TEST(GraspTaxonomies, AreSevenOfFourTypesByYear) {
  const std::vector<GraspTaxonomy>& all = ListGraspTaxonomies();
  ASSERT_EQ(all.size(), 7u);
  int num_missing = 0;
  for (size_t k = 0; k < all.size(); ++k) {
    EXPECT_LE(all[k == 0 ? 0 : k - 1].year, all[k].year);
    for (const char* name : all[k].names) {
      ASSERT_NE(name, nullptr);
      num_missing += name == std::string("-");
    }
  }
  EXPECT_EQ(num_missing, 1);
  EXPECT_STREQ(all[1].names[3], "-");
  EXPECT_STREQ(all.back().names[2], "palm opposition");
  EXPECT_STREQ(all.back().names[3], "side opposition");
}

// A standard grasp has its type's name, but for the fifth, made for one object, and the sixth.
TEST(GraspTaxonomies, TypesAreNamedAsTheStandardGrasps) {
  for (const GraspTaxon& taxon : ListGraspTaxa()) {
    if (taxon.id == "g5" || taxon.id == "g6") continue;
    EXPECT_EQ(taxon.name, NameOf(taxon.type));
    EXPECT_EQ(taxon.id.substr(1), std::string(CodeOf(taxon.type)).substr(1));
  }
}

}  // namespace
}  // namespace graspbench
