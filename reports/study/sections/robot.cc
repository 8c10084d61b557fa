#include <algorithm>
#include <cmath>

#include "core/base/text/text.h"
#include "datasets/analysis/session_summary.h"
#include "human_study/events/contact_detector.h"
#include "reports/page/models.h"
#include "reports/people_and_robots.h"
#include "reports/plots/line_plot.h"
#include "reports/study/study_format.h"

namespace graspbench {
namespace {

/** A group of trials of humans or of robots. */
struct Group {
  std::string name;
  TimingRatios ratios;
  bool is_human = false;
};

std::vector<Group> ListGroups(const StudyPageData& data) {
  std::vector<ContactTiming> people;
  for (const StudyTrial& trial : data.result.trials) {
    if (trial.IsKept()) people.push_back(trial.analysis->timing);
  }
  std::vector<Group> groups = {{"humans, all trials", SummariseTimings(people), true}};
  const Session& session = data.robot->session;
  const SessionModels models = LoadSessionModels(session);
  for (const TimingGroup& group : ListTimingGroups(session)) {
    const std::string what = group.grasp.empty() ? "all trials" : NameOfGrasp(group.grasp);
    groups.push_back({models.NameOfHand(group.hand) + ", " + what, group.ratios, false});
  }
  return groups;
}

void AddRows(const std::vector<Group>& groups, Answer<Summary> TimingRatios::*ratio,
             const char* name, IntervalPlot& plot) {
  plot.AddHeading(name);
  for (const Group& group : groups) {
    IntervalPlot::Row row;
    row.label = group.name;
    row.series = group.is_human ? 1 : 0;
    const Answer<Summary>& summary = group.ratios.*ratio;
    row.value = row.low = row.high = std::nan("");
    row.text = "no trial with a value";
    if (summary) {
      row.value = 100.0 * summary->median;
      row.low = 100.0 * summary->lower_quartile;
      row.high = 100.0 * summary->upper_quartile;
      row.text = FormatPercent(summary->median) + ", " + FormatCount(summary->count, "trial");
    }
    plot.rows.push_back(row);
  }
}

Html DrawFigure(const std::vector<Group>& groups) {
  IntervalPlot plot;
  plot.text.title = "GFT% and GOT% of humans and robots";
  plot.text.description = "Median of each group; the line spans its quartiles.";
  plot.axis = "share of the grasp closure time [%]";
  AddRows(groups, &TimingRatios::gft, "GFT%", plot);
  AddRows(groups, &TimingRatios::got, "GOT%", plot);
  return MakeFigure("GFT% and GOT%: median and quartiles over trials.",
                    "similarity of robot and human contact simultaneity.",
                    MakeScroll(plot.text.title, DrawIntervalPlot(plot)));
}

Html DrawTable(const std::vector<Group>& groups) {
  Table table("One function computes both groups; trials without a value are counted separately.",
              {"Group",
               "n",
               "GFT% median [%]",
               "GFT% quartiles [%]",
               "GOT% median [%]",
               "GOT% quartiles [%]",
               {"Without GFT%", "a digit never touched, or the closure took no time"}});
  for (const Group& group : groups) {
    const Answer<Summary>&gft = group.ratios.gft, &got = group.ratios.got;
    const auto median = [](const Answer<Summary>& s) {
      return Text(s ? FormatFixed(100.0 * s->median, 1) : "n/a");
    };
    const auto quartiles = [](const Answer<Summary>& s) {
      return Text(s ? FormatFixed(100.0 * s->lower_quartile, 1) + " to " +
                          FormatFixed(100.0 * s->upper_quartile, 1)
                    : "n/a");
    };
    table.AddRow({group.name, gft ? gft->count : 0, median(gft), quartiles(gft), median(got),
                  quartiles(got), group.ratios.num_without_gft});
  }
  return table.ToHtml();
}

std::vector<TrialTouches> ListTouches(const StudyResult& result) {
  std::vector<TrialTouches> touches;
  for (const StudyTrial& trial : result.trials) {
    if (!trial.IsKept()) continue;
    TrialTouches made = {trial.object, trial.analysis->closure_start.time, {}};
    for (const DigitContactEvents& digit : trial.analysis->contacts) {
      if (IsUnresolved(digit.contact)) continue;
      made.contacts.push_back({digit.digit, digit.is_thumb, digit.contact.time});
    }
    touches.push_back(std::move(made));
  }
  return touches;
}

/** Pairs this study's participants with the cells of the robot's schedules. */
PeopleFile MakePeople(const StudyPageData& data, const ScheduleComparison& robot) {
  PeopleFile people;
  people.study = data.result.study.config.name;
  const std::vector<TrialTouches> touches = ListTouches(data.result);
  for (const ScheduleCell& cell : robot.cells) {
    people.cells.push_back(cell.of);
    PeopleOnObject& of = people.cells.back();
    of.people = SummarisePeople(touches, of.object, of.digits);
  }
  return people;
}

/** Compares with a tolerance, because tables round the last digits that this page has in full. */
bool IsSame(const Answer<TouchLags>& a, const Answer<TouchLags>& b) {
  constexpr double kRounding = 1e-6;
  if (!a || !b) return !a && !b;
  if (a->shares.size() != b->shares.size()) return false;
  for (size_t i = 0; i < a->shares.size(); ++i) {
    const double x = a->shares[i].median, y = b->shares[i].median;
    if (x != y && !(std::abs(x - y) < kRounding)) return false;
  }
  return true;
}

/** Schedules derived from other participants do not belong to this study. */
bool IsOfStudy(const ScheduleComparison& comparison, const PeopleFile& people) {
  for (const ScheduleCell& cell : comparison.cells) {
    const PeopleOnObject* own = people.Find(cell.of.hand, cell.of.object, cell.of.grasp);
    if (own && !IsSame(own->people, cell.of.people)) return false;
  }
  return true;
}

Html DrawTimesBesidePeople(const StudyPageData& data) {
  const Session& session = data.robot->session;
  const SessionModels models = LoadSessionModels(session);
  std::vector<ScheduleComparison> shown;
  Html others;
  for (const ScheduleComparison& comparison : LoadSchedules(session)) {
    if (IsOfStudy(comparison, MakePeople(data, comparison))) {
      shown.push_back(comparison);
    } else {
      others += MakeParagraph("Not compared: the schedules in " + comparison.folder + " follow " +
                              (comparison.study.empty() ? "no study" : comparison.study) +
                              ", which belong to another study.");
    }
  }
  const Html heading = Element("h3", {}, "People and robots: order and times of contact");
  if (!shown.empty()) return heading + DrawSchedules(shown, models, data.robot->name) + others;
  const std::vector<ThresholdSummary> thresholds = LoadThresholds(session);
  const PeopleFile people = MakePeople(data, CompareSchedules(session, {}, thresholds));
  const bool has_people = std::any_of(people.cells.begin(), people.cells.end(),
                                      [](const PeopleOnObject& cell) { return bool(cell.people); });
  if (!has_people) {
    return heading + others +
           MakeParagraph("Not compared: " +
                         (people.cells.empty() ? "the camera chooses the grasps"
                                               : people.cells[0].people.reason()) +
                         ".");
  }
  return heading + DrawSchedules({}, models, data.robot->name) +
         DrawPeopleAndRobots(CompareSchedules(session, people, thresholds), models) + others;
}

Html DrawRobot(const StudyPageData& data) {
  if (data.robot == nullptr) {
    return MakeParagraph(
        "No robot session was named; --robot DIR, or robot: DIR in study.yaml, adds one.");
  }
  const std::vector<Group> groups = ListGroups(data);
  return MakeParagraph("Session: " + data.robot->name +
                       ". Closure starts at the widest opening for people and with the closing "
                       "command for robots; a robot closes at a speed set by its strategy, so "
                       "compare the ratios, not the times.") +
         DrawFigure(groups) + DrawTable(groups) + DrawTimesBesidePeople(data);
}

}  // namespace

StudySection robot_study_section() { return {"robot", "Humans beside robots", DrawRobot}; }

}  // namespace graspbench
