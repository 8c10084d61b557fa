#include <fmt/core.h>

#include <algorithm>
#include <limits>

#include "core/base/error.h"
#include "core/base/text/text.h"
#include "core/optimise/grasp_optimiser.h"
#include "datasets/scene/learning_plan.h"
#include "workbench/experiments/machines/machine.h"
#include "workbench/experiments/pool/trial_pool.h"
#include "workbench/shell/shell.h"
#include "workbench/shell/shell_commands.h"
#include "workbench/tables/optimise_tables.h"
#include "workbench/terminal/terminal.h"
#include "workbench/text/typed_words.h"

namespace graspbench {
namespace {

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

void OptimiseTrial(Shell& shell, const ShellArguments& arguments) {
  const std::string& step = arguments[0];
  if (step != "1" && step != "2") {
    throw Error(ErrorKind::kUsage, "the step is \"" + step +
                                       "\"; expected 1 (the pre-grasp) or 2 (the target of the "
                                       "opposing digit)");
  }
  if (step == "1" && arguments.size() > 1) {
    throw Error(ErrorKind::kUsage, "step 1 takes no number of evaluations; it ends by itself");
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
  if (!is_new) return PrintResult("the grasp stays as it is\n");
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
