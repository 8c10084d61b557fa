#include "core/transfer/transfer_grasp.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/base/units.h"
#include "core/grasp/predict_grasp.h"
#include "core/hand/load_hand.h"
#include "core/transfer/play_person.h"
#include "tests/core/rehearse/made_objects.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

/** The pad of a finger of the TUM Hand that bends in the plane of x and z, by hand from the lengths
in its hand.urdf: links of 51 and 30 mm, the pad 12 mm out and 7 mm in front of the last one, whose
joint turns as the middle one does. */
struct PlanarPad {
  Vector3d p_H, nhat_H;
};
PlanarPad CalcPlanarPad(const Vector3d& p_HBase, double side, double q2, double q3) {
  const auto along = [side](double angle) {
    return Vector3d(side * std::sin(angle), 0.0, std::cos(angle));
  };
  const double last = q2 + 2.0 * q3;
  const Vector3d out(side * std::cos(last), 0.0, -std::sin(last));
  return {p_HBase + 0.051 * along(q2) + 0.030 * along(q2 + q3) + 0.012 * along(last) + 0.007 * out,
          out};
}

constexpr double kFingerQ2 = RadFromDeg(-10.0), kFingerQ3 = RadFromDeg(12.0);
constexpr double kThumbQ2 = RadFromDeg(3.0), kThumbQ3 = RadFromDeg(4.0);

/** A hand from above that holds a box, and the person whose digits are where its pads are. */
struct Planted {
  GraspObject box;
  PersonGrasp person;
  Pose X_OH;
};
Planted PlantGrasp(double noise) {
  const PlanarPad pads[] = {CalcPlanarPad({0.04, 0.0, 0.0}, -1.0, kThumbQ2, kThumbQ3),
                            CalcPlanarPad({-0.04, -0.02, 0.0}, 1.0, kFingerQ2, kFingerQ3),
                            CalcPlanarPad({-0.04, 0.02, 0.0}, 1.0, kFingerQ2, kFingerQ3)};
  const double width = pads[0].p_H.x() - pads[1].p_H.x();
  const Vector3d p_HMiddle(pads[1].p_H.x() + 0.5 * width, 0.0, pads[1].p_H.z());
  Planted planted;
  planted.box = MakeTurnedBar(Vector3d(width, 0.07, 0.08), 0.0);
  const Eigen::Matrix3d R_OH = MakeRotationRpy(kPi, 0.0, 0.0);
  planted.X_OH = MakePose(R_OH, Vector3d(0.0, 0.0, 0.01) - R_OH * p_HMiddle);
  const char* const names[] = {"TH", "FF", "MF"};
  const Vector3d errors[] = {{0.3, -0.6, 0.4}, {-0.5, 0.2, -0.7}, {0.6, 0.5, -0.1}};
  for (int d = 0; d < 3; ++d) {
    PersonDigit digit;
    digit.digit = names[d];
    digit.p_O = planted.X_OH * pads[d].p_H + noise * errors[d];
    digit.nhat_O = R_OH * pads[d].nhat_H;
    digit.opening_O = -0.012 * digit.nhat_O;
    planted.person.digits.push_back(digit);
  }
  planted.person.p_OPalm = planted.X_OH * Vector3d(0.0, 0.0, 0.0);
  planted.person.approach_O = -Vector3d::UnitZ();
  return planted;
}

Eigen::VectorXd PlantedJoints(const Hand& hand) {
  Eigen::VectorXd q = Eigen::VectorXd::Zero(hand.num_joints());
  for (const char* digit : {"FF", "MF", "TH"}) {
    const bool is_thumb = std::string(digit) == "TH";
    const auto set = [&](const char* joint, double value) {
      q[hand.FindJoint(std::string(digit) + joint)] = value;
    };
    set("q2", is_thumb ? kThumbQ2 : kFingerQ2);
    set("q3", is_thumb ? kThumbQ3 : kFingerQ3);
    set("q4", is_thumb ? kThumbQ3 : kFingerQ3);
  }
  return q;
}

