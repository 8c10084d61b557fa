#include "core/hand/import/checks/find_implausible.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/base/text/text.h"
#include "core/base/units.h"
#include "core/hand/closing.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

constexpr double kHeaviestPalm = 50.0;  // times the digits' mass
constexpr double kParallel = 0.9;       // cosine
constexpr double kLikeLimits = 0.05;    // [rad] between limits of joints of one build
constexpr double kBend = 0.3;           // [rad] by which a joint is tried
constexpr double kMoves = 0.001;        // [m] of a tip, to count
constexpr double kLightestHand = 0.01;  // [kg] of a hand
constexpr double kNarrowest = 0.0175;   // [rad] between a joint's limits
constexpr double kShortest = 0.0005;    // [m] between those of a slide

/** A digit's joints that bend it, from base to tip, and how it stands with all joints at zero. */
struct Row {
  const Digit* digit = nullptr;
  Vector3d base = Vector3d::Zero(), along = Vector3d::Zero();
  std::vector<int> joints;
  std::vector<Vector3d> turns;  // about which they close, in H
};

std::vector<Row> MakeRows(const Hand& hand) {
  const std::vector<int> closing = FindClosing(hand);
  const std::vector<Pose> X_HL = CalcLinkPoses(hand, CalcClosedPosture(hand, {}, 0.0));
  std::vector<Row> rows;
  for (const Digit& digit : hand.digits) {
    Row& row = rows.emplace_back();
    row.digit = &digit;
    row.base = X_HL[digit.links.front()].translation();
    row.along = (X_HL[digit.distal_link] * digit.p_LTip - row.base).stableNormalized();
    for (const int link : digit.links) {
      const int j = hand.links[link].joint;
      if (j < 0 || closing[j] == 0 || hand.joints[j].is_prismatic) continue;
      row.joints.push_back(j);
      row.turns.push_back(closing[j] * (X_HL[link].linear() * hand.links[link].axis));
    }
  }
  return rows;
}

/** Fingers that stand in a row, side by side along their axes: all must bend the same way. */
bool AreSideBySide(const Row& a, const Row& b) {
  if (a.joints.size() != b.joints.size() || a.joints.empty()) return false;
  const Vector3d apart = (b.base - a.base).stableNormalized();
  return a.along.dot(b.along) > kParallel && std::abs(apart.dot(a.turns.back())) > 0.8 &&
         std::abs(apart.dot(b.turns.back())) > 0.8;
}

void FindMirroredAxes(const std::string& file, const Hand& hand, Diagnostics& problems) {
  const std::vector<Row> rows = MakeRows(hand);
  for (const Row& row : rows) {
    for (size_t k = 0; k < row.joints.size(); ++k) {
      int num_alike = 0;
      std::string opposed;
      for (const Row& other : rows) {
        if (&other == &row || !AreSideBySide(row, other)) continue;
        const double cosine = row.turns[k].dot(other.turns[k]);
        num_alike += cosine > kParallel;
        if (cosine < -kParallel) {
          opposed += (opposed.empty() ? "\"" : ", \"") + hand.joints[other.joints[k]].name + "\"";
        }
      }
      if (opposed.empty() || num_alike > 0) continue;
      problems.Warn(file, 0,
                    "joint \"" + hand.joints[row.joints[k]].name +
                        "\": its axis is the mirror image of that of " + opposed +
                        " beside it, with limits of the same sign: it opens where they close; is "
                        "the sign of its axis wrong?");
    }
  }
}

/** By how much a digit's tip comes nearer to the middle of the others' when one joint closes [m]. */
double CalcApproach(const Hand& hand, const Digit& digit, int joint, int closing) {
  Eigen::VectorXd q = CalcClosedPosture(hand, {}, 0.0);
  const auto calc_distance = [&] {
    const std::vector<Pose> X_HL = CalcLinkPoses(hand, q);
    Vector3d middle = Vector3d::Zero(), own = Vector3d::Zero();
    for (const Digit& each : hand.digits) {
      const Vector3d p_HTip = X_HL[each.distal_link] * each.p_LTip;
      if (&each == &digit) {
        own = p_HTip;
      } else {
        middle += p_HTip / (static_cast<double>(hand.digits.size()) - 1.0);
      }
    }
    return (own - middle).norm();
  };
  const double before = calc_distance();
  q[joint] += closing * kBend;
  return before - calc_distance();
}

