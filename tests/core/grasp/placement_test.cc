#include "core/grasp/placement.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/base/units.h"
#include "core/hand/load_hand.h"
#include "core/shape/primitives.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

// Straight fingers of the TUM Hand: bases 80 mm apart, pads 7 mm inside of each.
TEST(PreGraspWidthTest, IsThatOfThePadsAcrossTheApproach) {
  const Hand hand = LoadHand("tum");
  Grasp grasp = LoadStandardGrasps(hand).front();
  grasp.q_pre.setZero();
  grasp.tilt = 0.0;
  EXPECT_NEAR(CalcPreGraspWidth(hand, grasp), 0.08 - 2.0 * 0.007, 1e-9);
  grasp.tilt = RadFromDeg(60.0);  // what lies along the approach is not seen
  const Vector3d apart(0.066, 0.0, 0.0);
  const double along = apart.dot(CalcApproachDirection(hand, grasp.tilt));
  EXPECT_NEAR(CalcPreGraspWidth(hand, grasp), std::sqrt(0.066 * 0.066 - along * along), 1e-9);
}

struct Case {
  const char* hand;
  const char* grasp;
};

class PlacementTest : public testing::TestWithParam<Case> {
 protected:
  void SetUp() override {
    hand_ = LoadHand(GetParam().hand);
    const auto grasps = LoadStandardGrasps(hand_);
    const auto found = std::find_if(grasps.begin(), grasps.end(), [](const Grasp& grasp) {
      return grasp.id == GetParam().grasp;
    });
    ASSERT_NE(found, grasps.end());
    grasp_ = *found;
  }

  Vector3d CalcPad(const Placement& placement, double s, bool of_thumb) const {
    const std::vector<Pose> X_HL = CalcLinkPoses(hand_, CalcClosingPosture(hand_, grasp_, s));
    Vector3d sum = Vector3d::Zero();
    int count = 0;
    for (const Digit& digit : hand_.digits) {
      if (digit.is_thumb != of_thumb) continue;
      if (!std::count(grasp_.digits.begin(), grasp_.digits.end(), digit.id)) continue;
      sum += placement.X_WH * (X_HL[digit.distal_link] * digit.p_LPad);
      ++count;
    }
    return sum / count;
  }

  double CalcLowest(const Placement& placement, double s) const {
    const std::vector<Pose> X_HL = CalcLinkPoses(hand_, CalcClosingPosture(hand_, grasp_, s));
    double lowest = 1.0;
    for (const ContactSphere& sphere : hand_.contact_spheres) {
      lowest = std::min(lowest,
                        (placement.X_WH * (X_HL[sphere.link] * sphere.p_LS)).z() - sphere.radius);
    }
    return lowest;
  }

  Hand hand_;
  Grasp grasp_;
};

// A thing of middle size, 40 mm wide and 30 mm high.
const Vector3d kPlacedSize(0.08, 0.04, 0.03);

TEST_P(PlacementTest, PadsStandAsFarApartAsTheObjectIsWideAndOverItsCentreOfMass) {
  const Vector3d p_OOcm(0.01, 0.0, 0.0);
  const Placement placement = CalcPlacement(hand_, grasp_, kPlacedSize, p_OOcm);
  const double s = placement.closing_at_contact;
  ASSERT_GT(s, 0.0);
  ASSERT_LT(s, 1.0);
  const Vector3d thumb = CalcPad(placement, s, true), fingers = CalcPad(placement, s, false);
  const Eigen::Vector2d opening = (fingers - thumb).head<2>();
  EXPECT_NEAR(opening.norm(), kPlacedSize.y(), 0.002);  // the search moves in steps of 1/200
  EXPECT_LT((0.5 * (thumb + fingers) - p_OOcm).head<2>().norm(), 1e-9);
  // alpha between the object's long axis and the line from thumb to fingers.
  EXPECT_NEAR(std::atan2(opening.y(), opening.x()), grasp_.alpha, 1e-9);
}

TEST_P(PlacementTest, NoFingerTouchesTheTableBeforeTheObject) {
  for (double height : {0.01, 0.02, 0.06}) {
    const Vector3d size(0.08, 0.04, height);
    const Placement placement = CalcPlacement(hand_, grasp_, size, Vector3d::Zero());
    for (double share : {0.0, 0.3, 0.6, 1.0}) {
      EXPECT_GT(CalcLowest(placement, share * placement.closing_at_contact), 0.0004);
    }
  }
}

