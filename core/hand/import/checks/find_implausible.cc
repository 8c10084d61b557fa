#include "core/hand/import/checks/find_implausible.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "core/base/text/text.h"
#include "core/base/units.h"
#include "core/hand/closing.h"
#include "core/hand/import/checks/outward_digits.h"
#include "core/hand/import/foreign_xml.h"
#include "core/hand/import/shapes/shape_distance.h"

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
constexpr double kWidest = 3.6;         // [rad] between those of a digit's joint
constexpr double kUnlike = 1.8;         // ratio of ranges
constexpr double kShortestDigit = 0.03, kLongDigit = 0.25;  // [m] of a hand's longest
/** Of a hand: plastics with hollows to metal, by what its contact shapes fill [kg/m^3]. */
constexpr double kLeastDensity = 200.0, kMostDensity = 12000.0;

}  // namespace

double CalcLongestDigit(const Hand& hand) {
  const std::vector<Pose> X_HL = CalcLinkPoses(hand, CalcClosedPosture(hand, {}, 0.0));
  double longest = 0.0;
  for (const Digit& digit : hand.digits) {
    const Vector3d p_HTip = X_HL[digit.distal_link] * digit.p_LTip;
    longest = std::max(longest, (p_HTip - X_HL[digit.links.front()].translation()).norm());
  }
  return longest;
}

namespace {

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

/** @returns the joints that were told. */
std::set<int> FindMirroredAxes(const std::string& file, const Hand& hand, Diagnostics& problems) {
  std::set<int> told;
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
      told.insert(row.joints[k]);
      problems.Warn(file, 0,
                    "joint \"" + hand.joints[row.joints[k]].name +
                        "\": its axis is the mirror image of that of " + opposed +
                        " beside it, with limits of the same sign: it opens where they close; is "
                        "the sign of its axis wrong?");
    }
  }
  return told;
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
void FindOutwardCopies(const std::string& file, const Hand& hand, Diagnostics& problems,
                       std::set<int>& told) {
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
      if (inward.empty() || num_outward > 0 || told.count(j) > 0) continue;
      if (CalcApproach(hand, *row.digit, j, closing[j]) > -kMoves) continue;
      told.insert(j);
      problems.Warn(file, 0,
                    "joint \"" + hand.joints[j].name +
                        "\": its axis is the mirror image of that of " + inward +
                        " of another digit of its build, and it closes away from the other "
                        "digits, which they do not; is the sign of its axis wrong?");
    }
  }
}

/** Digits none of whose joints was told. */
void TellOutwardDigits(const std::string& file, const Hand& hand, const std::set<int>& told,
                       Diagnostics& problems) {
  const std::vector<bool> is_outward = FindOutwardDigits(hand);
  for (size_t d = 0; d < hand.digits.size(); ++d) {
    const Digit& digit = hand.digits[d];
    const bool is_told = std::any_of(digit.links.begin(), digit.links.end(), [&](int link) {
      return told.count(hand.links[link].joint) > 0;
    });
    if (!is_outward[d] || is_told) continue;
    problems.Warn(file, 0,
                  "the digit that ends with \"" + hand.links[digit.distal_link].name +
                      "\" closes away from all others: they do not oppose it; are the signs of "
                      "its axes or limits wrong?");
  }
}

/** Two jaws that slide along one line by like limits: they are open at one end, or closed. */
void FindJawsInStep(const std::string& file, const Hand& hand, Diagnostics& problems) {
  const std::vector<int> closing = FindClosing(hand);
  const std::vector<Pose> X_HL = CalcLinkPoses(hand, CalcClosedPosture(hand, {}, 0.0));
  const auto slides_to_one_side = [&](int j) {
    const HandJoint& joint = hand.joints[j];
    return joint.is_prismatic && closing[j] != 0 &&
           std::abs(joint.lower + joint.upper) > 0.2 * (joint.upper - joint.lower);
  };
  for (int a = 0; a < hand.num_joints(); ++a) {
    for (int b = a + 1; b < hand.num_joints(); ++b) {
      if (!slides_to_one_side(a) || !slides_to_one_side(b)) continue;
      const HandJoint &ja = hand.joints[a], &jb = hand.joints[b];
      const Vector3d along_a = X_HL[ja.link].linear() * hand.links[ja.link].axis;
      const Vector3d along_b = X_HL[jb.link].linear() * hand.links[jb.link].axis;
      const double most = 0.05 * (ja.upper - ja.lower);
      if (along_a.dot(along_b) < kParallel || closing[a] == closing[b] ||
          std::abs(ja.lower - jb.lower) > most || std::abs(ja.upper - jb.upper) > most) {
        continue;
      }
      problems.Warn(file, 0,
                    "the jaws of \"" + ja.name + "\" and \"" + jb.name +
                        "\" run the same way by the same limits: one opens where the other "
                        "closes; is the sign of an axis wrong?");
    }
  }
}

