#include "workbench/experiments/delay_sweep.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>

#include "core/base/config.h"
#include "core/base/error.h"
#include "core/trial/delayed_digit.h"
#include "core/trial/judge/disturbance.h"
#include "workbench/experiments/pool/batch_runner.h"
#include "workbench/experiments/pool/session_worker.h"

namespace graspbench {
namespace {

constexpr const char* kLateDigits[] = {"last", "first"};
constexpr double kMassShare = 0.25, kFrictionShare = 0.7, kOffsetFactor = 2.0;

/** What one run of a condition is. */
struct SweepRun {
  PlannedTrial planned;
  std::string late;   ///< "last", "first"; empty: none
  std::string digit;  ///< its id
  double delay = 0.0;
  double closure_start = kUnset;  ///< of the same trial without delay [s]
};

/** The digit that touched last, or first, of those that touched; empty with fewer than two. */
std::string FindDigit(const std::vector<DigitContact>& contacts, bool is_last) {
  const DigitContact* found = nullptr;
  int num_touched = 0;
  for (const DigitContact& contact : contacts) {
    if (std::isnan(contact.time)) continue;
    ++num_touched;
    if (!found || (contact.time > found->time) == is_last) found = &contact;
  }
  return num_touched < 2 ? "" : std::string(found->digit);
}

int FindDigitIndex(const Hand& hand, const std::string& id) {
  const auto found = std::find_if(hand.digits.begin(), hand.digits.end(),
                                  [&id](const Digit& digit) { return digit.id == id; });
  return static_cast<int>(found - hand.digits.begin());
}

/** NaN when it was not reached. */
double FindClosureStart(const TrialResult& result) {
  for (const SceneSnapshot& snapshot : result.snapshots) {
    if (snapshot.moment == Moment::kPreGrasp) return snapshot.time;
  }
  return kUnset;
}

std::vector<PlannedTrial> ChooseFirst(const std::vector<PlannedTrial>& plan, int trials_per_cell) {
  std::vector<PlannedTrial> chosen;
  std::copy_if(plan.begin(), plan.end(), std::back_inserter(chosen),
               [=](const PlannedTrial& planned) { return planned.trial < trials_per_cell; });
  return chosen;
}

/** The runs of one condition. */
class ConditionSweep {
 public:
  ConditionSweep(const Session& session, const SweepCondition& condition, bool with_judge)
      : with_judge_(with_judge), config_(session.config) {
    for (const std::string& setting : condition.settings) ApplySetting(setting, config_);
    CheckSessionConfig(config_);
    inputs_ = LoadSessionInputs(config_, FieldUse::kLater, session.folder);
    plan_ = MakePlan(config_, inputs_);
  }

  const std::vector<PlannedTrial>& plan() const { return plan_; }

  /** What the runs gave, in their order. */
  std::vector<DelayedTrial> Run(const std::string& stage_name, const std::vector<SweepRun>& runs,
                                int num_workers, Observer& observer,
                                const std::atomic<bool>& stop) const {
    std::vector<PlannedTrial> tasks;
    for (const SweepRun& run : runs) {
      tasks.push_back(run.planned);
      tasks.back().id = std::to_string(tasks.size() - 1);
    }
    // Each run writes to its own place, so the workers need no lock.
    std::vector<DelayedTrial> trials(runs.size());
    const MakeBatchWorker make_worker = [&](int) {
      const auto runner = std::make_shared<SetupRunner>();
      const auto run_task = [&, runner](const PlannedTrial& task) {
        const size_t index = std::stoul(task.id);
        trials[index] = Simulate(runs[index], *runner);
        return trials[index].record.result;
      };
      return BatchWorker{run_task, [](const TrialRecord&) {}};
    };
    Stage stage;
    stage.kind = StageKind::kVariant;
    stage.variant = stage_name;
    stage.num_all = stage.num_left = stage.num_trials = static_cast<int>(runs.size());
    if (!RunBatchStage(stage, tasks, num_workers, make_worker, observer, stop)) {
      throw Error(ErrorKind::kInterrupted, "stopped; nothing was written");
    }
    return trials;
  }

