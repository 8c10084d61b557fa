#include "core/hand/import/checks/find_implausible.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "core/base/text/text.h"
#include "core/base/units.h"
#include "core/hand/closing.h"
#include "core/hand/import/foreign_hand.h"
#include "core/hand/import/shapes/shape_distance.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

constexpr double kHeaviestPalm = 50.0;                      // times the digits' mass
constexpr double kSameLine = 0.9;                           // cosine
constexpr double kLightestHand = 0.01;                      // [kg]
constexpr double kNarrowest = 0.0175;                       // range of a joint [rad]
constexpr double kShortest = 0.0005;                        // range of a slide [m]
constexpr double kWidest = 3.6;                             // range of a digit's joint [rad]
constexpr double kShortestDigit = 0.03, kLongDigit = 0.25;  // of a hand's longest digit [m]
/** Density of a hand by the volume of its contact shapes, from plastics with hollows to metal
[kg/m^3]. */
constexpr double kLeastDensity = 200.0, kMostDensity = 12000.0;

/** Reports outward digits of which no joint was reported before. */
void TellOutwardDigits(const std::string& file, const Hand& hand,
                       const std::vector<bool>& is_outward, const std::set<int>& told,
                       Diagnostics& problems) {
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

/** Reports digits that oppose no other, except those reported as outward. An outer finger of a row
may close to the palm if at least half of the row opposes the thumb, as in hands whose thumb cannot
turn. */
void TellUnopposedDigits(const std::string& file, const ImportedHand& imported,
                         const std::vector<bool>& is_outward, Diagnostics& problems) {
  const Hand& hand = imported.hand;
  const std::vector<bool> is_opposed = FindOpposedDigits(imported);
  const std::vector<DigitRow> rows = MakeDigitRows(hand);
  const auto is_of_opposed_row = [&](size_t d) {
    int num = 1, num_opposed = 0;
    for (size_t e = 0; e < rows.size(); ++e) {
      if (e == d || !AreSideBySide(rows[d], rows[e])) continue;
      ++num;
      num_opposed += is_opposed[e];
    }
    return 2 * num_opposed >= num;
  };
  std::vector<std::string> alone;
  for (size_t d = 0; d < hand.digits.size(); ++d) {
    if (is_opposed[d] || is_outward[d] || is_of_opposed_row(d)) continue;
    alone.push_back(hand.links[hand.digits[d].distal_link].name);
  }
  if (alone.empty()) return;
  problems.Warn(file, 0,
                FormatCount(static_cast<int64_t>(alone.size()), "digit") + " (" + JoinSome(alone) +
                    ") cannot oppose another: their pads face no other pad near them, in no "
                    "posture; is an axis, a limit or the place of a joint wrong?");
}

/** Reports two jaws that slide along one line with similar limits, so that their gap is
constant. */
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
      if (along_a.dot(along_b) < kSameLine || closing[a] == closing[b] ||
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

/** Reports joints of digits that turn farther than a finger can. */
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

/** Reports a joint that follows one of another digit, behind a joint of its own digit with its own
drive. Linkages and spread joints are coupled as a whole. */
void FindDigitsTiedAcross(const std::string& file, const Hand& hand, Diagnostics& problems) {
  for (const Digit& digit : hand.digits) {
    std::string driven;
    for (const int link : digit.links) {
      const int j = hand.links[link].joint;
      if (j < 0) continue;
      const HandJoint& joint = hand.joints[j];
      if (joint.coupled_to < 0) {
        driven = joint.name;
        continue;
      }
      const HandJoint& leader = hand.joints[joint.coupled_to];
      const int of_leader = hand.FindDigitOfLink(leader.link);
      if (driven.empty() || of_leader < 0 || &hand.digits[of_leader] == &digit) continue;
      problems.Warn(file, 0,
                    "joint \"" + joint.name + "\" follows \"" + leader.name +
                        "\" of another digit, while \"" + driven +
                        "\" before it has a drive of its own; is it tied to the wrong joint?");
    }
  }
}

/** Joints with equal limits have been fixed before. */
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

struct Fill {
  double mass = 0.0, volume = 0.0;  // [kg], [m^3] of all contact shapes
  bool IsOdd() const { return mass <= kLeastDensity * volume || mass >= kMostDensity * volume; }
};

Fill CalcFill(const ImportedHand& imported) {
  Fill fill;
  for (int link = 0; link < static_cast<int>(imported.hand.links.size()); ++link) {
    const auto shapes = ListShapesOf(imported.shapes, link);
    if (shapes.empty()) continue;
    fill.mass += imported.hand.links[link].mass;
    fill.volume += CalcUnionMass(shapes, 1.0).mass;
  }
  return fill;
}

/** Lengths or masses in another unit change the density, lengths by their third power. Short digits
are accepted if published masses agree. */
void FindOddSize(const std::string& file, const ImportedHand& imported, Diagnostics& problems) {
  const double longest = CalcLongestDigit(imported.hand);
  const Fill fill = CalcFill(imported);
  if (fill.volume > 0.0 && fill.IsOdd()) {
    problems.Warn(file, 0,
                  "a mass of " + FormatSignificant(fill.mass, 3) + " kg in " +
                      FormatSignificant(1e6 * fill.volume, 3) + " cm^3 of shapes, " +
                      FormatSignificant(fill.mass / fill.volume, 2) +
                      " kg/m^3, with a longest digit of " + FormatFixed(MmFromM(longest), 0) +
                      " mm; are its lengths or its masses in another unit?");
  }
  const bool is_meant = fill.volume > 0.0 && !fill.IsOdd() && imported.are_masses_published;
  if (longest < kLongDigit && (longest > kShortestDigit || is_meant)) return;
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
  const std::set<int> told = FindUnlikeDigits(file, imported, problems);
  const std::vector<bool> is_outward = FindOutwardDigits(imported.hand);
  TellOutwardDigits(file, imported.hand, is_outward, told, problems);
  TellUnopposedDigits(file, imported, is_outward, problems);
  FindJawsInStep(file, imported.hand, problems);
  FindWideLimits(file, imported.hand, problems);
  FindDigitsTiedAcross(file, imported.hand, problems);
  FindNarrowLimits(file, imported.hand, problems);
  FindLightHand(file, imported.hand, problems);
  FindOddSize(file, imported, problems);
  FindHeavyPalm(file, imported.hand, problems);
  FindMisplacedLinks(file, imported, problems);
}

}  // namespace graspbench
