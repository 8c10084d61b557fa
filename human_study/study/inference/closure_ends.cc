#include "human_study/study/inference/closure_ends.h"

#include <cmath>

#include "core/statistics/summary.h"
#include "human_study/study/run/run_study.h"

namespace graspbench {
namespace {

struct EndRow {
  const char* id;
  const char* text;
  double (*end)(const TrialAnalysis&);  ///< [s] on the recording's clock; NaN: none
};

constexpr EndRow kEnds[] = {
    {"contact", "all digits touch",
     [](const TrialAnalysis& trial) { return trial.closure_start.time + trial.timing_all.gct; }},
    {"object", "the object has moved by lift_off.displacement_m (default 2 mm)",
     [](const TrialAnalysis& trial) { return trial.object.moved.time; }},
    {"speed", "fingertips are slow against the object",
     [](const TrialAnalysis& trial) { return trial.hold.IsFound() ? trial.hold.begin : kUnset; }}};

}  // namespace

std::vector<ClosureEnd> ListClosureEnds(const std::vector<StudyTrial>& trials) {
  std::vector<ClosureEnd> ends;
  for (const EndRow& row : kEnds) {
    std::vector<double> times, after_contact;
    for (const StudyTrial& trial : trials) {
      if (!trial.IsKept() || !trial.analysis) continue;
      const double time = row.end(*trial.analysis) - trial.analysis->closure_start.time;
      if (!std::isfinite(time)) continue;
      times.push_back(time);
      const double after = time - trial.analysis->timing_all.gct;
      if (std::isfinite(after)) after_contact.push_back(after);
    }
    ClosureEnd end = {row.id, row.text};
    end.num_trials = static_cast<int>(times.size());
    if (const Answer<Summary> summary = CalcSummary(times)) {
      end.lower_quartile = summary->lower_quartile;
      end.median = summary->median;
      end.upper_quartile = summary->upper_quartile;
    }
    if (!after_contact.empty()) end.median_after_contact = CalcMedian(after_contact);
    ends.push_back(end);
  }
  return ends;
}

}  // namespace graspbench