// With directions measured, three pads fix six coordinates of the hand and nine joints.
TEST(TransferGrasp, FindsThePlanarDigitsThatWerePlanted) {
  const Hand hand = LoadHand("tum");
  for (const double noise : {0.0, 0.0005}) {
    const Planted planted = PlantGrasp(noise);
    const TransferredGrasp found =
        TransferGrasp(hand, LoadStandardGrasps(hand), planted.person, planted.box);
    ASSERT_EQ(found.not_transferable, "") << noise;
    ASSERT_EQ(found.pads.size(), 3u);
    for (const PadMiss& pad : found.pads) {
      EXPECT_LT(pad.distance, kPadTolerance) << pad.digit << " " << noise;
      EXPECT_LT(pad.angle, RadFromDeg(8.0)) << pad.digit << " " << noise;
    }
    EXPECT_TRUE(found.undetermined.empty());
    const Eigen::VectorXd truth = PlantedJoints(hand);
    std::vector<double> errors;
    for (Eigen::Index j = 0; j < truth.size(); ++j) {
      errors.push_back(DegFromRad(std::abs(found.q_contact[j] - truth[j])));
    }
    std::sort(errors.begin(), errors.end());
    EXPECT_LT(errors[errors.size() / 2], 3.0) << noise;
  }
}

/** The joints of such a finger, from the base to the last, then its tip, 20 mm from that. */
std::vector<Vector3d> CalcPlanarChain(const Vector3d& p_HBase, double side, double q2, double q3) {
  const auto along = [side](double angle) {
    return Vector3d(side * std::sin(angle), 0.0, std::cos(angle));
  };
  std::vector<Vector3d> chain = {p_HBase, p_HBase + 0.051 * along(q2)};
  chain.push_back(chain.back() + 0.030 * along(q2 + q3));
  chain.push_back(chain.back() + 0.020 * along(q2 + 2.0 * q3));
  return chain;
}

/** The same grasp, known by the landmarks of joints and tips alone. */
PersonGrasp PlantLandmarks(const Planted& planted, double noise) {
  const std::vector<Vector3d> chains[] = {
      CalcPlanarChain({0.04, 0.0, 0.0}, -1.0, kThumbQ2, kThumbQ3),
      CalcPlanarChain({-0.04, -0.02, 0.0}, 1.0, kFingerQ2, kFingerQ3),
      CalcPlanarChain({-0.04, 0.02, 0.0}, 1.0, kFingerQ2, kFingerQ3)};
  PersonGrasp person = planted.person;
  for (size_t d = 0; d < 3; ++d) {
    PersonDigit& digit = person.digits[d];
    digit.nhat_O.setZero();
    for (size_t k = 0; k < chains[d].size(); ++k) {
      const double sign = (d + k) % 2 == 0 ? 1.0 : -1.0;
      const Vector3d place = planted.X_OH * chains[d][k] + sign * noise * Vector3d(0.5, -0.6, 0.6);
      if (k + 1 < chains[d].size()) {
        digit.p_OJoints.push_back(place);
      } else {
        digit.p_O = place;
      }
    }
  }
  return person;
}

// The pad of that finger is 8 mm before its tip, two fifths of 20 mm, and faces in the plane of its
// bends; with bends of 4 deg, noise of 0.1 mm turns that plane, and the surface decides.
TEST(TransferGrasp, LandmarksSayHowADigitLies) {
  const Planted planted = PlantGrasp(0.0);
  const PersonGrasp used = UseLandmarks(PlantLandmarks(planted, 0.0), planted.box);
  for (size_t d = 0; d < 3; ++d) {
    const PersonDigit &found = used.digits[d], &truth = planted.person.digits[d];
    EXPECT_LT((found.p_O - truth.p_O).norm(), 1e-4) << d;  // along that direction on the surface
    EXPECT_LT((found.nhat_O - truth.nhat_O).norm(), 1e-6) << d;
    EXPECT_NEAR(found.axis_O.dot(truth.nhat_O), 0.0, 1e-9) << d;
  }
  PersonGrasp straight = PlantLandmarks(planted, 0.0);
  for (PersonDigit& digit : straight.digits) {
    for (size_t k = 0; k < 3; ++k) {  // on the last phalanx's line
      digit.p_OJoints[k] = digit.p_O - 0.03 * (3.0 - k) * used.digits[0].axis_O;
    }
  }
  for (const PersonDigit& digit : UseLandmarks(straight, planted.box).digits) {
    const bool is_thumb = digit.digit == "TH";
    EXPECT_GT(digit.nhat_O.x() * (is_thumb ? -1.0 : 1.0), 0.95) << digit.digit;
  }
}

