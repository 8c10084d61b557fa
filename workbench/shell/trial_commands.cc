#include <fmt/core.h>

#include <algorithm>
#include <limits>

#include "core/base/error.h"
#include "core/base/text/text.h"
#include "core/base/units.h"
#include "core/optimise/grasp_optimiser.h"
#include "core/statistics/proportion.h"
#include "core/statistics/summary.h"
#include "core/trial/measures/diagnosis_text.h"
#include "datasets/plan/session_plan.h"
#include "datasets/scene/scene_store.h"
#include "workbench/experiments/pool/batch_runner.h"
#include "workbench/experiments/run_record.h"
#include "workbench/shell/shell.h"
#include "workbench/shell/shell_cards.h"
#include "workbench/shell/shell_commands.h"
#include "workbench/tables/optimise_tables.h"
#include "workbench/tables/text_table.h"
#include "workbench/terminal/command_line.h"
#include "workbench/terminal/terminal.h"
#include "workbench/text/trial_text.h"

namespace graspbench {
namespace {

constexpr int kMaxTrials = 10000;
constexpr double kJustBefore = 0.01;  // [s]
constexpr int kNumNeighbours = 10;    // draws among which a successful one is looked for

/** The scene's trials of the draws 0 to count - 1, or as many as there was time for. */
std::vector<TrialResult> RunDraws(Shell& shell, ShellScene& scene, int count) {
  std::vector<TrialResult> results;
  int num_successes = 0;
  for (int draw = 0; draw < count && !shell.IsStopped(); ++draw) {
    shell.region.Show({fmt::format("trial {} of {}, success {}", draw + 1, count,
                                   MakePlainText(FormatRate(num_successes, draw)))});
    results.push_back(scene.runner().Run(scene.MakeSetup(draw)));
    num_successes += IsSuccess(results.back().outcome);
  }
  shell.region.Clear();
  return results;
}

double CalcMedianOf(const std::vector<TrialResult>& results,
                    double (*measure)(const TrialResult& result)) {
  std::vector<double> values;
  for (const TrialResult& result : results) {
    if (IsSuccess(result.outcome)) values.push_back(measure(result));
  }
  return CalcMedianOfFinite(values);
}

int CountSuccesses(const std::vector<TrialResult>& results) {
  int count = 0;
  for (const TrialResult& result : results) count += IsSuccess(result.outcome);
  return count;
}

std::string FormatTrials(const std::vector<TrialResult>& results) {
  TextTable table({"draw", "outcome", "GFT [ms]", "sigma [N]", "reason"});
  for (size_t draw = 0; draw < results.size(); ++draw) {
    const TrialResult& result = results[draw];
    table.AddRow({std::to_string(draw), NameOf(result.outcome),
                  FormatFixed(MsFromS(result.timing.gft), 1) +
                      (result.timing.contact_before_start ? " early" : ""),
                  FormatFixed(result.stability.sigma, 2), result.reason});
  }
  const int count = static_cast<int>(results.size());
  return table.Format() + "success  " + FormatRate(CountSuccesses(results), count) +
         fmt::format(
             "\nmedian   GFT {} ms, sigma {} N of the successes\n",
             FormatFixed(
                 MsFromS(CalcMedianOf(results, [](const TrialResult& r) { return r.timing.gft; })),
                 1),
             FormatFixed(
                 CalcMedianOf(results, [](const TrialResult& r) { return r.stability.sigma; }), 2));
}

/** Whether object and hand met in the same poses. */
bool AreSameDraws(const SceneChoice& a, const SceneChoice& b) {
  return a.config.objects == b.config.objects && a.config.seed == b.config.seed &&
         a.config.variation.offset == b.config.variation.offset &&
         a.config.variation.yaw == b.config.variation.yaw;
}

/** The same draws before and now. */
std::string FormatComparison(const DrawnTrials& trials_before,
                             const std::vector<TrialResult>& now) {
  const std::vector<TrialResult>& before = trials_before.results;
  PairedCounts pairs;
  for (size_t draw = 0; draw < std::min(before.size(), now.size()); ++draw) {
    pairs.Add(IsSuccess(before[draw].outcome), IsSuccess(now[draw].outcome));
  }
  const Interval change = CalcPairedDifferenceInterval(pairs);
  return fmt::format(
      "against {}, {}{}, success {} on {}: {} improved, {} worsened; change of the rate {} to {} "
      "points\n",
      trials_before.choice.config.hands.front(), trials_before.grasp,
      trials_before.choice.joints.empty() ? "" : " with joints set by hand",
      fmt::format("{}/{}", CountSuccesses(before), before.size()),
      FormatCount(pairs.num_pairs(), "same draw"), pairs.second_only, pairs.first_only,
      FormatFixed(100.0 * change.low, 1), FormatFixed(100.0 * change.high, 1));
}

/** The draws as they were before the changes by hand, for `trials` to compare with; unset: there
is nothing before, or it was stopped. */
std::optional<DrawnTrials> RunUnchanged(Shell& shell, int count) {
  const std::optional<SceneChoice> before = shell.FindUnchanged();
  if (!before || before->place || !AreSameDraws(*before, shell.choice())) return std::nullopt;
  ShellScene scene;
  scene.Choose(*before);
  DrawnTrials trials = {*before, scene.setup().grasp.id, RunDraws(shell, scene, count)};
  if (shell.IsStopped()) return std::nullopt;
  return trials;
}

/** Of all points of a link. */
struct LinkForce {
  double normal = 0.0;      // [N]
  double cone_share = 0.0;  // of the friction cone in use
};

LinkForce FindLinkForce(ShellScene& scene, const std::string& link) {
  std::vector<HandContact> contacts;
  scene.course().world().FindHandContacts(contacts);
  LinkForce force;
  double most_friction = 0.0;
  Eigen::Vector3d friction_W = Eigen::Vector3d::Zero();
  for (const HandContact& contact : contacts) {
    if (scene.setup().hand->links[static_cast<size_t>(contact.link)].name != link) continue;
    force.normal += contact.normal_force;
    friction_W += contact.friction_W;
    most_friction += contact.mu * contact.normal_force;
  }
  if (most_friction > 0.0) force.cone_share = friction_W.norm() / most_friction;
  return force;
}

/** Why it failed, and where to look. */
std::string DescribeFailure(const TrialResult& result) {
  if (!result.diagnosis) return {};
  const Diagnosis& diagnosis = *result.diagnosis;
  return fmt::format("why      {}\n         to list all forces at that time: goto {}, contacts\n",
                     DescribeDiagnosis(result),
                     FormatFixed(std::max(diagnosis.time - kJustBefore, 0.0), 3));
}

/** Of what holds at the end. */
std::string DescribeWeakest(ShellScene& scene) {
  std::string weakest;
  LinkForce most;
  for (const HandLink& link : scene.setup().hand->links) {
    const LinkForce force = FindLinkForce(scene, link.name);
    if (force.normal <= 0.0 || force.cone_share < most.cone_share) continue;
    most = force;
    weakest = link.name;
  }
  if (weakest.empty()) return {};
  return fmt::format("weakest  {}: normal force {} N, {} of its friction cone used\n", weakest,
                     FormatFixed(most.normal, 2), MakePlainText(FormatPercent(most.cone_share)));
}

std::string DescribeNeighbour(Shell& shell) {
  ShellScene& scene = shell.scene();
  const double radius = 0.5 * scene.setup().object->size.x();
  int nearest = -1;
  double distance = std::numeric_limits<double>::infinity();
  if (scene.choice().place) {
    return "nearest  not available: the object was placed manually\n";
  }
  const std::vector<TrialResult> results = RunDraws(shell, scene, kNumNeighbours);
  for (int draw = 0; draw < static_cast<int>(results.size()); ++draw) {
    if (!IsSuccess(results[static_cast<size_t>(draw)].outcome)) continue;
    const double candidate =
        CalcDrawDistance(scene.MakeSetup(draw).draw, scene.setup().draw, radius);
    if (candidate >= distance) continue;
    distance = candidate;
    nearest = draw;
  }
  if (results.empty()) return {};  // stopped
  if (nearest < 0) {
    return fmt::format("nearest  no success among draws 0 to {}\n", results.size() - 1);
  }
  return fmt::format("nearest  success: draw {}, object {} mm away\n", nearest,
                     FormatFixed(MmFromM(distance), 1));
}

constexpr int kEvaluations = 200;  // a minute or two; as many as `graspbench optimise` on request
constexpr int kMaxEvaluations = 100000;

/** The scene of the shell with the grasp as it is now. */
SceneConfig MakeSceneConfig(const ShellScene& scene, const std::string& step, int evaluations) {
  SceneConfig config;
  static_cast<TrialConditions&>(config) = scene.choice().config;
  config.hand = scene.setup().hand->id;
  config.object = scene.setup().object->id;
  config.grasp = FindStandardId(scene.setup().grasp);
  config.optimise.step = step;
  config.optimise.evaluations = evaluations;
  config.optimise.seed = scene.choice().config.seed;
  return config;
}

/** Asks the simulation, and shows how far it is. */
class LiveTrials {
 public:
  LiveTrials(Shell& shell, const SceneConfig& config, const SceneInputs& inputs)
      : shell_(shell),
        config_(config),
        inputs_(inputs),
        most_(CountLearningTrials(config.optimise)),
        pool_(CountProcessors(), GetShellInterrupt()) {}
  ~LiveTrials() { shell_.region.Clear(); }
  LiveTrials(const LiveTrials&) = delete;
  LiveTrials& operator=(const LiveTrials&) = delete;