// Fingertips may slide on the table before, but not press on it when they meet.
TEST_P(PlacementTest, AThinThingIsPickedOffTheTable) {
  const Placement placement =
      CalcPlacement(hand_, grasp_, Vector3d(0.175, 0.0076, 0.0069), Vector3d::Zero());
  EXPECT_GT(CalcLowest(placement, placement.closing_at_contact), 0.0004);
}

TEST_P(PlacementTest, ComesStraightDownOnWhatIsLow) {
  const Placement placement = CalcPlacement(hand_, grasp_, kPlacedSize, Vector3d::Zero());
  EXPECT_LT((placement.approach_W + Vector3d::UnitZ()).norm(), 1e-12);
  const Eigen::Matrix3d R = placement.X_WH.linear();
  EXPECT_LT((R * R.transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-12);
  EXPECT_NEAR(R.determinant(), 1.0, 1e-12);
  const double tilt =
      std::acos(std::clamp((R * hand_.palm_normal).dot(placement.approach_W), -1.0, 1.0));
  EXPECT_NEAR(tilt, std::abs(grasp_.tilt), 1e-9);
}

GraspObject MakeCylinder(double radius, double height) {
  const double z = 0.5 * height;
  GraspObject object;
  object.mesh = MakeRevolution({{0.0, -z}, {radius, -z}, {radius, z}, {0.0, z}}, 48);
  object.size = Vector3d(2.0 * radius, 2.0 * radius, height);
  object.field = std::make_shared<SignedDistanceField>(SignedDistanceField::Build(object.mesh));
  return object;
}

/** Distance of a sphere from an upright cylinder that stands on the table; negative inside. */
double CalcGap(const Vector3d& p_W, double sphere, double radius, double height) {
  const double out = p_W.head<2>().norm() - radius;
  const double beyond = std::abs(p_W.z() - 0.5 * height) - 0.5 * height;
  const double gap = std::max(out, beyond) < 0.0
                         ? std::max(out, beyond)
                         : std::hypot(std::max(out, 0.0), std::max(beyond, 0.0));
  return gap - sphere;
}

// However tall the object, the palm stays 3 mm off it and all links outside, from afar to the end;
// a grasp whose pads then hold nothing says so.
TEST_P(PlacementTest, TheHandStaysOutOfATallThing) {
  constexpr double kRadius = 0.025;
  for (double height : {0.06, 0.12, 0.16, 0.2, 0.25}) {
    const Placement placement = CalcPlacement(hand_, grasp_, MakeCylinder(kRadius, height));
    const std::vector<Pose> X_HL = CalcLinkPoses(hand_, CalcClosingPosture(hand_, grasp_, 0.0));
    for (double back : {0.0, 0.01, 0.03, 0.1}) {
      const Pose X_WH = MakePose(Vector3d(-back * placement.approach_W)) * placement.X_WH;
      for (const ContactSphere& sphere : hand_.contact_spheres) {
        const bool is_tip =
            std::any_of(hand_.digits.begin(), hand_.digits.end(),
                        [&](const Digit& digit) { return digit.distal_link == sphere.link; });
        if (is_tip && back > 0.0) continue;
        const bool keeps_off = sphere.link == hand_.palm_link && !grasp_.palm_may_touch;
        EXPECT_GT(CalcGap(X_WH * (X_HL[sphere.link] * sphere.p_LS), sphere.radius, kRadius, height),
                  keeps_off ? 0.0029 : -1e-4)
            << hand_.links[sphere.link].name << ", " << height << " m tall, " << back;
      }
    }
    const Placement freely =
        CalcPlacement(hand_, grasp_, Vector3d(2 * kRadius, 2 * kRadius, height), Vector3d::Zero());
    const double s = placement.closing_at_contact;
    const Vector3d grip = 0.5 * (CalcPad(placement, s, true) + CalcPad(placement, s, false));
    if (!grasp_.palm_may_touch && !placement.X_WH.isApprox(freely.X_WH)) {
      EXPECT_EQ(placement.reaches_object, grip.z() <= height - 0.003) << height;
    } else {
      EXPECT_TRUE(placement.reaches_object);
    }
  }
}

GraspObject MakeBlock(const Vector3d& size) {
  GraspObject object;
  object.mesh = MakeRoundedBox(size, 1e-6);
  object.size = size;
  object.field = std::make_shared<SignedDistanceField>(SignedDistanceField::Build(object.mesh));
  return object;
}

// What fills its bounding box is reached when the box is; what lies within it is reached, too.
TEST_P(PlacementTest, ABoundingBoxIsReachedWhenABlockOfItsSizeIs) {
  for (double height : {0.06, 0.12, 0.25}) {
    const GraspObject block = MakeBlock({0.05, 0.05, height});
    const bool is_reached = CalcBoxPlacement(hand_, grasp_, block).reaches_object;
    EXPECT_EQ(is_reached, CalcPlacement(hand_, grasp_, block).reaches_object) << height;
    if (!is_reached) continue;
    EXPECT_TRUE(CalcPlacement(hand_, grasp_, MakeCylinder(0.025, height)).reaches_object);
  }
}

// However it is moved, the hand stays off the table on its course, and open out of the object.
TEST_P(PlacementTest, AMovedHandKeepsTheRules) {
  constexpr double kRadius = 0.025, kHeight = 0.06, kShift = 0.0175, kTurn = 0.4;
  const GraspObject object = MakeCylinder(kRadius, kHeight);
  Grasp grasp = grasp_;
  grasp.placement = CalcPlacement(hand_, grasp_, object);
  const Vector3d zero = Vector3d::Zero();
  EXPECT_EQ(MovePlacement(hand_, grasp, object, zero, zero).X_WH.matrix(),
            grasp.placement->X_WH.matrix());
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {-1.0, 1.0}) {
      for (const bool is_turn : {false, true}) {
        const Vector3d by = sign * Vector3d::Unit(axis);
        const Placement placement =
            MovePlacement(hand_, grasp, object, is_turn ? zero : Vector3d(kShift * by),
                          is_turn ? Vector3d(kTurn * by) : zero);
        EXPECT_EQ(placement.approach_W, grasp.placement->approach_W);
        for (const double s : {0.0, 0.5, 1.0}) {
          const std::vector<Pose> X_HL = CalcLinkPoses(
              hand_, CalcClosingPosture(hand_, grasp, s * placement.closing_at_contact));
          for (const ContactSphere& sphere : hand_.contact_spheres) {
            const Vector3d p_WS = placement.X_WH * (X_HL[sphere.link] * sphere.p_LS);
            EXPECT_GE(p_WS.z() - sphere.radius, kTableClearance - 1e-9) << by.transpose();
            if (s > 0.0) continue;
            const bool keeps_off = sphere.link == hand_.palm_link && !grasp.palm_may_touch;
            EXPECT_GT(CalcGap(p_WS, sphere.radius, kRadius, kHeight), keeps_off ? 0.0029 : -1e-4)
                << by.transpose();
          }
        }
      }
    }
  }
}

