#include <algorithm>

#include "datasets/plan/grasp_choice.h"
#include "reports/page/layout.h"
#include "reports/sections/section.h"

namespace graspbench {
namespace {

/** An experiment that would add to this page. */
struct Experiment {
  bool is_done;
  const char* command;
  const char* adds;
};

std::vector<Experiment> ListExperiments(const ReportData& data) {
  const SessionConfig& config = data.session.config;
  const SessionConfig defaults;
  const auto& records = data.session.records;
  const bool is_judged = std::any_of(records.begin(), records.end(),
                                     [](const TrialRecord& record) { return record.judgement; });
  const bool is_sensed = config.positioning != defaults.positioning ||
                         config.touch != defaults.touch || NeedsCamera(config);
  return {{is_judged, "graspbench judge DIR", "breaking forces"},
          {!data.thresholds.empty(), "graspbench threshold DIR", "grip thresholds"},
          {!data.sensitivity.changes.empty(), "graspbench sensitivity DIR",
           "effect of unmeasured parameters"},
          {!data.numerics.empty(), "graspbench check-numerics DIR",
           "effect of time step and stiffness"},
          {is_sensed, "graspbench run --set positioning=camera --set touch=sensed",
           "camera and tactile elements"},
          {!data.views.body.empty(), "graspbench report DIR --3d", "interactive 3-D scenes"}};
}

Html DrawNotRun(const ReportData& data) {
  Html list;
  for (const Experiment& experiment : ListExperiments(data)) {
    if (experiment.is_done) continue;
    list += Text(list.empty() ? "Not run for this session: " : "; ") +
            Element("code", {}, experiment.command) +
            Text(std::string(" (") + experiment.adds + ")");
  }
  return list.empty() ? list : Element("p", {}, list + Text("."));
}

}  // namespace

Section not_run_section() { return {"further", "Further experiments", DrawNotRun}; }

}  // namespace graspbench
