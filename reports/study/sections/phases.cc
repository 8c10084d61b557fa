#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/base/text/text.h"
#include "core/grasp/strategy.h"
#include "human_study/study/inference/phase_course.h"
#include "reports/plots/line_plot.h"
#include "reports/study/study_format.h"

namespace graspbench {
namespace {

/** Returns the robot's phases, which do not overlap: the hand stands still while the digits
close. */
PhaseCourse FindCourseOfRobot(const Session& session) {
  std::vector<PhaseTimes> trials;
  for (const TrialRecord& record : session.records) {
    const auto start_of = [&](Phase phase) {
      for (const PhaseStart& start : record.result.phases) {
        if (start.name == NameOf(phase)) return start.time;
      }
      return kUnset;
    };
    const double placing = start_of(Phase::kPlacing), closure = start_of(Phase::kClosure);
    trials.push_back({start_of(Phase::kPreGrasp), closure, placing, closure,
                      start_of(Phase::kStabilisation), start_of(Phase::kLiftOff)});
  }
  return SummarisePhases(trials);
}

void AddCourse(const std::string& who, const PhaseCourse& course, StripChart& chart) {
  constexpr double kLiftShown = 10.0;  // drawn length of the lift-off, whose end is outside the
                                       // chart [%]
  const auto add = [&](StripChart::Row& row, PhaseInstant from, PhaseInstant to, int kind) {
    const double begin = 100.0 * course.at[from], end = 100.0 * course.at[to];
    if (!std::isfinite(begin) || !std::isfinite(end)) return;
    row.spans.push_back({begin, end, kind,
                         chart.kinds[static_cast<size_t>(kind)] + ", " + FormatFixed(begin, 0) +
                             " to " + FormatFixed(end, 0) + " %"});
  };
  StripChart::Row transport = {who + ", transport", {}, {}}, grasp = {who + ", grasp", {}, {}};
  const bool has_slow = std::isfinite(course.at[kSlowApproach]);
  add(transport, kOnset, has_slow ? kSlowApproach : kMovementEnd, 0);
  if (has_slow) add(transport, kSlowApproach, kMovementEnd, 1);
  transport.spans.push_back({100.0, 100.0 + kLiftShown, 2, chart.kinds[2]});
  add(grasp, kOnset, kPeakOpening, 3);
  add(grasp, kPeakOpening, kLastContact, 4);
  add(grasp, kLastContact, kLiftOff, 5);
  chart.rows.push_back(std::move(transport));
  chart.rows.push_back(std::move(grasp));
}

/** Returns phases bounded by dashed lines at the participants' instants. */
std::vector<StripChart::Phase> ListPhases(const PhaseCourse& people) {
  const double peak = 100.0 * people.at[kPeakOpening], touched = 100.0 * people.at[kLastContact];
  if (!std::isfinite(peak) || !std::isfinite(touched)) return {};
  return {{0.0, peak, "opens"}, {peak, touched, "closes"}, {touched, 100.0, "holds"}};
}

std::string DescribeLag(const PhaseCourse& people, int num_trials) {
  const int num_slow = people.num_trials[kSlowApproach];
  if (num_slow == 0) return "no slow approach was found in any trial.";
  return "the slow approach begins near the widest opening (Jeannerod 1984). Here " +
         FormatFixed(100.0 * std::abs(people.at[kPeakOpening] - people.at[kSlowApproach]), 0) +
         " % of the time lie between the two medians; " + std::to_string(num_slow) + " of " +
         FormatCount(num_trials, "trial") + " show where it begins.";
}

Html DrawPhases(const StudyPageData& data) {
  const PhaseCourse people = SummarisePhases(data.result.trials);
  const int num_trials = people.num_trials[kLiftOff];
  if (num_trials == 0) return MakeParagraph("No trial that counts has an onset and a lift-off.");
  StripChart chart;
  chart.text.title = "Phases of reach and grasp";
  chart.text.description =
      "Two rows each for people and robots: phases of transport and of grasping as blocks over the "
      "time from the onset to the lift-off.";
  chart.axis = "time from the onset to the lift-off [%]";
  chart.kinds = {"fast approach", "slow approach", "lift-off",
                 "pre-grasp",     "closure",       "stabilisation"};
  AddCourse("people", people, chart);
  std::string robots;
  if (data.robot != nullptr) {
    const PhaseCourse robot = FindCourseOfRobot(data.robot->session);
    if (robot.num_trials[kLiftOff] > 0) AddCourse("robot", robot, chart);
    robots = " Robot: " + FormatCount(robot.num_trials[kLiftOff], "trial") + " of " +
             data.robot->name + "; it places the hand before it closes.";
  }
  chart.phases = ListPhases(people);
  return MakeFigure("Phases by the medians of " + FormatCount(num_trials, "trial") +
                        " with onset and lift-off. Dashed lines: people's widest opening, last "
                        "contact and lift-off." +
                        robots,
                    DescribeLag(people, num_trials),
                    MakeScroll(chart.text.title, DrawStripChart(chart)));
}

}  // namespace

StudySection phases_study_section() { return {"phases", "Phases of reach and grasp", DrawPhases}; }

}  // namespace graspbench
