#include <algorithm>
#include <cmath>

#include "core/base/text/text.h"
#include "human_study/study/run/trial_removal.h"
#include "reports/study/study_format.h"
#include "reports/study/trial_figures.h"

namespace graspbench {
namespace {

/** Each trial adds about 10 kB to the page. */
constexpr size_t kMaxDrawn = 100;

/** Puts the trials that need review first and otherwise keeps the order of the plan. */
std::vector<const StudyTrial*> ChooseTrials(const StudyResult& result) {
  std::vector<const StudyTrial*> trials;
  for (const StudyTrial& trial : result.trials) {
    if (trial.analysis) trials.push_back(&trial);
  }
  if (trials.size() <= kMaxDrawn) return trials;
  std::stable_partition(trials.begin(), trials.end(), [](const StudyTrial* trial) {
    return !trial->IsKept() || !FormatFlags(*trial->analysis).empty();
  });
  trials.resize(kMaxDrawn);
  return trials;
}

Html DrawTrials(const StudyPageData& data) {
  const std::vector<const StudyTrial*> trials = ChooseTrials(data.result);
  if (trials.empty()) return MakeParagraph("No trial could be analysed.");
  std::string text =
      "Each trial shows the hand opening (or the wrist speed if the onset caused the removal) and "
      "one row per digit: the bar is the accepted contact, each sign the result of another "
      "detector. events.csv lists all events.";
  if (trials.size() == kMaxDrawn && data.result.trials.size() > kMaxDrawn) {
    text += " Drawn are " + std::to_string(kMaxDrawn) + " of " +
            std::to_string(data.result.trials.size()) +
            " trials, removed and flagged trials first.";
  }
  const MovementOptions& movement = data.result.study.config.analysis.movement;
  Html html = MakeParagraph(text);
  for (const StudyTrial* trial : trials) {
    const std::string anchor = MakePlainKey({"trial", trial->participant, trial->trial});
    html += Element("div", {{"id", anchor}},
                    MakeDetails(DescribeTrial(*trial, data.result.study.factors),
                                Element("div", {{"class", "pair"}},
                                        Element("div", {}, DrawDecidingCurve(*trial, movement)) +
                                            Element("div", {}, DrawTrialContacts(*trial)))));
  }
  return html;
}

}  // namespace

StudySection trials_study_section() { return {"trials", "Trial by trial", DrawTrials}; }

}  // namespace graspbench
