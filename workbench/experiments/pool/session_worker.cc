#include "workbench/experiments/pool/session_worker.h"

#include <algorithm>
#include <memory>

#include "core/base/error.h"
#include "core/trial/judge/verdicts.h"

namespace graspbench {
namespace {

void CheckSameResult(const Session& session, const PlannedTrial& planned,
                     const TrialResult& result) {
  const auto record =
      std::find_if(session.records.begin(), session.records.end(),
                   [&](const TrialRecord& candidate) { return candidate.plan == planned; });
  if (ToJson(LoadWhole(session, *record).result) == ToJson(result)) return;
  throw Error(ErrorKind::kVersion, "trial " + planned.id + " (" + DescribeTrial(planned) +
                                       ") gives another result than its record: the session was "
                                       "run by another build or on another machine; run it again "
                                       "to judge it");
}

}  // namespace

MakeBatchWorker MakeSessionWorkers(const Session& session, const SessionInputs& inputs,
                                   const std::filesystem::path& folder, const std::string& label) {
  return [&session, &inputs, folder, label](int worker) {
    const auto runner = std::make_shared<PlannedTrialRunner>(session.config, inputs);
    const auto journal = std::make_shared<JournalWriter>(folder, worker, label);
    return BatchWorker{[runner](const PlannedTrial& planned) { return runner->Run(planned); },
                       [journal](const TrialRecord& record) { journal->Append(record); },
                       {},
                       [runner](const PlannedTrial& planned) { runner->Prepare(planned); }};
  };
}

MakeBatchWorker MakeJudgeWorkers(const Session& session, const SessionInputs& inputs,
                                 const std::filesystem::path& folder, const std::string& label) {
  return [&session, &inputs, folder, label](int worker) {
    const auto runner = std::make_shared<PlannedTrialRunner>(session.config, inputs);
    const auto writer = std::make_shared<JudgementWriter>(folder, worker, label);
    const auto judgement = std::make_shared<Judgement>();  // of the trial that has just run
    const auto judge = [runner, judgement](const PlannedTrial& planned) {
      JudgedTrial trial = runner->Judge(planned);
      *judgement = trial.judgement ? *trial.judgement : MakeEmptyHandJudgement();
      return trial.result;
    };
    const auto keep = [&session, writer, judgement](const TrialRecord& record) {
      CheckSameResult(session, record.plan, record.result);
      writer->Append(record.plan.id, *judgement);
    };
    // Nothing is known of a grasp whose test does not end: it stays unjudged.
    return BatchWorker{judge, keep, [](const TrialRecord&) {},
                       [runner](const PlannedTrial& planned) { runner->Prepare(planned); }};
  };
}

}  // namespace graspbench
