#include "core/grasp/predict_grasp.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/base/random.h"
#include "core/grasp/placement.h"
#include "core/hand/load_hand.h"
#include "core/shape/primitives.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

constexpr double kCell = 0.0008;  // of the distance fields here, about [m]

GraspObject MakeObject(TriMesh mesh) {
  GraspObject object;
  object.mesh = std::move(mesh);
  Eigen::AlignedBox3d box;
  for (const Vector3d& p : object.mesh.vertices) box.extend(p);
  object.size = box.sizes();
  object.mass_properties = CalcSolidMassProperties(object.mesh, 0.1);
  object.surface.friction_static = object.surface.friction_dynamic = 0.4;
  object.field =
      std::make_shared<const SignedDistanceField>(SignedDistanceField::Build(object.mesh));
  return object;
}

GraspObject MakeStandingCylinder(double radius, double height) {
  const double z = 0.5 * height;
  return MakeObject(MakeRevolution({{0.0, -z}, {radius, -z}, {radius, z}, {0.0, z}}, 96));
}

double CalcCylinderDistance(double radius, double height, const Vector3d& p) {
  const Eigen::Vector2d beyond(p.head<2>().norm() - radius, std::abs(p.z()) - 0.5 * height);
  return beyond.cwiseMax(0.0).norm() + std::min(0.0, beyond.maxCoeff());
}

class PredictGraspTest : public testing::Test {
 protected:
  Grasp Get(const std::string& id) const {
    for (const Grasp& grasp : LoadStandardGrasps(hand_)) {
      if (grasp.id == id) return grasp;
    }
    throw Error(ErrorKind::kNotFound, id);
  }
  const Hand hand_ = LoadHand("tum-evolved");
};

// Brute force: no object anywhere in the box of placement errors comes nearer to a digit on its way,
// by the closed form of a cylinder's distance, and some come nearly as near.
TEST_F(PredictGraspTest, TheRoomIsTheLeastOfManyDrawnPlaces) {
  constexpr double kRadius = 0.036, kHeight = 0.06;
  const GraspObject cylinder = MakeStandingCylinder(kRadius, kHeight);
  const Grasp grasp = Get("g1");
  const double room = PredictGrasp(hand_, grasp, cylinder).room;
  const Placement placement = CalcPlacement(hand_, grasp, cylinder);
  const std::vector<Pose> X_HL = CalcLinkPoses(hand_, CalcClosingPosture(hand_, grasp, 0.0));
  RandomStream stream("room", "draws");
  double least = 1.0;
  for (int draw = 0; draw < 200; ++draw) {
    // Every other one in a corner, where it is nearest.
    const auto draw_offset = [&] {
      const double offset = stream.NextUniform(-kPlacementOffset, kPlacementOffset);
      return draw % 2 == 0 ? offset : std::copysign(kPlacementOffset, offset);
    };
    const Vector3d p_WO(draw_offset(), draw_offset(), 0.5 * kHeight);
    for (double back = 0.0; back < 0.1; back += 0.002) {
      for (const ContactSphere& sphere : hand_.contact_spheres) {
        if (hand_.FindDigitOfLink(sphere.link) < 0) continue;
        const Vector3d p_WS =
            placement.X_WH * (X_HL[static_cast<size_t>(sphere.link)] * sphere.p_LS) -
            back * placement.approach_W;
        least =
            std::min(least, CalcCylinderDistance(kRadius, kHeight, p_WS - p_WO) - sphere.radius);
      }
    }
  }
  EXPECT_GT(least, room - kCell);
  EXPECT_LT(least, room + 0.0015);
}

// A finger's accuracy times its length from base to tip: 2 degrees.
TEST_F(PredictGraspTest, JointErrorsNeedRoom) {
  const GraspPrediction prediction =
      PredictGrasp(hand_, Get("g1"), MakeStandingCylinder(0.02, 0.06));
  EXPECT_NEAR(prediction.needed_room, RadFromDeg(2.0) * 0.1, RadFromDeg(2.0) * 0.03);
  EXPECT_TRUE(prediction.is_clear());
}

TEST_F(PredictGraspTest, DigitsMeetWhatTheyCloseOn) {
  const GraspPrediction can = PredictGrasp(hand_, Get("g1"), MakeStandingCylinder(0.02, 0.06));
  EXPECT_TRUE(can.reaches());
  EXPECT_EQ(can.num_touching, 3);
  EXPECT_TRUE(can.holds());
  // Nothing closes down to a needle's width with a target whose pads stay apart.
  Grasp open = Get("g1");
  open.q_target = open.q_pre;
  const GraspPrediction none = PredictGrasp(hand_, open, MakeStandingCylinder(0.005, 0.06));
  EXPECT_EQ(none.num_touching, 0);
  EXPECT_FALSE(none.holds());
}

// The pads of a grasp from above meet an upright cylinder at the grasp height (placement.h), some
// millimetres of a fingertip's radius aside; the centre of mass does not move them.
TEST_F(PredictGraspTest, HeightOfContactsIsAboveTheCentreOfMass) {
  GraspObject cylinder = MakeStandingCylinder(0.02, 0.06);
  const double middle = PredictGrasp(hand_, Get("g1"), cylinder).contact_height;
  EXPECT_NEAR(middle, 0.0, 0.008);
  cylinder.mass_properties.p_OOcm.z() = -0.02;
  EXPECT_NEAR(PredictGrasp(hand_, Get("g1"), cylinder).contact_height, middle + 0.02, 1e-12);
}

