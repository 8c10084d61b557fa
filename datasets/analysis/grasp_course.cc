#include "datasets/analysis/grasp_course.h"

#include <algorithm>
#include <cmath>

#include "core/base/units.h"

namespace graspbench {
namespace {

double CalcMean(const std::vector<double>& values) {
  double sum = 0.0;
  for (double value : values) sum += value;
  return values.empty() ? std::nan("") : sum / static_cast<double>(values.size());
}

double FindContact(const TrialResult& result, const std::string& digit) {
  for (const DigitContact& contact : result.contacts) {
    if (contact.digit == digit) return contact.time;
  }
  return std::nan("");
}

}  // namespace

double CalcContactGap(const CellSummary& cell, const std::string& digit_a,
                      const std::string& digit_b) {
  std::vector<double> gaps;
  for (const TrialRecord* record : cell.records) {
    const double gap =
        std::abs(FindContact(record->result, digit_a) - FindContact(record->result, digit_b));
    if (std::isfinite(gap)) gaps.push_back(gap);
  }
  return CalcMean(gaps);
}

std::map<std::string, int> CountFirstTouches(const CellSummary& cell) {
  std::map<std::string, int> counts;
  for (const TrialRecord* record : cell.records) {
    const DigitContact* first = nullptr;
    for (const DigitContact& contact : record->result.contacts) {
      if (std::isfinite(contact.time) && (!first || contact.time < first->time)) first = &contact;
    }
    if (first) ++counts[first->digit];
  }
  return counts;
}

std::string FindFirstDigit(const CellSummary& cell) {
  const std::map<std::string, int> counts = CountFirstTouches(cell);
  const auto most =
      std::max_element(counts.begin(), counts.end(),
                       [](const auto& a, const auto& b) { return a.second < b.second; });
  return most == counts.end() ? "" : most->first;
}

ThumbPlace CalcThumbPlace(const CellSummary& cell, const Hand& hand, const GraspObject& object) {
  std::vector<double> heights, angles;
  const auto thumb = std::find_if(hand.digits.begin(), hand.digits.end(),
                                  [](const Digit& digit) { return digit.is_thumb; });
  for (const TrialRecord* record : cell.records) {
    for (const SceneSnapshot& snapshot : record->result.snapshots) {
      if (snapshot.moment != Moment::kClosed || thumb == hand.digits.end()) continue;
      if (snapshot.q.size() != hand.num_joints()) continue;
      const Pose X_HL = CalcLinkPoses(hand, snapshot.q)[static_cast<size_t>(thumb->distal_link)];
      const Eigen::Vector3d p_OPad = snapshot.X_WO.inverse() * snapshot.X_WH * X_HL * thumb->p_LPad;
      heights.push_back(p_OPad.z() + 0.5 * object.size.z());
      const double angle = DegFromRad(std::atan2(std::abs(p_OPad.y()), std::abs(p_OPad.x())));
      angles.push_back(std::min(angle, 90.0 - angle));
    }
  }
  return {CalcMean(heights), CalcMean(angles)};
}

}  // namespace graspbench
