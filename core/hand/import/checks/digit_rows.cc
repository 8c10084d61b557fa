#include <algorithm>
#include <cmath>

#include "core/hand/closing.h"
#include "core/hand/import/checks/find_implausible.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

constexpr double kParallelDigits = 0.9, kAbout = 0.8;  // cosines

bool BendsAbout(const DigitRow& row, const Vector3d& direction) {
  const auto num_about = std::count_if(row.axes.begin(), row.axes.end(), [&](const Vector3d& axis) {
    return std::abs(axis.dot(direction)) > kAbout;
  });
  return 2 * num_about >= static_cast<int64_t>(row.axes.size());
}

}  // namespace

std::vector<DigitRow> MakeDigitRows(const Hand& hand) {
  const std::vector<int> closing = FindClosing(hand);
  const std::vector<Pose> X_HL = CalcLinkPoses(hand, CalcClosedPosture(hand, {}, 0.0));
  std::vector<DigitRow> rows;
  for (const Digit& digit : hand.digits) {
    DigitRow& row = rows.emplace_back();
    row.digit = &digit;
    row.base = X_HL[digit.links.front()].translation();
    row.along = (X_HL[digit.distal_link] * digit.p_LTip - row.base).stableNormalized();
    for (const int link : digit.links) {
      row.axes.emplace_back(X_HL[link].linear() * hand.links[link].axis);
      const int j = hand.links[link].joint;
      if (j < 0 || closing[j] == 0 || hand.joints[j].is_prismatic) continue;
      row.joints.push_back(j);
      row.turns.push_back(closing[j] * row.axes.back());
    }
  }
  return rows;
}

bool AreSideBySide(const DigitRow& a, const DigitRow& b) {
  if (a.axes.size() != b.axes.size()) return false;
  const Vector3d apart = (b.base - a.base).stableNormalized();
  return a.along.dot(b.along) > kParallelDigits && BendsAbout(a, apart) && BendsAbout(b, apart);
}

bool IsInRowOf(const DigitRow& digit, const DigitRow& a, const DigitRow& b, double off_line) {
  if (!AreSideBySide(a, b) || digit.axes.size() != a.axes.size()) return false;
  if (a.turns.empty() || b.turns.empty() || a.turns.back().dot(b.turns.back()) < kAbout)
    return false;
  if (std::min(digit.along.dot(a.along), digit.along.dot(b.along)) < kParallelDigits) return false;
  const Vector3d line = (b.base - a.base).stableNormalized(), from = digit.base - a.base;
  return (from - from.dot(line) * line).norm() < off_line;
}

double CalcLongestDigit(const Hand& hand) {
  const std::vector<Pose> X_HL = CalcLinkPoses(hand, CalcClosedPosture(hand, {}, 0.0));
  double longest = 0.0;
  for (const Digit& digit : hand.digits) {
    const Vector3d p_HTip = X_HL[digit.distal_link] * digit.p_LTip;
    longest = std::max(longest, (p_HTip - X_HL[digit.links.front()].translation()).norm());
  }
  return longest;
}

}  // namespace graspbench
