#include "datasets/analysis/timing_groups.h"

#include "datasets/analysis/session_summary.h"

namespace graspbench {

TimingRatios SummariseTimings(const std::vector<ContactTiming>& timings) {
  std::vector<double> gft, got;
  for (const ContactTiming& timing : timings) {
    gft.push_back(timing.gft_ratio);
    got.push_back(timing.got_ratio);
  }
  TimingRatios ratios = {CalcSummary(gft), CalcSummary(got), 0};
  const int num_with_gft = ratios.gft ? ratios.gft->count : 0;
  ratios.num_without_gft = static_cast<int>(timings.size()) - num_with_gft;
  return ratios;
}

std::vector<TimingGroup> ListTimingGroups(const Session& session) {
  const SessionSummary summary = SummariseSession(session);
  std::vector<TimingGroup> groups;
  for (const std::string& hand : summary.hands) {
    std::vector<ContactTiming> all;
    std::vector<TimingGroup> by_grasp;
    for (const std::string& grasp : summary.grasps) {
      std::vector<ContactTiming> timings;
      for (const TrialRecord& record : session.records) {
        if (record.plan.hand != hand || record.plan.grasp != grasp) continue;
        if (record.result.outcome == Outcome::kNumericalFailure) continue;
        timings.push_back(record.result.timing);
      }
      if (timings.empty()) continue;
      by_grasp.push_back({hand, grasp, SummariseTimings(timings)});
      all.insert(all.end(), timings.begin(), timings.end());
    }
    // One grasp is all there is: said once, by its name.
    if (by_grasp.size() != 1) groups.push_back({hand, "", SummariseTimings(all)});
    groups.insert(groups.end(), by_grasp.begin(), by_grasp.end());
  }
  return groups;
}

}  // namespace graspbench
