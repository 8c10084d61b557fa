#include "workbench/experiments/session_experiment.h"

#include <algorithm>
#include <map>
#include <optional>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "core/base/hash.h"
#include "datasets/analysis/conditions/threshold_summary.h"
#include "datasets/journal/append_file.h"
#include "datasets/session/session_experiments.h"
#include "datasets/shards/worker_log.h"
#include "workbench/experiments/machines/shell_quote.h"
#include "workbench/experiments/output_folder.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

constexpr char kThresholdKind[] = "thresholds";

/** Thresholds are those of a sweep's conditions, too. */
void CheckCanBeVaried(const Session& session, const std::string& kind) {
  if (session.records.empty()) {
    throw Error(ErrorKind::kUsage, "the session in \"" + session.folder.string() +
                                       "\" has no finished trial; graspbench run --resume --out " +
                                       QuoteForShell(session.folder.string()) + " runs them");
  }
  if (session.config.conditions.empty() || kind == kThresholdKind) return;
  throw Error(ErrorKind::kUsage, "the session in \"" + session.folder.string() +
                                     "\" has conditions of its own, so that it cannot be varied "
                                     "again; sweep more factors with graspbench sweep");
}

/** Lines of records and judgements as they stand in journals. */
class Adoption {
 public:
  explicit Adoption(const std::vector<PlannedTrial>& plan) {
    for (const PlannedTrial& planned : plan) planned_.emplace(planned.id, planned);
  }

  void Take(const Session& from) {
    for (size_t i = 0; i < from.records.size(); ++i) {
      const PlannedTrial& planned = from.records[i].plan;
      const auto wanted = planned_.find(planned.id);
      if (wanted == planned_.end() || !(wanted->second == planned)) continue;
      planned_.erase(wanted);
      trials_ += ReadLine(from.lines, from.lines.trials[i]) + "\n";
      const LinePlace& judgement = from.lines.judgements[i];
      if (judgement.file >= 0) judgements_ += ReadLine(from.lines, judgement) + "\n";
    }
  }

  void Write(const fs::path& folder) const {
    Write(folder / "journal", trials_);
    Write(folder / "judge", judgements_);
  }

 private:
  static void Write(const fs::path& folder, const std::string& lines) {
    if (lines.empty()) return;
    MakeFolder(folder);
    AppendFile(FindJournal(folder, 0, kMergedLabel)).Append(lines);
  }

  std::map<std::string, PlannedTrial> planned_;  // that are not found yet, by id
  std::string trials_, judgements_;
};

void CreateExperiment(const Session& session, const std::string& kind, const PreparedSession& made,
                      const std::vector<PlannedTrial>& plan) {
  StagedFolder staged({made.folder, "", false, {}});
  CreateSession(staged.path(), made.config, plan);
  // Trials of an experiment with delays say more than those of the session.
  if (!HasDelays(made.config)) {
    Adoption adoption(plan);
    adoption.Take(session);
    for (const Session& other : LoadExperiments(session, kind)) adoption.Take(other);
    adoption.Write(staged.path());
  }
  staged.Commit();
}

}  // namespace

PreparedSession PrepareExperiment(const ExperimentRequest& request, const std::string& kind,
                                  const ListConditions& list_conditions) {
  const Session session = LoadSession(request.folder, request.on_damage, RecordParts::kBrief);
  const std::vector<Condition> conditions = list_conditions(session.config);
  CheckCanBeVaried(session, kind);
  PreparedSession made;
  made.config = session.config;
  if (request.trials_per_cell > 0) {
    made.config.trials = std::min(made.config.trials, request.trials_per_cell);
  }
  made.config.conditions = conditions;
  made.inputs = LoadSessionInputs(made.config, FieldUse::kLater, session.folder);
  const bool is_sweep = !session.config.conditions.empty();
  CheckSameSession(
      session, session.config,
      MakePlan(session.config,
               is_sweep ? LoadSessionInputs(session.config, FieldUse::kLater, session.folder)
                        : made.inputs));
  const std::vector<PlannedTrial> plan = MakePlan(made.config, made.inputs);
  std::string ids;
  for (const PlannedTrial& planned : plan) ids += planned.id;
  made.folder = session.folder / kind / CalcHashHex(ids).substr(0, 8);
  if (!HasSession(made.folder)) CreateExperiment(session, kind, made, plan);
  if (request.plan_only) RecordPlanning(made.folder);
  made.session = LoadSession(made.folder, request.on_damage, RecordParts::kBrief);
  CheckSameSession(made.session, made.config, plan);
  return made;
}

PreparedSession PrepareThresholds(const ExperimentRequest& request, const ThresholdScale& scale) {
  return PrepareExperiment(request, kThresholdKind, [&scale](const SessionConfig& config) {
    return ListThresholdGrips(scale, config);
  });
}

bool RunExperiment(const PreparedSession& experiment, const ExperimentRequest& request,
                   int num_workers, Observer& observer, const std::atomic<bool>& stop) {
  const RoundKind& round = FindTrialRound(experiment.config);
  std::optional<PreparedSession> next;  // a bisection asks for more
  for (const PreparedSession* now = &experiment; !round.find_left(now->session).empty();) {
    if (RunRound(round, *now, num_workers, observer, stop, request.trial_time_limit).ending !=
        RunEnding::kFinished) {
      return false;
    }
    if (&round != &kThresholdRound) break;
    if (!next) next = experiment;
    next->session = LoadSession(experiment.folder, request.on_damage, RecordParts::kBrief);
    now = &*next;
  }
  return !request.with_judge || JudgeSession(experiment.folder, num_workers, observer, stop,
                                             request.on_damage, request.trial_time_limit);
}

}  // namespace graspbench