  std::vector<std::vector<LearningTrial>> Run(const std::vector<LearningRequest>& requests) {
    Show(requests.front().stage);
    std::vector<TrialSetup> setups;
    for (const LearningRequest& request : requests) {
      for (const int draw : request.draws) {
        setups.push_back(MakeLearningSetup(config_, inputs_, request, draw));
      }
    }
    const std::vector<TrialResult> results = pool_.Run(setups);
    num_done_ += static_cast<int>(results.size());
    auto result = results.begin();
    std::vector<std::vector<LearningTrial>> trials;
    for (const LearningRequest& request : requests) {
      trials.emplace_back();
      for (const int draw : request.draws) {
        trials.back().push_back(MakeLearningTrial(draw, *result++, request.keep_postures));
      }
      if (request.stage == LearningStage::kSearch) {
        best_ = std::max(best_, CalcFitness(trials.back()));
      }
    }
    return trials;
  }

 private:
  void Show(LearningStage stage) {
    std::string line =
        fmt::format("{}: {} of at most {}", NameOf(stage), num_done_, FormatCount(most_, "trial"));
    if (best_ > -std::numeric_limits<double>::infinity()) {
      line += ", best fitness " + FormatFixed(best_, 3);
    }
    shell_.region.Show({line});
  }

  Shell& shell_;
  const SceneConfig& config_;
  const SceneInputs& inputs_;
  const int most_;
  TrialPool pool_;
  int num_done_ = 0;
  double best_ = -std::numeric_limits<double>::infinity();
};

}  // namespace

void RunTrials(Shell& shell, const ShellArguments& arguments) {
  if (shell.scene().choice().place) {
    throw Error(ErrorKind::kUsage,
                "the object was put by hand, so all draws would be the same; see: draw, undo");
  }
  const int count =
      arguments.empty() ? 10 : ParseCount(arguments[0], "the number of trials", 1, kMaxTrials);
  const SceneChoice& choice = shell.scene().choice();
  const std::optional<DrawnTrials> before =
      shell.trials && AreSameDraws(shell.trials->choice, choice) ? shell.trials
                                                                 : RunUnchanged(shell, count);
  const std::vector<TrialResult> results = RunDraws(shell, shell.scene(), count);
  if (results.empty()) return;
  std::string text = FormatTrials(results);
  if (before) text += FormatComparison(*before, results);
  shell.trials = DrawnTrials{choice, shell.scene().setup().grasp.id, results};
  shell.comparison = text;
  PrintResult(text);
}

void JudgeTrial(Shell& shell, const ShellArguments&) {
  ShellScene& scene = shell.scene();
  if (!scene.is_over()) throw Error(ErrorKind::kUsage, "the trial goes on; first: run");
  if (!scene.course().is_held()) {
    throw Error(ErrorKind::kUsage, "nothing is in the hand that could be judged; see: why");
  }
  const Judgement judgement = scene.course().Judge();
  TextTable table({"load in the palm frame", "breaks at", ""});
  for (const BreakingLoad& load : judgement.loads) {
    table.AddRow(
        {load.direction, FormatFixed(load.load, 3),
         std::string(load.is_force() ? "N" : "N m") + (load.is_broken ? "" : ", not broken")});
  }
  PrintResult(table.Format() + fmt::format("smallest {} N, {} N m\n",
                                           FormatFixed(judgement.breaking_force, 2),
                                           FormatFixed(judgement.breaking_moment, 3)));
}

void ExplainTrial(Shell& shell, const ShellArguments&) {
  ShellScene& scene = shell.scene();
  if (!scene.is_over()) throw Error(ErrorKind::kUsage, "the trial goes on; first: run");
  const TrialResult result = scene.course().End();
  std::string text = FormatOutcome(result);
  if (IsSuccess(result.outcome)) {
    text += DescribeWeakest(scene);
  } else {
    text += DescribeFailure(result) + DescribeNeighbour(shell);
  }
  shell.explanation = text;
  PrintResult(text);
}

void OptimiseTrial(Shell& shell, const ShellArguments& arguments) {
  const std::string& step = arguments[0];
  if (step != "1" && step != "2") {
    throw Error(ErrorKind::kUsage, "the step is \"" + step +
                                       "\"; expected 1 (the pre-grasp) or 2 (the target of the "
                                       "opposing digit)");
  }
  if (step == "1" && arguments.size() > 1) {
    throw Error(ErrorKind::kUsage, "step 1 has no number of evaluations; it ends by itself");
  }
  const int evaluations =
      arguments.size() > 1
          ? ParseCount(arguments[1], "the number of evaluations", 1, kMaxEvaluations)
          : kEvaluations;
  const ShellScene& scene = shell.scene();
  const SceneConfig config = MakeSceneConfig(scene, step, evaluations);
  SceneInputs inputs = {scene.setup().hand, scene.setup().object, scene.setup().grasp};
  inputs.grasp.id = config.grasp;
  OptimisedGrasp result;
  try {
    LiveTrials trials(shell, config, inputs);
    result = OptimiseGrasp(
        *inputs.hand, *inputs.object, inputs.grasp, config.optimise,
        [&trials](const std::vector<LearningRequest>& requests) { return trials.Run(requests); });
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::kInterrupted) throw;
    shell.IsStopped();  // which is said in the end; the grasp stays as it was
    return;
  }
  PrintResult(FormatOptimisation(inputs, config, result));
  const bool is_new =
      step == "1" ? result.pregrasp_step.chosen >= 0 : result.target_step.check.is_taken();
  if (!is_new) return PrintResult("the grasp is unchanged\n");
  SceneChoice choice = scene.choice();
  choice.joints.clear();
  choice.closing.clear();
  choice.drives.clear();
  choice.hand_place.reset();
  choice.learned = step == "1" ? result.new_pregrasp : result.new_target;
  shell.Change(choice);
  ShowScene(shell, {});
}

}  // namespace graspbench