TEST(TransferGrasp, FindsPlantedDigitsByLandmarks) {
  const Hand hand = LoadHand("tum");
  const Planted planted = PlantGrasp(0.0);
  const TransferredGrasp found =
      TransferGrasp(hand, LoadStandardGrasps(hand), PlantLandmarks(planted, 0.0005), planted.box);
  ASSERT_EQ(found.not_transferable, "");
  const Eigen::VectorXd truth = PlantedJoints(hand);
  std::vector<double> errors;
  for (Eigen::Index j = 0; j < truth.size(); ++j) {
    errors.push_back(DegFromRad(std::abs(found.q_contact[j] - truth[j])));
  }
  std::sort(errors.begin(), errors.end());
  EXPECT_LT(errors[errors.size() / 2], 3.0);
}

// What starts inside the object or the table is no physics: hands come clear of both.
TEST(TransferGrasp, StartsClearOfTheObjectAndTheTable) {
  const Planted planted = PlantGrasp(0.0);
  for (const char* id : {"tum", "shadow"}) {
    const Hand hand = LoadHand(id);
    PersonGrasp person = planted.person;
    person.p_OPalm.reset();  // so that it may be of either side
    const TransferredGrasp found =
        TransferGrasp(hand, LoadStandardGrasps(hand), person, planted.box);
    ASSERT_EQ(found.not_transferable, "") << id;
    const GraspPrediction prediction = PredictGrasp(hand, found.grasp, planted.box);
    EXPECT_TRUE(prediction.meets()) << id;
    const std::vector<Pose> X_HL = CalcLinkPoses(hand, found.grasp.q_pre);
    for (const ContactSphere& ball : hand.contact_spheres) {
      const Vector3d p_W = found.grasp.placement->X_WH * (X_HL[ball.link] * ball.p_LS);
      const Vector3d p_O = p_W - Vector3d(0.0, 0.0, 0.5 * planted.box.size.z());
      EXPECT_GE(p_W.z(), ball.radius) << id << " " << hand.links[ball.link].name;
      EXPECT_GE(planted.box.field->CalcDistance(p_O), ball.radius)
          << id << " " << hand.links[ball.link].name;
    }
  }
}

// One marker a digit leaves joints open, which go to the standard grasp and are named.
TEST(TransferGrasp, NamesTheJointsThatPlacesAloneLeaveOpen) {
  const Hand hand = LoadHand("shadow");
  PersonGrasp person = PlantGrasp(0.0).person;
  person.p_OPalm.reset();
  for (PersonDigit& digit : person.digits) digit.nhat_O.setZero();
  const TransferredGrasp found =
      TransferGrasp(hand, LoadStandardGrasps(hand), person, PlantGrasp(0.0).box);
  ASSERT_FALSE(found.pads.empty());
  for (const PadMiss& pad : found.pads) EXPECT_TRUE(pad.is_reached()) << pad.digit;
  const auto of_thumb = std::count_if(found.undetermined.begin(), found.undetermined.end(),
                                      [](const std::string& name) { return name[0] == 'T'; });
  EXPECT_GE(of_thumb, 2);  // five joints, three coordinates
}

// The last finger of a hand stands for all that are left: its pad is the projected mean of theirs.
TEST(TransferGrasp, PairsVirtualFingers) {
  const GraspObject box = MakeTurnedBar(Vector3d(0.05, 0.1, 0.08), 0.0);
  PersonGrasp person;
  const double y[] = {0.0, -0.03, -0.01, 0.01, 0.03};
  const char* const names[] = {"TH", "FF", "MF", "RF", "LF"};
  for (int d = 0; d < 5; ++d) {
    person.digits.push_back({names[d], Vector3d(d == 0 ? 0.033 : -0.033, y[d], 0.0),
                             Vector3d(d, 0.0, 0.0), Vector3d::Zero()});
  }
  Hand hand = LoadHand("shadow");
  const char* const expected[] = {"", "FF+MF+RF+LF", "MF+RF+LF", "RF+LF", "LF"};
  for (size_t num_fingers = 1; num_fingers <= 4; ++num_fingers) {
    Hand fewer = hand;  // FF MF RF LF TH
    fewer.digits.erase(fewer.digits.begin() + static_cast<std::ptrdiff_t>(num_fingers),
                       fewer.digits.end() - 1);
    const std::vector<PadGoal> goals = PairDigits(fewer, person, box);
    ASSERT_EQ(goals.size(), num_fingers + 1);
    EXPECT_EQ(goals[0].person, "TH");
    EXPECT_EQ(goals.back().person, expected[num_fingers]);
    for (const PadGoal& goal : goals) EXPECT_NEAR(std::abs(goal.p_O.x()), 0.025, 3e-4);
  }
  const PadGoal last = PairDigits(LoadHand("tum"), person, box).back();
  EXPECT_NEAR(last.p_O.y(), 0.01, 3e-4);        // of -0.01, 0.01, 0.03
  EXPECT_NEAR(last.opening_O.x(), 3.0, 1e-12);  // of 2, 3, 4
  EXPECT_LT((last.nhat_O - Vector3d::UnitX()).norm(), 1e-2);
}