/** What is called "continuous" has been fixed, as it has no limits. */
void FindWideLimits(const std::string& file, const Hand& hand, Diagnostics& problems) {
  std::vector<std::string> wide;
  for (const HandJoint& joint : hand.joints) {
    const double range = joint.upper - joint.lower;
    if (joint.is_prismatic || range < kWidest || hand.FindDigitOfLink(joint.link) < 0) continue;
    wide.push_back(joint.name + " " + FormatFixed(DegFromRad(range), 0) + " deg");
  }
  if (wide.empty()) return;
  problems.Warn(file, 0,
                FormatCount(static_cast<int64_t>(wide.size()), "joint") + " (" + JoinSome(wide) +
                    ") may turn farther than a finger's joint, half a turn; are the limits in "
                    "another unit, or those of a servo?");
}

/** Of fingers side by side: one turns farther than the like joints of two others, which agree. */
void FindUnlikeLimits(const std::string& file, const Hand& hand, Diagnostics& problems) {
  const std::vector<Row> rows = MakeRows(hand);
  const auto calc_range = [&](int j) { return hand.joints[j].upper - hand.joints[j].lower; };
  for (const Row& row : rows) {
    for (size_t k = 0; k < row.joints.size(); ++k) {
      double least = std::numeric_limits<double>::infinity(), most = 0.0;
      int num_beside = 0;
      for (const Row& other : rows) {
        if (&other == &row || !AreSideBySide(row, other)) continue;
        least = std::min(least, calc_range(other.joints[k]));
        most = std::max(most, calc_range(other.joints[k]));
        ++num_beside;
      }
      const double own = calc_range(row.joints[k]);
      if (num_beside < 2 || most > 1.1 * least || (own < kUnlike * most && own > least / kUnlike)) {
        continue;
      }
      problems.Warn(file, 0,
                    "joint \"" + hand.joints[row.joints[k]].name + "\" turns by " +
                        FormatFixed(DegFromRad(own), 0) + " deg, the like joints beside it by " +
                        FormatFixed(DegFromRad(most), 0) + " deg; is a limit wrong?");
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

/** Of all that touches. Lengths or masses in another unit show here by the third power. */
void FindOddDensity(const std::string& file, const ImportedHand& imported, Diagnostics& problems) {
  const Hand& hand = imported.hand;
  double mass = 0.0, volume = 0.0;
  for (int link = 0; link < static_cast<int>(hand.links.size()); ++link) {
    const auto shapes = ListShapesOf(imported.shapes, link);
    if (shapes.empty()) continue;
    const double own = CalcUnionMass(shapes, 1.0).mass;
    mass += hand.links[link].mass;
    volume += own;
  }
  if (volume == 0.0) return;
  const double density = mass / volume;
  if (density > kLeastDensity && density < kMostDensity) return;
  problems.Warn(file, 0,
                "a mass of " + FormatSignificant(mass, 3) + " kg in " +
                    FormatSignificant(1e6 * volume, 3) + " cm^3 of shapes, " +
                    FormatSignificant(density, 2) + " kg/m^3, with a longest digit of " +
                    FormatFixed(MmFromM(CalcLongestDigit(hand)), 0) +
                    " mm; are its lengths or its masses in another unit?");
}

void FindOddSize(const std::string& file, const Hand& hand, Diagnostics& problems) {
  const double longest = CalcLongestDigit(hand);
  if (longest > kShortestDigit && longest < kLongDigit) return;
  problems.Warn(file, 0,
                "the longest digit is " + FormatFixed(MmFromM(longest), 0) +
                    " mm long, those of hands are 30 to 250 mm; are its lengths in another unit? "
                    "Then say it with --unit");
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
  std::set<int> told = FindMirroredAxes(file, imported.hand, problems);
  FindOutwardCopies(file, imported.hand, problems, told);
  TellOutwardDigits(file, imported.hand, told, problems);
  FindJawsInStep(file, imported.hand, problems);
  FindWideLimits(file, imported.hand, problems);
  FindUnlikeLimits(file, imported.hand, problems);
  FindNarrowLimits(file, imported.hand, problems);
  FindLightHand(file, imported.hand, problems);
  FindOddDensity(file, imported, problems);
  FindOddSize(file, imported.hand, problems);
  FindHeavyPalm(file, imported.hand, problems);
}

}  // namespace graspbench