TEST_P(PlacementTest, AShiftedCentreOfMassShiftsTheHand) {
  const Placement a = CalcPlacement(hand_, grasp_, kPlacedSize, Vector3d::Zero());
  const Placement b = CalcPlacement(hand_, grasp_, kPlacedSize, Vector3d(0.02, -0.01, 0.0));
  EXPECT_LT((b.X_WH.translation() - a.X_WH.translation() - Vector3d(0.02, -0.01, 0.0)).norm(),
            1e-12);
  EXPECT_LT((b.X_WH.linear() - a.X_WH.linear()).norm(), 1e-15);
}

INSTANTIATE_TEST_SUITE_P(Grasps, PlacementTest,
                         testing::Values(Case{"tum", "g1"}, Case{"tum", "g2"}, Case{"tum", "g6"},
                                         Case{"shadow", "g1"}, Case{"shadow", "g2"},
                                         Case{"shadow", "g6"}),
                         [](const auto& instance) {
                           return std::string(instance.param.hand) + "_" + instance.param.grasp;
                         });

TEST(Placement, APowerGraspOfATallThingComesFromTheSide) {
  const Hand hand = LoadHand("tum-evolved");
  for (const Grasp& grasp : LoadStandardGrasps(hand)) {
    const Placement placement =
        CalcPlacement(hand, grasp, Vector3d(0.066, 0.066, 0.1156), Vector3d::Zero());
    if (grasp.type == GraspType::kPower) {
      EXPECT_NEAR(placement.approach_W.z(), 0.0, 1e-12);
      // The palm ends 3 mm before the can's wall.
      double nearest = -1.0;
      const auto X_HL = CalcLinkPoses(hand, grasp.q_pre);
      for (const ContactSphere& sphere : hand.contact_spheres) {
        if (sphere.link != hand.palm_link) continue;
        nearest = std::max(
            nearest, placement.approach_W.dot(placement.X_WH * (X_HL[sphere.link] * sphere.p_LS)) +
                         sphere.radius);
      }
      EXPECT_NEAR(nearest, -0.033 - 0.003, 1e-9);
    } else {
      EXPECT_NEAR(placement.approach_W.z(), -1.0, 1e-12);
    }
  }
}

