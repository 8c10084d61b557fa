#include "datasets/scene/learning_plan.h"

#include <algorithm>

#include "core/base/config.h"
#include "core/base/hash.h"
#include "core/trial/judge/judgement.h"
#include "datasets/plan/firm_grip.h"
#include "datasets/plan/session_plan.h"

namespace graspbench {

namespace {

/** Length of the hold from which a search takes its fitness [s]. */
constexpr double kFitnessHoldTime = 0.5;

}  // namespace

void CompleteOptimiseConfig(Json& config) {
  if (config.is_object() && config.contains("optimise")) {
    config["optimise"].emplace("search", kThumbSpace);
    config["optimise"].emplace("race", false);
    config["optimise"].emplace("fitness", RowOf(kFitnessKinds, FitnessKind::kSigma).name);
  }
}

std::vector<ConfigProblem> Validate(const OptimiseConfig& config) {
  std::vector<ConfigProblem> problems;
  const auto check_range = [&](const char* key, int value, int low, int high) {
    if (value >= low && value <= high) return;
    problems.push_back({key, std::to_string(value) + " is out of range; expected " +
                                 std::to_string(low) + " to " + std::to_string(high)});
  };
  check_range("evaluations", config.evaluations, 1, 1000000);
  check_range("fitness_trials", config.fitness_trials, 1, 100);
  check_range("choice_trials", config.choice_trials, 1, 500);
  constexpr int kMostPairs = kPairsPerLook * kMostLooks;
  check_range("check_pairs", config.check_pairs, kPairsPerLook, kMostPairs);
  if (config.check_pairs % kPairsPerLook != 0) {
    problems.push_back({"check_pairs", std::to_string(config.check_pairs) + " is no multiple of " +
                                           std::to_string(kPairsPerLook) +
                                           ", the pairs between two looks at them"});
  }
  check_range("seed", config.seed, 0, 2147483647);
  const auto check_name = [&](const char* key, const std::string& name,
                              const std::vector<std::string>& known) {
    if (std::find(known.begin(), known.end(), name) != known.end()) return;
    problems.push_back({key, "\"" + name + "\" is not known" + SuggestNames(name, known)});
  };
  check_name("step", config.step, ListNames(kOptimiseSteps));
  check_name("fitness", config.fitness, ListNames(kFitnessKinds));
  check_name("grip", config.grip, ListNames(kGripBudgets));
  const bool has_limit = config.grip == RowOf(kGripBudgets, GripBudget::kLimit).name;
  if (has_limit != (config.grip_limit > 0.0)) {
    problems.push_back({"grip_limit_n", has_limit ? "the grip \"limit\" needs one above 0 N"
                                                  : "is only for the grip \"limit\""});
  }
  check_name("search", config.search, ListGraspSpaces());
  check_name("method", config.method, ListSearchMethods());
  return problems;
}

void CheckOptimiseConfig(const OptimiseConfig& config) {
  std::string text;
  for (const ConfigProblem& problem : Validate(config)) {
    text += "\n" + problem.key + ": " + problem.text;
  }
  if (!text.empty()) throw Error(ErrorKind::kRange, "the optimisation cannot be run" + text);
}

TrialSetup MakeLearningSetup(const SceneConfig& config, const SceneInputs& inputs,
                             const LearningRequest& request, int draw) {
  const Hand& hand = *inputs.hand;
  const int seed = config.optimise.seed;
  TrialSetup setup;
  setup.hand = inputs.hand;
  setup.object = inputs.object;
  setup.grasp = request.grasp;
  setup.strategy = config.strategy;
  if (!request.full_hold) {
    setup.strategy.hold_time = std::min(setup.strategy.hold_time, kFitnessHoldTime);
  }
  setup.sim = config.sim;
  setup.finds_strength = request.finds_strength;
  if (draw == 0) {
    setup.draw.joint_error = Eigen::VectorXd::Zero(hand.num_joints());
    return setup;
  }
  setup.draw = DrawVariation(
      config.variation, hand,
      RandomStream(FormatJson({seed, inputs.object->id, draw}), "object pose of learning"),
      RandomStream(FormatJson({seed, hand.id, inputs.object->id, draw}),
                   "joint error of learning"));
  return setup;
}

std::string CalcLearningTrialId(const SceneConfig& config, const SceneInputs& inputs,
                                const LearningRequest& request, int draw) {
  Json content = {{"physics", kPhysicsVersion},
                  {"hand", {inputs.hand->id, inputs.hand->content_hash}},
                  {"object", {inputs.object->id, inputs.object->content_hash}},
                  {"grasp", ToJson(request.grasp)},
                  {"variation", ConfigToJson(config.variation)},
                  {"strategy", StrategyToJson(config.strategy)},
                  {"full_hold", request.full_hold},
                  {"sim", ConfigToJson(config.sim)},
                  {"model", ConfigToJson(config.model)},
                  {"seed", config.optimise.seed},
                  {"learning_draw", draw}};
  if (request.finds_strength) content["strength"] = kJudgeVersion;
  return CalcHashHex(FormatJson(content));
}

}  // namespace graspbench
