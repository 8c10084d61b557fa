#include "workbench/experiments/session_experiment.h"

#include <algorithm>
#include <chrono>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "core/base/hash.h"
#include "core/base/random.h"
#include "datasets/analysis/conditions/threshold_summary.h"
#include "datasets/journal/append_file.h"
#include "datasets/plan/map_design.h"
#include "datasets/session/find_trial.h"
#include "datasets/shards/worker_log.h"
#include "workbench/experiments/machines/shell_quote.h"
#include "workbench/experiments/output_folder.h"
#include "workbench/experiments/pool/batch_runner.h"

namespace graspbench {

namespace fs = std::filesystem;

namespace {

constexpr char kThresholdKind[] = "thresholds";
constexpr double kJudgeTrials = 5.0;  // what the judge takes, in trials

/** Thresholds are those of a sweep's conditions, too. */
void CheckCanBeVaried(const Session& session, const std::string& kind) {
  if (session.records.empty()) {
    throw Error(ErrorKind::kUsage, "the session in \"" + session.folder.string() +
                                       "\" has no finished trial; graspbench run --resume --out " +
                                       QuoteForShell(session.folder.string()) + " runs them");
  }
  if (session.config.conditions.empty() || kind == kThresholdKind) return;
  throw Error(ErrorKind::kUsage, "the session in \"" + session.folder.string() +
                                     "\" already has conditions and cannot be varied again; use "
                                     "more factors in graspbench sweep");
}

/** Lines of the plan's trials as they stand in the journals of other sessions, of each trial the
first. */
void AdoptRecords(const std::vector<Session>& sessions, const std::vector<PlannedTrial>& plan,
                  const fs::path& folder) {
  std::map<std::string, PlannedTrial> missing;
  for (const PlannedTrial& planned : plan) missing.emplace(planned.id, planned);
  std::string trials, judgements;
  for (const Session& from : sessions) {
    for (size_t i = 0; i < from.records.size(); ++i) {
      const auto wanted = missing.find(from.records[i].plan.id);
      if (wanted == missing.end() || !(wanted->second == from.records[i].plan)) continue;
      missing.erase(wanted);
      trials += ReadLine(from.lines, from.lines.trials[i]) + "\n";
      const LinePlace& judgement = from.lines.judgements[i];
      if (judgement.file >= 0) judgements += ReadLine(from.lines, judgement) + "\n";
    }
  }
  for (const auto& [name, lines] : {std::pair("journal", trials), std::pair("judge", judgements)}) {
    if (lines.empty()) continue;
    MakeFolder(folder / name);
    AppendFile(FindJournal(folder / name, 0, kMergedLabel)).Append(lines);
  }
}

void CreateExperiment(const Session& session, const std::string& kind, const PreparedSession& made,
                      const std::vector<PlannedTrial>& plan) {
  StagedFolder staged({made.folder, "", false, {}});
  const auto chooses_again = [](const Condition& one) { return ChoosesGraspAgain(one); };
  if (std::any_of(made.config.conditions.begin(), made.config.conditions.end(), chooses_again)) {
    CopyRehearsed(made.inputs, staged.path());
  }
  CreateSession(staged.path(), made.config, plan);
  // Trials of an experiment with delays say more than those of the session.
  if (!HasDelays(made.config)) {
    std::vector<Session> known = LoadExperiments(session, kind);
    known.insert(known.begin(), session);
    AdoptRecords(known, plan, staged.path());
  }
  staged.Commit();
}

/** Some of the objects, dealt by the seed, in their order; all where there are no more. */
std::vector<std::string> DealObjects(const SessionInputs& inputs,
                                     const std::vector<std::string>& names, int count, int seed) {
  std::vector<std::string> objects = names;
  if (names == SessionConfig().objects) {
    objects.clear();
    for (const auto& object : inputs.objects) objects.push_back(object->id);
  }
  RandomStream random(std::to_string(seed), "objects of a map");
  while (static_cast<int>(objects.size()) > count) {
    objects.erase(objects.begin() + random.NextIndex(static_cast<int>(objects.size())));
  }
  return objects;
}

/** Copies of one body would count as so many objects to draw from. @throws Error(kUsage). */
void CheckObjectsDiffer(const SessionInputs& inputs) {
  std::map<std::string, std::string> ids;
  for (const auto& object : inputs.objects) {
    const auto [first, is_new] = ids.emplace(object->content_hash, object->id);
    if (is_new) continue;
    throw Error(ErrorKind::kUsage,
                "the objects \"" + first->second + "\" and \"" + object->id +
                    "\" are the same body (mesh, mass and surface); a map resamples objects, so "
                    "copies would narrow the intervals falsely: leave one of them out");
  }
}

/** The session of a part of a map, made or found. */
PreparedSession PreparePart(const MapRequest& request, const MapPart& part,
                            const SessionConfig& base, const fs::path& out) {
  SessionRequest session;
  session.config = MakeMapSession(part, base);
  session.name = "map";
  session.out = out;
  session.resume = HasSession(out);
  session.on_damage = request.on_damage;
  return PrepareSession(session);
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
  for (const Condition& condition : conditions) ids += ChoosesGraspAgain(condition) ? " again" : "";
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
                   Observer& observer) {
  const RoundKind& round = FindTrialRound(experiment.config);
  std::optional<PreparedSession> next;  // a bisection asks for more
  for (const PreparedSession* now = &experiment; !round.find_left(now->session).empty();) {
    if (RunRound(round, *now, request.num_workers, observer, request.trial_time_limit).ending !=
        RunEnding::kFinished) {
      return false;
    }
    if (&round != &kThresholdRound) break;
    if (!next) next = experiment;
    next->session = LoadSession(experiment.folder, request.on_damage, RecordParts::kBrief);
    now = &*next;
  }
  if (request.with_judge && !JudgeSession(experiment.folder, request.num_workers, observer,
                                          request.on_damage, request.trial_time_limit)
                                 .is_complete) {
    return false;
  }
  if (!request.thresholds) return true;
  ExperimentRequest grips = request;
  grips.folder = experiment.folder;
  grips.trials_per_cell = 0;
  grips.with_judge = false;
  grips.thresholds = nullptr;
  return RunExperiment(PrepareThresholds(grips, *request.thresholds), grips, observer);
}

double EstimateSweepTime(const PreparedSession& sweep, bool with_judge, bool with_thresholds) {
  std::map<std::string, double> times;
  TrialBench bench;
  const FindPolicy find_policy = MakeLivePolicies();
  double sum = 0.0;
  for (const PlannedTrial& planned : FindUnfinished(sweep.session)) {
    if (times.count(planned.hand) == 0) {
      TrialSetup setup = MakeTrialSetup(sweep.config, sweep.inputs, planned);
      setup.controller = find_policy(setup, planned);
      TrialRunner& runner = bench.Prepare(setup);
      const auto start = std::chrono::steady_clock::now();
      runner.Run(setup);
      times[planned.hand] =
          std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }
    sum += times[planned.hand];
  }
  return sum *
         (1.0 + (with_judge ? kJudgeTrials : 0.0) + (with_thresholds ? kMostThresholdTrials : 0.0));
}

PreparedSession PrepareMap(const MapRequest& request) {
  CheckObjectsDiffer(LoadSessionInputs(request.base, FieldUse::kLater));
  return PreparePart(request, ListMapParts(request.is_quick).front(), request.base, request.out);
}

bool RunMap(const PreparedSession& success, const MapRequest& request, Observer& observer) {
  for (const MapPart& part : ListMapParts(request.is_quick)) {
    ExperimentRequest rest;
    rest.with_judge = part.with_judge;
    if (part.with_thresholds) {
      rest.thresholds = &RowFromName(kThresholdScales, "margin", "threshold");
    }
    rest.on_damage = request.on_damage;
    rest.trial_time_limit = request.trial_time_limit;
    rest.num_workers = request.num_workers;
    std::optional<PreparedSession> below;
    if (!part.varies_grip) {
      SessionConfig base = request.base;
      if (part.most_objects > 0) {
        base.objects = DealObjects(success.inputs, base.objects, part.most_objects, base.seed);
      }
      below = PreparePart(request, part, base, success.folder / "map" / part.id);
    }
    if (!RunExperiment(below ? *below : success, rest, observer)) return false;
  }
  return true;
}

}  // namespace graspbench
