#include "datasets/scene/scene_store.h"

#include <algorithm>

#include "core/base/config.h"
#include "core/base/files.h"
#include "core/grasp/grasp_file.h"
#include "datasets/session/frozen_folder.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

Json JsonAngles(const Eigen::VectorXd& angles) {
  return Json(std::vector<double>(angles.data(), angles.data() + angles.size()));
}

Json MakeScore(const std::vector<LearningTrial>& trials) {
  if (trials.empty()) return nullptr;
  return Json{{"trials", trials.size()},
              {"successes", CountSuccesses(trials)},
              {"mean_sigma", CalcMeanSigma(trials)},
              {"median_gft_ratio", JsonNumber(CalcMedianGftRatio(trials))}};
}

/** Of check trials of step 1, the first of which is without variation. */
Json MakePreGraspScore(const std::vector<LearningTrial>& trials) {
  Json score = MakeScore(trials);
  if (!trials.empty()) {
    score["gft_ratio_without_variation"] = JsonNumber(trials.front().timing.gft_ratio);
  }
  return score;
}

Json MakeShotJson(const PreGraspShot& shot, const StandardGrasp& start) {
  Json cases = Json::object();
  for (size_t d = 0; d < start.digits.size(); ++d) {
    cases[start.digits[d]] = NameOf(shot.learned.digit_cases[d]);
  }
  return Json{{"name", shot.name},
              {"digits", cases},
              {"object_pushed_away", shot.was_pushed_away},
              {"common_closing", shot.learned.common_closing},
              {"opening_m", shot.learned.opening},
              {"required_opening_m", shot.learned.required_opening},
              {"score", MakePreGraspScore(shot.trials)}};
}

Json MakePreGraspJson(const PreGraspStep& step, const StandardGrasp& start) {
  Json shots = Json::array();
  for (const PreGraspShot& shot : step.shots) shots.push_back(MakeShotJson(shot, start));
  return Json{{"verdict", step.verdict},
              {"taken", step.chosen < 0 ? Json() : Json(step.shots[step.chosen].name)},
              {"standard", MakePreGraspScore(step.standard_trials)},
              {"shots", shots}};
}

Json MakeTargetJson(const TargetStep& step, const Hand& hand) {
  Json joints = Json::array();
  for (const int joint : step.joints) joints.push_back(hand.joints[joint].name);
  const Individual& best = step.search.individuals[step.search.best];
  Json finalists = Json::array();
  for (const Finalist& finalist : step.finalists) {
    finalists.push_back({{"individual", finalist.number},
                         {"fitness", CalcFitness(finalist.trials)},
                         {"score", MakeScore(finalist.trials)}});
  }
  return Json{{"verdict", step.verdict},
              {"taken", step.is_taken},
              {"joints", joints},
              {"lower_rad", JsonAngles(step.space.lower)},
              {"upper_rad", JsonAngles(step.space.upper)},
              {"start_rad", JsonAngles(step.space.start)},
              {"found_rad", JsonAngles(step.search.individuals[step.found].genome)},
              {"found_individual", step.found},
              {"best_individual", best.number},
              {"evaluations", step.search.individuals.size()},
              {"start_fitness", step.search.individuals.front().fitness},
              {"best_fitness", best.fitness},
              {"finalists", finalists},
              {"check_before", MakeScore(step.check_before)},
              {"check_after", MakeScore(step.check_after)}};
}

/** One row an individual; RFC 4180. */
std::string FormatIndividuals(const TargetStep& step, const Hand& hand) {
  std::string csv = "number,generation,parents,fitness,best_fitness";
  for (const char* part : {"", "_step"}) {
    for (const int joint : step.joints) csv += "," + hand.joints[joint].name + part + "_rad";
  }
  csv += "\n";
  double best = step.search.individuals.front().fitness;
  for (const Individual& individual : step.search.individuals) {
    best = std::max(best, individual.fitness);
    csv += std::to_string(individual.number) + "," + std::to_string(individual.generation) + ",";
    for (size_t i = 0; i < individual.parents.size(); ++i) {
      csv += (i > 0 ? " " : "") + std::to_string(individual.parents[i]);
    }
    csv += "," + FormatJson(individual.fitness) + "," + FormatJson(best);
    for (const double angle : individual.genome) csv += "," + FormatJson(angle);
    for (size_t i = 0; i < step.joints.size(); ++i) {
      csv += individual.steps.size() > 0
                 ? "," + FormatJson(individual.steps[static_cast<Eigen::Index>(i)])
                 : ",";
    }
    csv += "\n";
  }
  return csv;
}

