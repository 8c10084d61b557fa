#include "core/hand/import/find_implausible.h"

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
  FindHeavyPalm(file, imported.hand, problems);
}

}  // namespace graspbench
