#include "datasets/grasps/map_to_hand.h"

#include <gtest/gtest.h>

#include "core/hand/load_hand.h"
#include "tests/datasets/grasps/grasp_cases.h"

// Fingertips of the Shadow Hand as the model of MuJoCo Menagerie has them, calculated apart from
// this program from the numbers of its MJCF (4 x 4 matrices, quaternions as they stand there).

namespace graspbench {

namespace {

constexpr double kTolerance = 7e-6;  // [m]: 0.00858 and the maker's rounding

void ExpectTips(const Hand& hand, const HandStage& stage,
                const std::vector<Eigen::Vector3d>& tips) {
  for (size_t d = 0; d < hand.digits.size(); ++d) {
    const Digit& digit = hand.digits[d];
    const Eigen::Vector3d tip =
        stage.X_OH * CalcLinkPose(hand, stage.q, digit.distal_link) * digit.p_LTip;
    EXPECT_LT((tip - tips[d]).norm(), kTolerance) << digit.id << ": " << tip.transpose();
  }
}

TEST(MapToHand, FingertipsAreWhereTheFilesHandHasThem) {
  const Hand hand = LoadHand("shadow");
  const ForeignGrasp bodex = ReadGraspCase("dexgraspbench", "good_bodex.npy")[0];
  ExpectTips(hand, MapToHand(bodex, hand).stages[1],
             {{-0.3903799, -0.025007, -0.5040134},
              {-0.3667093, -0.0258595, -0.4818842},
              {-0.3932876, 0.0296634, -0.485236},
              {-0.3062951, 0.0003413, -0.4958213},
              {-0.3962079, -0.0364326, -0.4775347}});
  const ForeignGrasp dexonomy = ReadGraspCase("dexgraspbench", "good_dexonomy.npy")[1];
  const HandGrasp mapped = MapToHand(dexonomy, hand);
  ExpectTips(hand, mapped.stages[2],
             {{0.1049749, -0.2000247, 0.0238944},
              {0.1213537, -0.0955184, 0.043248},
              {0.1469517, -0.120401, 0.0423636},
              {0.1402546, -0.0721111, 0.062885},
              {0.0869826, -0.1406459, 0.0387996}});
  ASSERT_EQ(mapped.assumptions.size(), 1u);
  EXPECT_EQ(mapped.assumptions[0], "joints of the wrist at 0: WRJ2, WRJ1");
}

TEST(MapToHand, RefusesAHandWithOtherJoints) {
  const ForeignGrasp grasp = ReadGraspCase("dexgraspbench", "good_bodex.npy")[0];
  EXPECT_TRUE(Has(FindError([&] { MapToHand(grasp, LoadHand("tum")); }), "has no joint \"FFJ4\""));
}

TEST(MapToHand, RefusesDegrees) {
  ForeignGrasp grasp = ReadGraspCase("dexgraspbench", "good_bodex.npy")[0];
  grasp.stages[1].joints[2] = 42.0;
  EXPECT_TRUE(Has(FindError([&] { MapToHand(grasp, LoadHand("shadow")); }),
                  "FFJ2 at 42 rad, more than a full turn"));
}

TEST(MapToHand, RefusesAHandOfOtherSize) {
  Hand hand = LoadHand("shadow");
  const ForeignGrasp grasp = ReadGraspCase("dexgraspbench", "good_bodex.npy")[0];
  HandLink& middle = hand.links[static_cast<size_t>(hand.FindLink("mfmiddle"))];
  middle.X_PJ.translation().z() += 0.0009;
  EXPECT_EQ(FindError([&] { MapToHand(grasp, hand); }), "");
  middle.X_PJ.translation().z() += 0.0002;
  EXPECT_TRUE(Has(FindError([&] { MapToHand(grasp, hand); }), "lies 1.1 mm from"));
}

TEST(MapToHand, RefusesAFrameThatTheHandDoesNotHave) {
  const Hand hand = LoadHand("shadow");
  ForeignGrasp grasp = ReadGraspCase("dexgraspbench", "good_bodex.npy")[0];
  grasp.root_link = "pallm";
  EXPECT_TRUE(Has(FindError([&] { MapToHand(grasp, hand); }), "did you mean \"palm\""));
  grasp.root_link = "ffmiddle";
  EXPECT_TRUE(Has(FindError([&] { MapToHand(grasp, hand); }), "moves with a digit"));
  grasp.root_link = "palm";
  EXPECT_TRUE(MapToHand(grasp, hand).stages[0].X_OH.isApprox(grasp.stages[0].X_OR, 1e-15));
}

TEST(MapToHand, RefusesWhatTheFileDoesNotState) {
  const Hand hand = LoadHand("shadow");
  ForeignGrasp grasp = ReadGraspCase("dexgraspbench", "good_bodex.npy")[0];
  grasp.joint_names.erase(grasp.joint_names.begin());
  for (GraspStage& stage : grasp.stages) stage.joints.erase(stage.joints.begin());
  EXPECT_TRUE(Has(FindError([&] { MapToHand(grasp, hand); }), "states no position of FFJ4"));
}

TEST(MapToHand, CoupledJointsThatAreNotStatedFollow) {
  Hand hand = LoadHand("shadow");
  hand.coupling = CouplingRule::kFixed;
  ForeignGrasp grasp = ReadGraspCase("dexgraspbench", "good_bodex.npy")[0];
  grasp.joint_names.erase(grasp.joint_names.begin() + 3);
  for (GraspStage& stage : grasp.stages) stage.joints.erase(stage.joints.begin() + 3);
  const HandGrasp mapped = MapToHand(grasp, hand);
  const Eigen::VectorXd& q = mapped.stages[1].q;
  EXPECT_DOUBLE_EQ(q[hand.FindJoint("FFJ1")], 0.8 * q[hand.FindJoint("FFJ2")]);
  // That of another finger is stated, so it stays.
  EXPECT_EQ(q[hand.FindJoint("MFJ1")], q[hand.FindJoint("MFJ2")]);
  EXPECT_EQ(mapped.assumptions.back(), "joints that follow their coupling: FFJ1");
}

TEST(MapToHand, FindsNamesBehindAPrefix) {
  Hand hand = LoadHand("shadow");
  for (HandJoint& joint : hand.joints) joint.name = "rh_" + joint.name;
  for (HandLink& link : hand.links) link.name = "rh_" + link.name;
  const ForeignGrasp grasp = ReadGraspCase("dexgraspbench", "good_bodex.npy")[0];
  const Hand plain = LoadHand("shadow");
  EXPECT_EQ(MapToHand(grasp, hand).stages[1].q, MapToHand(grasp, plain).stages[1].q);
}

std::vector<int> FindJoints(const Hand& hand) {
  std::vector<int> joints;
  for (const std::string& name : ListDexgraspbenchJoints()) joints.push_back(hand.FindJoint(name));
  return joints;
}

TEST(ShadowLayout, OurShadowHandIsThatOfMenagerie) {
  const Hand hand = LoadHand("shadow");
  EXPECT_LT(CalcShadowDifference(hand, FindJoints(hand)), 7e-6);
}

TEST(ShadowLayout, SeesALinkThatIsLongerAndAnAxisThatIsReversed) {
  Hand hand = LoadHand("shadow");
  hand.links[static_cast<size_t>(hand.FindLink("ffdistal"))].X_PJ.translation().z() += 0.003;
  EXPECT_NEAR(CalcShadowDifference(hand, FindJoints(hand)), 0.003, 1e-5);
  hand = LoadHand("shadow");
  hand.links[static_cast<size_t>(hand.FindLink("ffknuckle"))].axis *= -1.0;
  EXPECT_GT(CalcShadowDifference(hand, FindJoints(hand)), 0.02);
}

}  // namespace

}  // namespace graspbench
