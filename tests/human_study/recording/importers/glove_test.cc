#include "human_study/recording/importers/glove.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/hand/load_hand.h"

namespace graspbench {
namespace {

GloveMapping MakeMapping() {
  GloveMapping mapping;
  mapping.hand = "shadow";
  mapping.joints = {{"FFJ3", "index_mcp"}, {"FFJ4", "index_abduction"}};
  mapping.base = {"x", "y", "z"};
  mapping.quaternion = {"qx", "qy", "qz", "qw"};
  return mapping;
}

/** Place of a digit's tip. */
Eigen::Vector3d FindTip(const GloveModel& model, const std::vector<Eigen::Vector3d>& points,
                        const std::string& label) {
  for (size_t i = 0; i < points.size(); ++i) {
    if (model.labels()[i] == label) return points[i];
  }
  ADD_FAILURE() << "no " << label;
  return {};
}

TEST(Glove, AJointTurnsItsTipAboutItsAxis) {
  const GloveModel model(MakeMapping());
  const Hand hand = LoadHand("shadow");
  const auto calc = [&](double angle) {
    return model.CalcPoints({angle, 0.0, 0, 0, 0, 0, 0, 0, 1}, 1.0);
  };
  const Eigen::Vector3d straight = FindTip(model, calc(0.0), "index_tip");
  const Eigen::Vector3d bent = FindTip(model, calc(90.0), "index_tip");
  // A quarter turn about the knuckle: chord = sqrt(2) times the distance from the axis.
  const int link = hand.joints[static_cast<size_t>(hand.FindJoint("FFJ3"))].link;
  const Pose X_HL = CalcLinkPose(hand, Eigen::VectorXd::Zero(hand.num_joints()), link);
  const Eigen::Vector3d axis = X_HL.linear() * hand.links[static_cast<size_t>(link)].axis;
  const Eigen::Vector3d arm = straight - X_HL.translation();
  const double radius = (arm - axis * axis.dot(arm)).norm();
  EXPECT_NEAR((bent - straight).norm(), std::sqrt(2.0) * radius, 1e-9);
  EXPECT_GT(radius, 0.05);
  // No other digit moves.
  EXPECT_NEAR(
      (FindTip(model, calc(90.0), "middle_tip") - FindTip(model, calc(0.0), "middle_tip")).norm(),
      0.0, 1e-12);
}

TEST(Glove, TheTrackersPoseCarriesTheHand) {
  const GloveModel model(MakeMapping());
  const auto at_home = model.CalcPoints({20, 5, 0, 0, 0, 0, 0, 0, 1}, 1.0);
  const double half = std::sqrt(0.5);  // a quarter turn about z; lengths in millimetres
  const auto moved = model.CalcPoints({20, 5, 100, 200, 300, 0, 0, half, half}, 0.001);
  ASSERT_EQ(at_home.size(), moved.size());
  for (size_t i = 0; i < moved.size(); ++i) {
    const Eigen::Vector3d& p = at_home[i];
    const Eigen::Vector3d expected(100 - 1000 * p.y(), 200 + 1000 * p.x(), 300 + 1000 * p.z());
    EXPECT_NEAR((moved[i] - expected).norm(), 0.0, 1e-9);
  }
  EXPECT_EQ(model.labels().back(), "wrist");
}

TEST(Glove, MissingAnglesAndNoQuaternionAreMissingPoints) {
  const GloveModel model(MakeMapping());
  EXPECT_TRUE(model.CalcPoints({NAN, 0, 0, 0, 0, 0, 0, 0, 1}, 1.0).empty());
  EXPECT_TRUE(model.CalcPoints({0, 0, 0, 0, 0, 0, 0, 0, 0}, 1.0).empty());
}

TEST(Glove, AJointThatTheModelLacksIsNamed) {
  GloveMapping mapping = MakeMapping();
  mapping.joints[0].first = "FFJ9";
  try {
    const GloveModel model(mapping);
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("has no joint \"FFJ9\""), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace graspbench
