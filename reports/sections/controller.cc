#include <algorithm>
#include <map>

#include "core/base/text/text.h"
#include "reports/page/layout.h"
#include "reports/sections/section.h"

namespace graspbench {
namespace {

/** Counts of controller actions in the trials of one hand. */
struct ControllerCounts {
  int num_trials = 0, num_done = 0, num_wrong = 0, num_questions = 0, num_cut = 0;
  std::map<std::string, int> faults;
};

Html DrawController(const ReportData& data) {
  const PolicyConfig& policy = data.session.config.policy;
  std::map<std::string, ControllerCounts> hands;
  for (const TrialRecord& record : data.session.records) {
    if (!record.result.policy) continue;
    const PolicyRecord& taken = *record.result.policy;
    ControllerCounts& counts = hands[record.plan.hand];
    ++counts.num_trials;
    counts.num_done += taken.said_done;
    counts.num_questions += taken.num_questions;
    counts.num_cut += taken.num_cut;
    if (!taken.fault) continue;
    ++counts.num_wrong;
    ++counts.faults[*taken.fault];
  }
  Html html =
      Element("p", {},
              Text("A controller closed the digits: ") + Element("code", {}, policy.command) +
                  Text(". Object pose given to it: " + policy.object_pose +
                       ". Control period: " + FormatSignificant(1e3 * policy.period, 3) +
                       " ms for " + FormatCount(policy.execute_steps, "row") + ", for at most " +
                       FormatSignificant(policy.time, 3) + " s."));
  Table table("Actions of the controller, by hand.",
              {"Hand",
               {"Trials", "finished"},
               {"Questions", "per trial, mean"},
               {"Said done", "trials; the others ended by the time limit or with the trial"},
               {"Targets cut", "mean per trial, beyond joint limits"},
               {"Wrong answers", "trials that ended with one"},
               "Most frequent fault"});
  for (const std::string& hand : data.summary.hands) {
    const ControllerCounts& counts = hands[hand];
    if (counts.num_trials == 0) continue;
    const auto most =
        std::max_element(counts.faults.begin(), counts.faults.end(),
                         [](const auto& a, const auto& b) { return a.second < b.second; });
    const auto mean = [&](int sum) {
      return FormatFixed(static_cast<double>(sum) / counts.num_trials, 1);
    };
    table.AddRow({data.models.NameOfHand(hand), counts.num_trials, mean(counts.num_questions),
                  counts.num_done, mean(counts.num_cut), counts.num_wrong,
                  most == counts.faults.end() ? std::string("-") : most->first});
  }
  return html + table.ToHtml() +
         Element("p", {},
                 Text("Comparison with another controller or the strategy on the same draws: ") +
                     Element("code", {}, "graspbench compare OTHER THIS") + Text("."));
}

}  // namespace

Section controller_section() { return {"controller", "Controller", DrawController}; }

}  // namespace graspbench