/** Copies of one digit about a hub: their joints are described alike but for the sign of an axis,
and with it one of them closes away from the others. Digits that face each other may have opposite
axes: there both close towards each other. */
void FindOutwardCopies(const std::string& file, const Hand& hand, Diagnostics& problems) {
  const std::vector<int> closing = FindClosing(hand);
  const std::vector<Row> rows = MakeRows(hand);
  const auto is_of_one_build = [&](int a, int b) {
    const HandJoint &ja = hand.joints[a], &jb = hand.joints[b];
    return hand.links[ja.link].axis.dot(hand.links[jb.link].axis) < -kParallel &&
           std::abs(ja.lower - jb.lower) < kLikeLimits &&
           std::abs(ja.upper - jb.upper) < kLikeLimits;
  };
  for (const Row& row : rows) {
    for (size_t k = 0; k < row.joints.size(); ++k) {
      std::string inward;
      int num_outward = 0;
      for (const Row& other : rows) {
        if (&other == &row || other.joints.size() != row.joints.size()) continue;
        const int j = other.joints[k];
        if (!is_of_one_build(row.joints[k], j)) continue;
        const double approach = CalcApproach(hand, *other.digit, j, closing[j]);
        num_outward += approach < kMoves;
        if (approach > kMoves)
          inward += (inward.empty() ? "\"" : ", \"") + hand.joints[j].name + "\"";
      }
      const int j = row.joints[k];
      if (inward.empty() || num_outward > 0) continue;
      if (CalcApproach(hand, *row.digit, j, closing[j]) > -kMoves) continue;
      problems.Warn(file, 0,
                    "joint \"" + hand.joints[j].name +
                        "\": its axis is the mirror image of that of " + inward +
                        " of another digit of its build, and it closes away from the other "
                        "digits, which they do not; is the sign of its axis wrong?");
    }
  }
}

/** Equal limits are fixed before. */
void FindNarrowLimits(const std::string& file, const Hand& hand, Diagnostics& problems) {
  std::vector<const HandJoint*> narrow;
  for (const HandJoint& joint : hand.joints) {
    const double range = joint.upper - joint.lower;
    if (range < (joint.is_prismatic ? kShortest : kNarrowest)) narrow.push_back(&joint);
  }
  if (narrow.empty()) return;
  std::string names;
  for (const HandJoint* joint : narrow)
    names += (names.empty() ? "\"" : ", \"") + joint->name + "\"";
  const HandJoint& first = *narrow.front();
  problems.Warn(file, 0,
                FormatCount(static_cast<int64_t>(narrow.size()), "joint") + " next to stuck, " +
                    names + ": the first moves by " +
                    FormatSignificant(ToDisplayUnits(first, first.upper - first.lower), 2) + " " +
                    DisplayUnitOf(first) + "; are its limits in another unit?");
}

void FindLightHand(const std::string& file, const Hand& hand, Diagnostics& problems) {
  double mass = 0.0;
  for (const HandLink& link : hand.links) mass += link.mass;
  if (mass >= kLightestHand) return;
  problems.Warn(
      file, 0,
      "the hand has a mass of " + FormatSignificant(GFromKg(mass), 2) +
          " g in all, which no hand has; are its masses in another unit than the kilogram?");
}

void FindHeavyPalm(const std::string& file, const Hand& hand, Diagnostics& problems) {
  double palm = 0.0, digits = 0.0;
  for (int link = 0; link < static_cast<int>(hand.links.size()); ++link) {
    (hand.FindDigitOfLink(link) < 0 ? palm : digits) += hand.links[link].mass;
  }
  if (palm <= kHeaviestPalm * digits) return;
  problems.Warn(file, 0,
                "palm and wrist weigh " + FormatSignificant(palm, 3) + " kg, " +
                    FormatSignificant(palm / digits, 2) + " times as much as all digits, " +
                    FormatSignificant(GFromKg(digits), 3) +
                    " g; are the masses of one of them in another unit, or is an arm among them?");
}

}  // namespace

void FindImplausible(const std::string& file, const ImportedHand& imported, Diagnostics& problems) {
  FindMirroredAxes(file, imported.hand, problems);
  FindOutwardCopies(file, imported.hand, problems);
  FindNarrowLimits(file, imported.hand, problems);
  FindLightHand(file, imported.hand, problems);
  FindHeavyPalm(file, imported.hand, problems);
}

}  // namespace graspbench
