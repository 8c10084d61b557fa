#include <algorithm>
#include <map>
#include <vector>

#include "core/arm/mounted_arm.h"
#include "core/base/text/text.h"
#include "core/base/units.h"
#include "reports/page/layout.h"
#include "reports/sections/section.h"

namespace graspbench {
namespace {

/** Arm results of the trials of one condition. */
struct ArmCounts {
  int num_trials = 0, num_success = 0;
  std::map<Outcome, int> faults;
  std::map<std::string, int> joints;                      ///< counts of the joint nearest its
                                                          ///< limit, or of the limiting joint
  std::vector<double> times;                              ///< duration of the gross motion [s]
  double least_margin = kUnset;                           ///< [rad]
  double deflection = kUnset, deflection_angle = kUnset;  ///< largest of the hand [m], [rad]
  double torque_share = kUnset;                           ///< largest of a joint
  std::string torque_joint = "-";                         ///< that joint
};

std::string NameMostFrequent(const std::map<std::string, int>& counts) {
  const auto most =
      std::max_element(counts.begin(), counts.end(),
                       [](const auto& a, const auto& b) { return a.second < b.second; });
  return most == counts.end() ? "-" : most->first;
}

std::string FormatMedianTime(std::vector<double> times) {
  if (times.empty()) return "n/a";
  std::sort(times.begin(), times.end());
  const size_t middle = times.size() / 2;
  const double median =
      times.size() % 2 == 1 ? times[middle] : 0.5 * (times[middle - 1] + times[middle]);
  return FormatFixed(median, 2);
}

Html DrawArm(const ReportData& data) {
  std::map<std::pair<std::string, std::string>, ArmCounts> conditions;
  for (const TrialRecord& record : data.session.records) {
    if (!record.result.arm || record.plan.condition) continue;
    const ArmRecord& arm = *record.result.arm;
    ArmCounts& counts = conditions[{record.plan.hand, record.plan.object}];
    ++counts.num_trials;
    counts.num_success += IsSuccess(record.result.outcome);
    if (!arm.joint.empty()) ++counts.joints[arm.joint];
    if (arm.q.size() == 0) {
      ++counts.faults[record.result.outcome];
      continue;
    }
    counts.times.push_back(arm.reach_time);
    counts.least_margin = std::fmin(counts.least_margin, arm.margin);
    counts.deflection = std::fmax(counts.deflection, arm.deflection);
    counts.deflection_angle = std::fmax(counts.deflection_angle, arm.deflection_angle);
    if (arm.torque_share <= counts.torque_share || std::isnan(arm.torque_share)) continue;
    counts.torque_share = arm.torque_share;
    counts.torque_joint = arm.torque_joint;
  }
  const ArmConfig& arm = data.session.config.arm;
  Table table("The arm by hand and object.",
              {"Hand",
               "Object",
               "Trials",
               {"Course", "trials in which the arm has a path"},
               "Cannot reach",
               "No straight path",
               {"Singular", "near a singular posture"},
               "Success",
               {"Time to pre-grasp [s]", "median"},
               {"Joint", "most often nearest its limit, or limiting the path"},
               {"Least margin [deg]", "smallest distance of a joint from its limit on the path"},
               {"Yield [mm]", "largest distance of the hand from its commanded position"},
               {"Yield [deg]", "largest rotation of the hand from its commanded orientation"},
               {"Torque [%]", "largest ratio of a joint torque to its limit, weights included"},
               {"Joint with it", "the joint with the largest torque over its limit"}});
  int num_trials = 0, num_courses = 0;
  for (const auto& [names, counts] : conditions) {
    const auto count = [&faults = counts.faults](Outcome outcome) {
      const auto found = faults.find(outcome);
      return found == faults.end() ? 0 : found->second;
    };
    const int num_with = static_cast<int>(counts.times.size());
    num_trials += counts.num_trials;
    num_courses += num_with;
    table.AddRow({data.models.NameOfHand(names.first), data.models.NameOfObject(names.second),
                  counts.num_trials, num_with, count(Outcome::kArmOutOfReach),
                  count(Outcome::kNoStraightPath), count(Outcome::kNearSingularity),
                  counts.num_success, FormatMedianTime(counts.times),
                  NameMostFrequent(counts.joints), FormatFixed(DegFromRad(counts.least_margin), 1),
                  FormatFixed(MmFromM(counts.deflection), 2),
                  FormatFixed(DegFromRad(counts.deflection_angle), 2),
                  FormatFixed(100.0 * counts.torque_share, 0), counts.torque_joint});
  }
  return MakeParagraph("Arm: " + arm.model + ", " + DescribeArmBase(CalcArmBase(arm)) +
                       ". It has a path in " + std::to_string(num_courses) + " of " +
                       FormatCount(num_trials, "trial") +
                       ". The hand yields as the arm's joints do.") +
         table.ToHtml();
}

}  // namespace

Section arm_section() { return {"arm", "Robot arm", DrawArm}; }

}  // namespace graspbench
