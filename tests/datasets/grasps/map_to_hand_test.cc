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

/** A gripper of MultiGripperGrasp with two slides, as the table of franka_panda means it. */
ForeignGrasp MakeTabulatedGrasp(const std::string& gripper) {
  ForeignGrasp grasp;
  grasp.format = "multigripper";
  grasp.hand = gripper;
  grasp.root_link = "palm";
  grasp.joint_names = {"FFq1", "THq1"};
  grasp.stages = {{"pregrasp", Pose::Identity(), {0.1, 0.2}}};
  return grasp;
}

TEST(MapToHand, AGripperOfMultiGripperGraspClosesByItsTable) {
  Hand hand;
  hand.id = "jaws";
  hand.links.resize(3);
  hand.links[0].name = "palm";
  hand.links[1].name = "gripper.left";
  hand.links[2].name = "gripper_right";
  for (int j = 0; j < 2; ++j) {
    HandJoint joint;
    joint.name = j == 0 ? "FFq1" : "THq1";
    joint.link = j + 1;
    hand.links[static_cast<size_t>(j) + 1].parent = 0;
    hand.links[static_cast<size_t>(j) + 1].joint = j;
    hand.joints.push_back(joint);
  }
  const HandGrasp wsg = MapToHand(MakeTabulatedGrasp("wsg_50"), hand);
  ASSERT_TRUE(wsg.table);
  EXPECT_EQ(wsg.table->shares, Eigen::VectorXd(Eigen::Vector2d(1.0, -1.0)));
  EXPECT_EQ(wsg.table->down_H, Eigen::Vector3d::UnitZ());
  EXPECT_EQ(wsg.table->counts, (std::vector<bool>{false, true, true})) << "a point is a _ there";
  EXPECT_EQ(wsg.table->num_touching, 2);
  hand.links[1].name = "other";
  EXPECT_EQ(MapToHand(MakeTabulatedGrasp("wsg_50"), hand).table->counts,
            (std::vector<bool>{true, true, true}));
  EXPECT_EQ(MapToHand(MakeTabulatedGrasp("fetch_gripper"), hand).table->down_H,
            Eigen::Vector3d::UnitX());
  EXPECT_FALSE(MapToHand(MakeTabulatedGrasp("jaco_robot"), hand).table) << "three joints there";
  EXPECT_FALSE(MapToHand(MakeTabulatedGrasp("my_gripper"), hand).table);
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