 private:
  DelayedTrial Simulate(const SweepRun& run, SetupRunner& runner) const {
    TrialSetup setup = MakeTrialSetup(config_, inputs_, run.planned);
    if (!run.late.empty()) {
      const int digit = FindDigitIndex(*setup.hand, run.digit);
      setup = DelayDigit(std::move(setup), run.closure_start, digit, run.delay);
    }
    TracedTrial traced = runner.Trace(setup, 0.0);
    DelayedTrial trial;
    trial.digit = run.late;
    trial.delay = run.delay;
    trial.closing = CalcClosingDisplacement(traced.trace);
    trial.record = {run.planned, std::move(traced.result)};
    if (with_judge_) trial.record.judgement = runner.Judge(setup).judgement;
    return trial;
  }

  bool with_judge_;
  SessionConfig config_;
  SessionInputs inputs_;
  std::vector<PlannedTrial> plan_;
};

/** Trial by trial, so that a worker keeps its world. */
std::vector<SweepRun> ListDelayedRuns(const std::vector<DelayedTrial>& baseline) {
  std::vector<SweepRun> runs;
  for (const DelayedTrial& trial : baseline) {
    const double closure_start = FindClosureStart(trial.record.result);
    if (std::isnan(closure_start)) continue;
    for (const char* late : kLateDigits) {
      const std::string digit = FindDigit(trial.record.result.contacts, late == kLateDigits[0]);
      if (digit.empty()) continue;
      for (const double delay : ListDelays()) {
        if (delay > 0.0) runs.push_back({trial.record.plan, late, digit, delay, closure_start});
      }
    }
  }
  return runs;
}

}  // namespace

std::vector<SweepCondition> ListSweepConditions(const SessionConfig& config) {
  const auto set = [](const char* key, double value) {
    return std::vector<std::string>{std::string(key) + "=" + FormatJson(value)};
  };
  return {{"as run", {}},
          {"light", set("model.mass_scale", kMassShare * config.model.mass_scale)},
          {"slippery", set("model.friction_scale", kFrictionShare * config.model.friction_scale)},
          {"off-centre", set("variation.offset_m", kOffsetFactor * config.variation.offset)}};
}

std::vector<DelayedTrial> SweepDelays(const DelaySweepRequest& request, int num_workers,
                                      Observer& observer, const std::atomic<bool>& stop) {
  const Session session = LoadSession(request.folder, OnDamage::kRefuse, RecordParts::kBrief);
  std::vector<DelayedTrial> trials;
  for (const SweepCondition& condition : ListSweepConditions(session.config)) {
    const ConditionSweep sweep(session, condition, request.with_judge);
    if (condition.settings.empty()) CheckSameSession(session, session.config, sweep.plan());
    std::vector<SweepRun> undelayed;
    for (const PlannedTrial& planned : ChooseFirst(sweep.plan(), request.trials_per_cell)) {
      undelayed.push_back({planned, "", "", 0.0, kUnset});
    }
    std::vector<DelayedTrial> baseline =
        sweep.Run(condition.name, undelayed, num_workers, observer, stop);
    std::vector<DelayedTrial> delayed =
        sweep.Run(condition.name + ", one digit late", ListDelayedRuns(baseline), num_workers,
                  observer, stop);
    for (const char* late : kLateDigits) {
      for (DelayedTrial& trial : baseline) trial.digit = late;
      delayed.insert(delayed.end(), baseline.begin(), baseline.end());
    }
    for (DelayedTrial& trial : delayed) {
      trial.condition = condition.name;
      trials.push_back(std::move(trial));
    }
  }
  return trials;
}

}  // namespace graspbench
