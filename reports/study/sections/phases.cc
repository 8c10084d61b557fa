#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "core/base/text/text.h"
#include "core/grasp/strategy.h"
#include "core/statistics/summary.h"
#include "reports/plots/line_plot.h"
#include "reports/study/study_format.h"

namespace graspbench {
namespace {

/** Instants of a reach that begin or end a phase. */
enum Instant { kOnset, kPeak, kSlow, kEnd, kTouched, kLift, kNumInstants };

/** Since the onset, as shares of the time to the lift-off: medians over trials. */
struct PhaseCourse {
  std::array<double, kNumInstants> at{};       ///< by Instant; NaN: no trial has it
  std::array<int, kNumInstants> num_trials{};  ///< that have it, with onset and lift-off
};

PhaseCourse SummariseCourses(const std::vector<std::array<double, kNumInstants>>& courses) {
  PhaseCourse summary;
  for (size_t i = 0; i < kNumInstants; ++i) {
    std::vector<double> shares;
    for (const auto& at : courses) {
      const double length = at[kLift] - at[kOnset];
      if (length > 0.0) shares.push_back((at[i] - at[kOnset]) / length);
    }
    summary.num_trials[i] = static_cast<int>(std::count_if(
        shares.begin(), shares.end(), [](double share) { return std::isfinite(share); }));
    summary.at[i] = CalcMedianOfFinite(std::move(shares));
  }
  return summary;
}

PhaseCourse FindCourseOfPeople(const StudyResult& result) {
  std::vector<std::array<double, kNumInstants>> courses;
  for (const StudyTrial& trial : result.trials) {
    if (!trial.IsKept()) continue;
    const TrialAnalysis& a = *trial.analysis;
    courses.push_back({a.movement.onset.time, a.closure_start.time, a.phases.reacceleration.time,
                       a.movement.end.time, a.closure_start.time + a.timing.gct,
                       a.object.lift_off.time});
  }
  return SummariseCourses(courses);
}

/** The strategy's phases follow each other: the hand stands still while the digits close. */
PhaseCourse FindCourseOfRobot(const Session& session) {
  std::vector<std::array<double, kNumInstants>> courses;
  for (const TrialRecord& record : session.records) {
    const auto start_of = [&](Phase phase) {
      for (const PhaseStart& start : record.result.phases) {
        if (start.name == NameOf(phase)) return start.time;
      }
      return kUnset;
    };
    const double placing = start_of(Phase::kPlacing), closure = start_of(Phase::kClosure);
    courses.push_back({start_of(Phase::kPreGrasp), closure, placing, closure,
                       start_of(Phase::kStabilisation), start_of(Phase::kLiftOff)});
  }
  return SummariseCourses(courses);
}

void AddCourse(const std::string& who, const PhaseCourse& course, StripChart& chart) {
  constexpr double kLiftShown = 10.0;  // of the lift-off, which has no end here [%]
  const auto add = [&](StripChart::Row& row, Instant from, Instant to, int kind) {
    const double begin = 100.0 * course.at[from], end = 100.0 * course.at[to];
    if (!std::isfinite(begin) || !std::isfinite(end)) return;
    row.spans.push_back({begin, end, kind,
                         chart.kinds[static_cast<size_t>(kind)] + ", " + FormatFixed(begin, 0) +
                             " to " + FormatFixed(end, 0) + " %"});
  };
  StripChart::Row transport = {who + ", transport", {}, {}}, grasp = {who + ", grasp", {}, {}};
  const bool has_slow = std::isfinite(course.at[kSlow]);
  add(transport, kOnset, has_slow ? kSlow : kEnd, 0);
  if (has_slow) add(transport, kSlow, kEnd, 1);
  transport.spans.push_back({100.0, 100.0 + kLiftShown, 2, chart.kinds[2]});
  add(grasp, kOnset, kPeak, 3);
  add(grasp, kPeak, kTouched, 4);
  add(grasp, kTouched, kLift, 5);
  chart.rows.push_back(std::move(transport));
  chart.rows.push_back(std::move(grasp));
}

/** Dashed lines at people's instants. */
std::vector<StripChart::Phase> ListPhases(const PhaseCourse& people) {
  const double peak = 100.0 * people.at[kPeak], touched = 100.0 * people.at[kTouched];
  if (!std::isfinite(peak) || !std::isfinite(touched)) return {};
  return {{0.0, peak, "opens"}, {peak, touched, "closes"}, {touched, 100.0, "holds"}};
}

std::string DescribeLag(const PhaseCourse& people, int num_trials) {
  const int num_slow = people.num_trials[kSlow];
  if (num_slow == 0) return "no trial shows where the slow approach begins.";
  return "the slow approach begins near the widest opening (Jeannerod 1984). Here " +
         FormatFixed(100.0 * std::abs(people.at[kPeak] - people.at[kSlow]), 0) +
         " % of the time lie between the two medians; " + std::to_string(num_slow) + " of " +
         FormatCount(num_trials, "trial") + " show where it begins.";
}

Html DrawPhases(const StudyPageData& data) {
  const PhaseCourse people = FindCourseOfPeople(data.result);
  const int num_trials = people.num_trials[kLift];
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
    if (robot.num_trials[kLift] > 0) AddCourse("robot", robot, chart);
    robots = " Robot: " + FormatCount(robot.num_trials[kLift], "trial") + " of " +
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
