#include <cmath>

#include "core/base/text.h"
#include "core/statistics/summary.h"
#include "reports/line_plot.h"
#include "reports/models.h"
#include "reports/session_summary.h"
#include "reports/study/study_format.h"
#include "reports/study/study_section.h"

namespace graspbench {
namespace {

/** Ratios of one group of trials; humans and robots alike. */
struct Group {
  std::string name;
  std::vector<double> gft_ratio, got_ratio;
  bool is_human = true;

  void Add(const ContactTiming& timing) {
    gft_ratio.push_back(timing.gft_ratio);
    got_ratio.push_back(timing.got_ratio);
  }
};

std::vector<Group> ListGroups(const StudyPageData& data) {
  std::vector<Group> groups;
  Group all{"humans, all trials", {}, {}, true};
  for (const StudyTrial& trial : data.result.trials) {
    if (trial.IsKept()) all.Add(trial.analysis->timing);
  }
  groups.push_back(all);
  const Session& session = data.robot->session;
  const SessionSummary summary = SummariseSession(session);
  const SessionModels models = LoadSessionModels(session);
  for (const std::string& hand : summary.hands) {
    const size_t first = groups.size();
    groups.push_back({models.NameOfHand(hand) + ", all trials", {}, {}, false});
    int num_grasps = 0;
    for (const std::string& grasp : summary.grasps) {
      Group group{models.NameOfHand(hand) + ", " + NameOfGrasp(grasp), {}, {}, false};
      for (const TrialRecord& record : session.records) {
        if (record.plan.hand != hand || record.plan.grasp != grasp) continue;
        if (record.result.outcome == Outcome::kNumericalFailure) continue;
        groups[first].Add(record.result.timing);
        group.Add(record.result.timing);
      }
      if (group.gft_ratio.empty()) continue;
      groups.push_back(group);
      ++num_grasps;
    }
    // One grasp is all there is: said once, by its name.
    if (num_grasps == 1) groups.erase(groups.begin() + static_cast<std::ptrdiff_t>(first));
  }
  return groups;
}

void AddRows(const std::vector<Group>& groups, std::vector<double> Group::*ratio, const char* name,
             IntervalPlot& plot) {
  IntervalPlot::Row heading;
  heading.label = name;
  heading.is_heading = true;
  plot.rows.push_back(heading);
  for (const Group& group : groups) {
    IntervalPlot::Row row;
    row.label = group.name;
    row.series = group.is_human ? 1 : 0;
    const Answer<Summary> summary = CalcSummary(group.*ratio);
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
  AddRows(groups, &Group::gft_ratio, "GFT%", plot);
  AddRows(groups, &Group::got_ratio, "GOT%", plot);
  return MakeFigure("GFT% and GOT%: median and quartiles over trials.",
                    "how near the robot's fingers come to closing together as people's do.",
                    MakeScroll(plot.text.title, DrawIntervalPlot(plot)));
}

Html DrawTable(const std::vector<Group>& groups) {
  const Align number = Align::kNumber;
  Table table("The same function computes both; trials without a value are counted apart.",
              {{"Group"},
               {"n", number},
               {"GFT% median [%]", number},
               {"GFT% quartiles [%]", number},
               {"GOT% median [%]", number},
               {"GOT% quartiles [%]", number},
               {"Without GFT%", number, "a digit never touched, or the closure took no time"}});
  for (const Group& group : groups) {
    const Answer<Summary> gft = CalcSummary(group.gft_ratio), got = CalcSummary(group.got_ratio);
    const auto median = [](const Answer<Summary>& s) {
      return Text(s ? FormatFixed(100.0 * s->median, 1) : "n/a");
    };
    const auto quartiles = [](const Answer<Summary>& s) {
      return Text(s ? FormatFixed(100.0 * s->lower_quartile, 1) + " to " +
                          FormatFixed(100.0 * s->upper_quartile, 1)
                    : "n/a");
    };
    const int count = gft ? gft->count : 0;
    table.AddRow({Text(group.name), Text(std::to_string(count)), median(gft), quartiles(gft),
                  median(got), quartiles(got),
                  Text(std::to_string(static_cast<int>(group.gft_ratio.size()) - count))});
  }
  return table.ToHtml();
}

Html Draw(const StudyPageData& data) {
  if (data.robot == nullptr) {
    return MakeParagraph(
        "No robot session was named. --robot DIR, or robot: DIR in study.yaml, puts one beside "
        "the people.");
  }
  const std::vector<Group> groups = ListGroups(data);
  return MakeParagraph("Session: " + data.robot->name +
                       ". Closure starts at the widest opening for people and with the closing "
                       "command for robots; a robot closes at a speed set by its strategy, so "
                       "compare the ratios, not the times.") +
         DrawFigure(groups) + DrawTable(groups);
}

}  // namespace

StudySection robot_study_section() { return {"robot", "Humans beside robots", Draw}; }

}  // namespace graspbench