// What is half closed is opened again, on its own line and no farther than needed; what is clear
// stays as it is.
TEST_F(PredictGraspTest, ThePreGraspOpensUntilItIsClear) {
  const GraspObject cylinder = MakeStandingCylinder(0.02, 0.06);
  const Grasp standard = Get("g1");
  EXPECT_EQ(FitGrasp(hand_, standard, cylinder).q_pre, standard.q_pre);
  Grasp closed = standard;
  closed.q_pre = 0.5 * (standard.q_pre + standard.q_target);
  EXPECT_FALSE(PredictGrasp(hand_, closed, cylinder).is_clear());
  closed.approach = Approach::kAbove;
  const Grasp fitted = FitGrasp(hand_, closed, cylinder);
  EXPECT_TRUE(PredictGrasp(hand_, fitted, cylinder).is_clear());
  EXPECT_EQ(fitted.q_target, closed.q_target);
  const Eigen::VectorXd way = closed.q_pre - closed.q_target;
  const double share = (fitted.q_pre - closed.q_pre).dot(way) / way.squaredNorm();
  EXPECT_GT(share, 0.0);
  EXPECT_LE(share, 1.0);
  EXPECT_TRUE(fitted.q_pre.isApprox(closed.q_pre + share * way, 0.05));
}

// A plate as wide as a table is reached from nowhere, and stays with the grasp as it is.
TEST_F(PredictGraspTest, WhatNothingHelpsStaysAsItIs) {
  const GraspObject plate = MakeObject(MakeRoundedBox(Vector3d(0.3, 0.3, 0.04), 0.0));
  const Grasp standard = Get("g1");
  EXPECT_EQ(FitGrasp(hand_, standard, plate).q_pre, standard.q_pre);
  EXPECT_EQ(FitGrasp(hand_, standard, plate).approach, standard.approach);
  EXPECT_FALSE(PredictGrasp(hand_, standard, plate).reaches());
}

// A post too thick for the open hand from above: what is longer along y than the hand is wide is
// taken from the side, where it is narrow; who says "above" gets above.
TEST_F(PredictGraspTest, TheSideIsTriedWhereNobodySaysFromWhere) {
  const GraspObject post = MakeObject(MakeRoundedBox(Vector3d(0.03, 0.11, 0.06), 0.0));
  Grasp above = Get("g1");
  above.approach = Approach::kAbove;
  EXPECT_EQ(FitGrasp(hand_, above, post).approach, Approach::kAbove);
  const Grasp fitted = FitGrasp(hand_, Get("g1"), post);
  const GraspPrediction as_is = PredictGrasp(hand_, Get("g1"), post);
  EXPECT_FALSE(as_is.reaches() && as_is.is_clear());
  EXPECT_EQ(fitted.approach, Approach::kSide);
  EXPECT_TRUE(PredictGrasp(hand_, fitted, post).is_clear());
}

// Fingers of 101 mm that reach down beside a drum of 85 mm keep the palm off its top; from the side
// the palm comes to it, and the fingers close behind its middle.
TEST_F(PredictGraspTest, APowerGraspComesFromWhereThePalmBears) {
  const GraspObject drum = MakeStandingCylinder(0.029, 0.085);
  const Grasp power = Get("g3");
  EXPECT_FALSE(PredictGrasp(hand_, power, drum).palm_is_near);
  const Grasp fitted = FitGrasp(hand_, power, drum);
  EXPECT_EQ(fitted.approach, Approach::kSide);
  EXPECT_TRUE(PredictGrasp(hand_, fitted, drum).palm_is_near);
  Grasp without_palm = power;
  without_palm.palm_may_touch = false;
  EXPECT_EQ(FitGrasp(hand_, without_palm, drum).approach, Approach::kAutomatic);
  Grasp above = power;
  above.approach = Approach::kAbove;
  EXPECT_EQ(FitGrasp(hand_, above, drum).approach, Approach::kAbove) << "who says above gets it";
}

// A block across the hand, lower than the digits when they come from the side: clear of it there,
// they close above it, and every trial ends without a contact. From above they hold it.
TEST_F(PredictGraspTest, TheOtherWayIsNotTakenPastTheObject) {
  const GraspObject block = MakeObject(MakeRoundedBox({0.04, 0.09, 0.025}, 1e-5));
  const Hand hand = LoadHand("tum");
  const Grasp power = LoadStandardGrasps(hand).at(5);
  ASSERT_EQ(power.id, "g6");
  Grasp side = power;
  side.approach = Approach::kSide;
  const GraspPrediction past = PredictGrasp(hand, side, block);
  ASSERT_TRUE(past.reaches() && past.is_clear());
  ASSERT_FALSE(past.meets());
  const Grasp fitted = FitGrasp(hand, power, block);
  EXPECT_NE(fitted.approach, Approach::kSide);
  EXPECT_TRUE(PredictGrasp(hand, fitted, block).meets());
}

}  // namespace
}  // namespace graspbench
