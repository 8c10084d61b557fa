#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "core/base/files/files.h"
#include "core/base/units.h"
#include "core/hand/import/guess_hand.h"
#include "core/hand/load_hand.h"
#include "tests/core/hand/import/small_gripper.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

/** Of a hand whose thumb stands on the +x side of its palm, opposite to three fingers along z. */
Vector3d ImportNormal(const std::string& file, const std::optional<Vector3d>& given,
                      Diagnostics& problems) {
  HandSource source = MakeSourceWithoutMeshes();
  source.palm_normal = given;
  const std::filesystem::path path = std::filesystem::path(IMPORT_TEST_DATA_DIR) / file;
  const ImportedFiles imported = ImportHand(ReadFile(path), source, "", problems);
  EXPECT_EQ(problems.num_errors(), 0) << problems.Format();
  Diagnostics of_loading;
  return ParseHand(imported.files.at("hand.urdf"), imported.files.at("hand.yaml"), "x", of_loading)
      .palm_normal;
}

bool Tells(const Diagnostics& problems, const std::string& text) {
  return problems.Format().find(text) != std::string::npos;
}

TEST(GuessPalmTest, AMirroredFingerDoesNotTurnTheNormal) {
  Diagnostics problems;
  EXPECT_EQ(ImportNormal("wrong/ring_mirrored.urdf", {}, problems), Vector3d::UnitX());
}

TEST(GuessPalmTest, AGivenNormalIsTakenAndHeldAgainstTheGuess) {
  Diagnostics behind, aside, near;
  EXPECT_EQ(ImportNormal("right/opposed_three.urdf", -Vector3d::UnitX(), behind),
            -Vector3d::UnitX());
  EXPECT_TRUE(Tells(behind, "--palm-normal is 180 degrees from where the digits of \"palm\" meet"))
      << behind.Format();
  EXPECT_EQ(ImportNormal("right/opposed_three.urdf", Vector3d::UnitY(), aside), Vector3d::UnitY());
  EXPECT_TRUE(Tells(aside, "--palm-normal is 90 degrees from")) << aside.Format();
  ImportNormal("right/opposed_three.urdf", Vector3d(1, 0.5, 0.5), near);
  EXPECT_FALSE(Tells(near, "--palm-normal")) << near.Format();
}

/** Two fingers of one link, 60 mm long along z, 40 mm to either side along x, that bend towards each
other up to `upper`; `sign` -1: away from each other. */
Hand MakePinch(double sign, double upper) {
  Hand hand;
  hand.links.resize(1);
  for (int i = 0; i < 2; ++i) {
    const double side = i == 0 ? 1.0 : -1.0;
    HandLink link;
    link.parent = 0;
    link.joint = i;
    link.X_PJ = MakePose(Vector3d(0.04 * side, 0, 0.02));
    link.axis = -sign * side * Vector3d::UnitY();
    HandJoint joint;
    joint.link = i + 1;
    joint.upper = upper;
    Digit digit;
    digit.is_thumb = i == 1;
    digit.links = {i + 1};
    digit.distal_link = i + 1;
    digit.p_LTip = {0, 0, 0.06};
    digit.p_LPad = {0, 0, 0.06};
    hand.links.push_back(link);
    hand.joints.push_back(joint);
    hand.digits.push_back(digit);
  }
  return hand;
}

// The pads meet where sin(q) = 40 / 60, at a height of 20 + sqrt(60^2 - 40^2) mm.
TEST(FindMeetingTest, OfAPinch) {
  const auto meeting = FindMeeting(MakePinch(1.0, kPi / 2), {false, false});
  ASSERT_TRUE(meeting.has_value());
  EXPECT_LT(meeting->gap, 0.006);
  EXPECT_NEAR(meeting->p_H.z(), 0.02 + std::sqrt(0.06 * 0.06 - 0.04 * 0.04), 0.003);
  EXPECT_GT(meeting->direction.z(), 0.999);
}

// Turned on by 1.8 rad each the pads meet again, 45 mm below.
TEST(FindMeetingTest, OfTwoMeetingsTheFirst) {
  const Hand hand = MakePinch(1.0, kPi);
  const auto first = FindMeeting(hand, {false, false}, true);
  ASSERT_TRUE(first.has_value());
  EXPECT_NEAR(first->p_H.z(), 0.02 + std::sqrt(0.06 * 0.06 - 0.04 * 0.04), 0.006);
}

TEST(FindMeetingTest, DigitsThatCannotReachHalfWayDoNotMeet) {
  EXPECT_FALSE(FindMeeting(MakePinch(1.0, 0.3), {false, false})
                   .has_value());  // 80 to 2 (40 - 60 sin 0.3) = 45 mm
  EXPECT_TRUE(FindMeeting(MakePinch(1.0, 0.36), {false, false}).has_value());  // 38 mm
}

TEST(FindMeetingTest, ADigitThatIsLeftOutMeetsNobody) {
  EXPECT_FALSE(FindMeeting(MakePinch(1.0, kPi / 2), {true, false}).has_value());
}

}  // namespace
}  // namespace graspbench