// The opening is what a rigid turn and shift of the whole hand leave.
TEST(TransferGrasp, TheOpeningIsFreeOfTheHandsWay) {
  PersonGrasp person;
  const Vector3d places[] = {{0.03, 0.0, 0.0}, {-0.03, -0.01, 0.0}, {-0.03, 0.01, 0.0}};
  for (const Vector3d& place : places) {
    person.digits.push_back({"FF", place, Vector3d::Zero(), Vector3d::Zero()});
  }
  const Pose moved = MakePose(MakeRotationRpy(0.0, 0.0, 0.7), Vector3d(0.1, -0.2, 0.05));
  std::vector<Vector3d> open;
  for (const Vector3d& place : places) {
    open.push_back(moved * (place + Vector3d(place.x() > 0.0 ? 0.02 : -0.02, 0.0, 0.0)));
  }
  SetOpening(open, person);
  for (size_t d = 0; d < 3; ++d) {
    const Vector3d expected(d == 0 ? 0.02 : -0.02, 0.0, 0.0);
    EXPECT_LT((person.digits[d].opening_O - expected).norm(), 1e-12) << d;
  }
}

/** The planted person comes from above along -z, 10.5 mm in each period, opens and closes evenly:
0.2 s from the widest opening to contact. */
PersonGrasp PlantReach(const Planted& planted) {
  PersonGrasp person = planted.person;
  person.reach.period = 0.02;
  person.reach.from_widest = 0.2;
  const Vector3d fingers = 0.5 * (person.digits[1].p_O + person.digits[2].p_O);
  const Vector3d axis = (fingers - person.digits[0].p_O).normalized();
  for (PersonDigit& digit : person.digits) {  // the axis and its midpoint stay
    digit.opening_O = (digit.digit == "TH" ? -0.012 : 0.012) * axis;
  }
  for (int k = 0; k <= 20; ++k) {
    const double opened = 1.0 - std::abs(k - 10) / 10.0;
    std::vector<Vector3d> tips;
    for (const PersonDigit& digit : person.digits) {
      tips.push_back(digit.p_O + opened * digit.opening_O + Vector3d(0.0, 0.0, 0.0105 * k));
    }
    person.reach.p_OTips.push_back(tips);
  }
  return person;
}

TEST(PlayReach, HandAndDigitsFollowThePerson) {
  const Hand hand = LoadHand("tum");
  const Planted planted = PlantGrasp(0.0);
  const PersonGrasp person = PlantReach(planted);
  const TransferredGrasp found = TransferGrasp(hand, LoadStandardGrasps(hand), person, planted.box);
  ASSERT_EQ(found.not_transferable, "");
  const PlayedReach played = PlayReach(hand, found, person, planted.box);
  ASSERT_EQ(played.not_played, "");
  const GraspCourse& course = played.course;
  ASSERT_EQ(course.p_HAway.size(), 11u);  // the first is more than 10 cm before contact
  EXPECT_NEAR(course.closure_start, 0.0, 1e-12);
  const Eigen::Matrix3d& R_WH = found.grasp.placement->X_WH.linear();
  const double met = found.grasp.placement->closing_at_contact;
  ASSERT_EQ(course.closing.size(), 3u);
  for (int k = 0; k <= 10; ++k) {
    const Vector3d away = R_WH * course.p_HAway[k];
    EXPECT_LT((away - Vector3d(0.0, 0.0, 0.0105 * (10 - k))).norm(), 1e-9) << k;
    for (const auto& [digit, closing] : course.closing) {
      EXPECT_NEAR(closing[k], met * k / 10.0, 1e-9) << digit << " " << k;
    }
  }
}

