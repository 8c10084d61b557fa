#include "datasets/analysis/grasp_course.h"

#include <algorithm>
#include <cmath>

#include "core/base/units.h"
#include "core/statistics/summary.h"

namespace graspbench {
namespace {

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

TapeCourse FindTapeCourse(const SceneVariants& scene) {
  constexpr double kMuchLarger = 1.5;
  TapeCourse course;
  course.always_succeeds = true;
  for (size_t v = 0; v < kNumVariants; ++v) {
    const Tally& tally = scene.cells[v]->tally;
    course.always_succeeds = course.always_succeeds && tally.successes() == tally.finished;
    course.sigma[v] = CalcCellValue(FindVariantMeasure("sigma"), *scene.cells[v]);
  }
  course.gap_before = CalcContactGap(scene.cell(kStandardGrasp), "FF", "MF");
  course.gap_after = CalcContactGap(scene.cell(kNewPreGrasp), "FF", "MF");
  course.index_is_first = FindFirstDigit(scene.cell(kStandardGrasp)) == "FF";
  course.fingers_meet = course.gap_after < course.gap_before;
  course.is_much_firmer = course.sigma[kNewPreGrasp] >= kMuchLarger * course.sigma[kStandardGrasp];
  course.is_firmer_again = course.sigma[kNewTarget] > course.sigma[kNewPreGrasp];
  return course;
}

PropellerCourse FindPropellerCourse(const SceneVariants& scene, const Hand& hand,
                                    const GraspObject& object) {
  constexpr double kClearTurnDeg = 5.0;
  constexpr double kCubeHeight = 0.031;  ///< the blades lie on the cube [m]
  PropellerCourse course;
  for (size_t v = 0; v < kNumVariants; ++v) {
    course.places[v] = CalcThumbPlace(*scene.cells[v], hand, object);
  }
  const auto& places = course.places;
  course.starts_on_blade = places[kStandardGrasp].height > kCubeHeight;
  course.moves_between_blades =
      places[kNewPreGrasp].from_blade_deg > places[kStandardGrasp].from_blade_deg + kClearTurnDeg;
  course.ends_on_cube = places[kNewTarget].height < kCubeHeight;
  return course;
}

}  // namespace graspbench
