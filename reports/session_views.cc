#include "reports/session_views.h"

#include <algorithm>

#include "core/base/error.h"
#include "core/base/text/text.h"
#include "datasets/records/trial_record.h"
#include "datasets/session/find_trial.h"
#include "reports/page/layout.h"
#include "reports/page/models.h"
#include "reports/scenes/cell_pictures.h"

namespace graspbench {
namespace {

constexpr size_t kMaxBytes = 20'000'000;  // of the views; the limit of the whole page is 25 MB

struct ChosenTrial {
  const TrialRecord* record = nullptr;
  std::shared_ptr<const Hand> hand;
  std::shared_ptr<const GraspObject> object;
  std::string name;
};

/** Lists every failure and one success of each condition. Failures come first, because the space is
limited. */
std::vector<ChosenTrial> ChooseViewedTrials(const Session& session, const SessionSummary& summary,
                                            const SessionModels& models) {
  std::vector<ChosenTrial> chosen;
  for (const CellSummary& cell : summary.cells) {
    const auto hand = models.FindHand(cell.hand);
    const auto object = models.FindObject(cell.object);
    if (!hand || !object || !IsDrawnInFull(cell, summary)) continue;
    const auto add = [&](const TrialRecord* record) {
      chosen.push_back(
          {record, hand, object,
           NameOfCell(cell, models) + ", trial " + std::to_string(record->plan.trial)});
    };
    for (const TrialRecord* record : ChooseTrialPerOutcome(cell, *hand, session)) {
      if (IsSuccess(record->result.outcome)) add(record);
    }
    for (const TrialRecord* record : ChooseShownTrials(cell, summary)) {
      if (!IsSuccess(record->result.outcome)) add(record);
    }
  }
  std::stable_partition(chosen.begin(), chosen.end(), [](const ChosenTrial& trial) {
    return !IsSuccess(trial.record->result.outcome);
  });
  return chosen;
}

Html DrawAgreement(const TrialResult& recorded, const TrialResult& now) {
  const auto difference = FindFirstDifference(recorded, now);
  if (!difference) return {};
  return MakeNote(
      "warning", "Not as recorded",
      MakeParagraph("The re-simulated trial differs from its record in " + difference->field +
                    ": recorded " + difference->recorded + ", now " + difference->now + "."));
}

}  // namespace

bool HasSessionViews(std::string_view page) {
  return page.find("class=\"scene-3d\"") != std::string_view::npos;
}

SessionViews DrawSessionViews(const Session& session, const SessionSummary& summary,
                              const SessionModels& models, const TrialTracer& trace) {
  const std::vector<ChosenTrial> chosen = ChooseViewedTrials(session, summary, models);
  TrialViews views;
  Html list;
  size_t num_shown = 0;
  for (const ChosenTrial& trial : chosen) {
    if (list.markup().size() > kMaxBytes) break;
    ++num_shown;
    const std::string outcome = WordsOf(trial.record->result.outcome);
    Html content;
    try {
      TracedTrial traced = trace(trial.record->plan);
      content = DrawAgreement(LoadWhole(session, *trial.record).result, traced.result);
      content += views.Add({trial.hand, trial.object, std::move(traced),
                            MakeViewAnchor(trial.record->plan), trial.name});
    } catch (const Error& fault) {
      content = MakeNote("warning", "No course", MakeParagraph(fault.what()));
    }
    list += MakeDetails(trial.name + ": " + outcome, content);
  }
  if (list.empty()) return {};
  Html body = MakeParagraph(
      "All failed trials and one success per condition, re-simulated: picture, forces at the end "
      "of each phase, curves; with scripts enabled, an interactive 3-D scene.");
  if (num_shown < chosen.size()) {
    body += MakeParagraph(
        "The first " + std::to_string(num_shown) + " of " +
        FormatCount(static_cast<int64_t>(chosen.size()), "trial") +
        ", as many as fit on a page; any other: graspbench trial DIR TRIAL --page trial.html");
  }
  return {body + list + views.MakeModels(), views.MakeScript()};
}

}  // namespace graspbench