TEST(PlayReach, SaysWhyAHandCannotFollow) {
  const Hand hand = LoadHand("tum");
  const Planted planted = PlantGrasp(0.0);
  PersonGrasp person = planted.person;
  const TransferredGrasp found = TransferGrasp(hand, LoadStandardGrasps(hand), person, planted.box);
  ASSERT_EQ(found.not_transferable, "");
  EXPECT_NE(PlayReach(hand, found, person, planted.box).not_played.find("not recorded"),
            std::string::npos);
  person = PlantReach(planted);
  for (size_t k = 1; k < person.reach.p_OTips.size(); ++k) {  // through the box, from the side
    for (Vector3d& tip : person.reach.p_OTips[k]) {
      tip += Vector3d(0.01 * k, 0.0, -0.01 * k);
    }
  }
  const PlayedReach through = PlayReach(hand, found, person, planted.box);
  EXPECT_NE(through.not_played.find("on the person's way"), std::string::npos);
  EXPECT_FALSE(through.course.is_set());
  person = PlantReach(planted);
  for (PersonDigit& digit : person.digits) digit.opening_O *= 0.1;
  EXPECT_NE(PlayReach(hand, found, person, planted.box).not_played.find("1.2 mm only"),
            std::string::npos);
}

TEST(TransferGrasp, WrongRecordingsAreNamed) {
  const Planted planted = PlantGrasp(0.0);
  const auto find = [&](const auto& change) {
    PersonGrasp person = planted.person;
    change(person);
    return FindPersonFault(person, planted.box);
  };
  const auto has = [](const std::string& text, const char* part) {
    return text.find(part) != std::string::npos;
  };
  EXPECT_EQ(find([](PersonGrasp&) {}), "");
  EXPECT_TRUE(has(find([](PersonGrasp& p) { p.digits.erase(p.digits.begin()); }),
                  "thumb and another digit"));
  EXPECT_TRUE(has(find([](PersonGrasp& p) {
                    for (PersonDigit& digit : p.digits) digit.p_O *= 1000.0;
                  }),
                  "check the unit"));
  EXPECT_TRUE(has(find([](PersonGrasp& p) {
                    for (PersonDigit& digit : p.digits) digit.p_O.x() += 0.2;
                  }),
                  "both are of this trial"));
  EXPECT_TRUE(
      has(find([](PersonGrasp& p) { std::swap(p.digits[0].p_O, p.digits[1].p_O); }), "exchanged"));
  EXPECT_TRUE(has(find([&](PersonGrasp& p) {
                    p = PlantLandmarks(planted, 0.0);
                    std::swap(p.digits[0].p_OJoints, p.digits[1].p_OJoints);
                  }),
                  "of this digit"));
  EXPECT_TRUE(has(find([&](PersonGrasp& p) {
                    p = PlantLandmarks(planted, 0.0);
                    p.digits[2].p_OJoints.push_back(p.digits[2].p_O);
                  }),
                  "the last joint of MF is 0 mm from its tip"));
}

// Mirrored at a plane a right hand is a left one; a hand of five digits is not taken for it.
TEST(TransferGrasp, AMirroredHandIsRefused) {
  const Hand hand = LoadHand("shadow");
  const GraspObject box = MakeTurnedBar(Vector3d(0.05, 0.1, 0.08), 0.0);
  PersonGrasp right;
  const double y[] = {0.0, 0.03, 0.01, -0.01, -0.03};
  const char* const names[] = {"TH", "FF", "MF", "RF", "LF"};
  for (int d = 0; d < 5; ++d) {
    right.digits.push_back({names[d], Vector3d(d == 0 ? -0.025 : 0.025, y[d], 0.0),
                            Vector3d::Zero(), Vector3d::Zero()});
  }
  // From above, fingers to the right, thumb to the left: the index of a right hand is ahead.
  right.p_OPalm = Vector3d(0.0, 0.0, 0.15);
  PersonGrasp left = right;
  for (PersonDigit& digit : left.digits) digit.p_O.y() *= -1.0;
  EXPECT_EQ(FindHandedness(right), -1);
  EXPECT_EQ(FindHandedness(left), 1);
  EXPECT_EQ(FindHandedness(hand, LoadStandardGrasps(hand).front()), -1);
  const TransferredGrasp refused = TransferGrasp(hand, LoadStandardGrasps(hand), left, box);
  EXPECT_NE(refused.not_transferable.find("is a left hand"), std::string::npos);
}

}  // namespace
}  // namespace graspbench