Grasp LoadGrasp(const Hand& hand, const std::string& id) {
  for (const Grasp& grasp : LoadStandardGrasps(hand)) {
    if (grasp.id == id) return grasp;
  }
  return {};
}

TEST(Placement, TheSideIsChosenOrExcludedForAnyGraspAndHeight) {
  for (const char* id : {"tum", "shadow"}) {
    const Hand hand = LoadHand(id);
    for (const char* grasp_id : {"g1", "g3"}) {
      Grasp grasp = LoadGrasp(hand, grasp_id);
      for (const double height : {0.04, 0.3}) {
        const Vector3d size(0.05, 0.05, height);
        grasp.approach = Approach::kSide;
        const Placement side = CalcPlacement(hand, grasp, size, Vector3d::Zero());
        EXPECT_NEAR(side.approach_W.z(), 0.0, 1e-12) << id << grasp_id << height;
        // The palm faces the object.
        EXPECT_GT((side.X_WH.linear() * hand.palm_normal).dot(side.approach_W), 0.99);
        grasp.approach = Approach::kAbove;
        const Placement above = CalcPlacement(hand, grasp, size, Vector3d::Zero());
        EXPECT_NEAR(above.approach_W.z(), -1.0, 1e-12) << id << grasp_id << height;
      }
    }
  }
}

TEST(Placement, TheObjectsWordComesBeforeTheGrasps) {
  const Hand hand = LoadHand("tum");
  Grasp grasp = LoadGrasp(hand, "g6");
  GraspObject object = MakeCylinder(0.03, 0.06);
  const auto calc_z = [&] { return CalcPlacement(hand, grasp, object).approach_W.z(); };
  EXPECT_NEAR(calc_z(), -1.0, 1e-12);
  grasp.approach = Approach::kSide;
  EXPECT_NEAR(calc_z(), 0.0, 1e-12);
  object.approach = Approach::kAbove;
  EXPECT_NEAR(calc_z(), -1.0, 1e-12);
}

// From above fingers reach deeper than most things are tall.
TEST(Placement, APalmThatIsSoughtComesFromTheSideWhateverTheHeight) {
  const Hand hand = LoadHand("tum");
  Grasp grasp = LoadGrasp(hand, "g3");
  grasp.seeks_palm = true;
  for (const double height : {0.06, 0.3}) {
    const Vector3d size(0.06, 0.06, height);
    EXPECT_NEAR(CalcPlacement(hand, grasp, size, Vector3d::Zero()).approach_W.y(), 1.0, 1e-12);
  }
}

TEST(Placement, APowerGraspSaysHowNearThePalmComes) {
  const Hand hand = LoadHand("shadow");
  Grasp grasp = LoadGrasp(hand, "g3");
  grasp.palm_gap = kPalmGap;
  const Vector3d size(0.06, 0.06, 0.09);
  const Placement usual = CalcPlacement(hand, grasp, size, Vector3d::Zero());
  grasp.palm_gap = 0.001;
  const Placement near = CalcPlacement(hand, grasp, size, Vector3d::Zero());
  const Vector3d nearer = (kPalmGap - 0.001) * usual.approach_W;
  EXPECT_NEAR((near.X_WH.translation() - usual.X_WH.translation() - nearer).norm(), 0.0, 1e-12);
}

}  // namespace
}  // namespace graspbench