constexpr FrozenKind kFrozenScene = {"optimisation", "scene.json", kSceneSchema,
                                     "graspbench optimise", "optimise anew into another folder"};

SceneConfig ParseSceneConfig(const fs::path& folder) {
  Diagnostics problems;
  const auto config = ConfigFromJson<SceneConfig>(LoadFrozen(kFrozenScene, folder),
                                                  (folder / kFrozenScene.file).string(), problems);
  problems.ThrowIfErrors(ErrorKind::kFormat, "the frozen configuration cannot be read");
  return config;
}

}  // namespace

bool HasScene(const fs::path& folder) { return HasFrozen(kFrozenScene, folder); }

bool IsSceneFinished(const fs::path& folder) { return fs::exists(folder / "result.json"); }

void CreateScene(const fs::path& folder, const SceneConfig& config) {
  if (HasScene(folder)) {
    const std::string text =
        ListDifferences(FindConfigDifferences(ParseSceneConfig(folder), config));
    if (text.empty()) return;
    throw Error(ErrorKind::kUsage, "\"" + folder.string() +
                                       "\" was started with other settings (there and now):" +
                                       text + "\nuse those, or choose another folder with --out");
  }
  MakeFolder(folder);
  WriteFrozen(kFrozenScene, folder, ConfigToJson(config));
}

void WriteSceneResult(const fs::path& folder, const SceneConfig& config, const SceneInputs& inputs,
                      const OptimisedGrasp& optimised) {
  const Hand& hand = *inputs.hand;
  const auto write_grasp = [&](const StandardGrasp& grasp,
                               const std::vector<LearningTrial>& trials) {
    const double confidence =
        trials.empty() ? 0.0 : static_cast<double>(CountSuccesses(trials)) / trials.size();
    WriteFileAtomically(folder / (grasp.id + ".yaml"), FormatGraspFile(hand, grasp, config.grasp));
    WriteFileAtomically(folder / (grasp.id + ".isaac_grasp.yaml"),
                        FormatIsaacGrasp(hand, grasp, inputs.object->id, inputs.object->size,
                                         inputs.object->mass_properties.p_OOcm, confidence));
  };
  Json result = {{"hand", hand.id}, {"object", inputs.object->id}, {"grasp", config.grasp}};
  const PreGraspStep& step1 = optimised.pregrasp_step;
  const TargetStep& step2 = optimised.target_step;
  if (StepsOf(config.optimise).learns_pregrasp) {
    result["pregrasp_step"] = MakePreGraspJson(step1, inputs.grasp);
    write_grasp(optimised.new_pregrasp,
                step1.chosen < 0 ? step1.standard_trials : step1.shots[step1.chosen].trials);
  }
  if (StepsOf(config.optimise).searches_target) {
    result["target_step"] = MakeTargetJson(step2, hand);
    write_grasp(optimised.new_target, step2.is_taken ? step2.check_after : step2.check_before);
    WriteFileAtomically(folder / "individuals.csv", FormatIndividuals(step2, hand));
  }
  WriteFileAtomically(folder / "result.json", FormatJson(result, 2) + "\n");
}

SceneRecord LoadScene(const fs::path& folder) {
  SceneRecord scene;
  scene.config = ParseSceneConfig(folder);
  scene.evaluations = LoadEvaluations(folder / "journal.jsonl", scene.findings);
  if (!IsSceneFinished(folder)) return scene;
  const fs::path path = folder / "result.json";
  try {
    scene.result = Json::parse(ReadFile(path));
  } catch (const Json::exception& e) {
    throw Error(ErrorKind::kFormat, "\"" + path.string() + "\" is damaged: " + e.what() +
                                        "; delete it and resume, it is made from the journal");
  }
  return scene;
}

StandardGrasp LoadSceneGrasp(const fs::path& folder, Variant variant, const Hand& hand) {
  return LoadGraspFile((folder / (std::string(NameOf(variant)) + ".yaml")).string(), {&hand}).grasp;
}

}  // namespace graspbench
