#include "datasets/scene/scene_store.h"

#include <algorithm>
#include <cmath>

#include "core/base/config.h"
#include "core/base/files/files.h"
#include "core/base/hash.h"
#include "core/base/text/csv.h"
#include "core/grasp/grasp_file.h"
#include "core/optimise/contact_times.h"
#include "core/optimise/learning_trial.h"
#include "core/trial/judge/judgement.h"
#include "datasets/journal/checked_line.h"
#include "datasets/plan/frozen_folder.h"
#include "datasets/plan/grip_check.h"
#include "datasets/plan/session_plan.h"

namespace graspbench {

namespace fs = std::filesystem;

namespace {

/** Length of the hold from which a search takes its fitness [s]. */
constexpr double kFitnessHoldTime = 0.5;

constexpr char kResult[] = "result.json";

Json JsonAngles(const Eigen::VectorXd& angles) {
  return Json(std::vector<double>(angles.data(), angles.data() + angles.size()));
}

/** Of check trials of step 1, the first of which is without variation. */
Json MakePreGraspScore(const std::vector<LearningTrial>& trials) {
  Json score = MakeScore(trials);
  if (!trials.empty()) {
    score["gft_ratio_without_variation"] = JsonNumber(trials.front().timing.gft_ratio);
  }
  return score;
}

Json MakeShotJson(const PreGraspShot& shot, const Grasp& start) {
  Json cases = Json::object();
  for (size_t d = 0; d < shot.learned.digit_cases.size(); ++d) {
    cases[start.digits[d]] = NameOf(shot.learned.digit_cases[d]);
  }
  Json delays = Json::object();
  for (const auto& [digit, schedule] : shot.grasp.closing) delays[digit] = schedule.delay;
  return Json{{"name", shot.name},
              {"digits", cases},
              {"delays_s", delays},
              {"object_pushed_away", shot.was_pushed_away},
              {"common_closing", shot.learned.common_closing},
              {"opening_m", shot.learned.opening},
              {"required_opening_m", shot.learned.required_opening},
              {"score", MakePreGraspScore(shot.trials)}};
}

/** What the pre-grasp reaches without delays, on the draws of the check's first look. */
Json MakeAloneJson(const PreGraspStep& step) {
  if (step.alone < 0) return nullptr;
  return Json{{"name", step.shots[step.alone].name},
              {"before", MakeScore(step.ListBeforeAlone())},
              {"after", MakeScore(step.alone_trials)}};
}

Json MakePreGraspJson(const PreGraspStep& step, const Grasp& start) {
  Json shots = Json::array();
  for (const PreGraspShot& shot : step.shots) shots.push_back(MakeShotJson(shot, start));
  return Json{{"verdict", step.verdict},
              {"taken", step.chosen < 0 ? Json() : Json(step.shots[step.chosen].name)},
              {"checked", step.best < 0 ? Json() : Json(NameWhatChanged(step.shots[step.best]))},
              {"pregrasp_alone", MakeAloneJson(step)},
              {"standard", MakePreGraspScore(step.standard_trials)},
              {"shots", shots},
              {"check_before", MakeScore(step.check.before)},
              {"check_after", MakeScore(step.check.after)}};
}

/** The thumb's angles as before there were other spaces; else each coordinate in its unit. */
Json MakeCoordinatesJson(const TargetStep& step, const std::string& space) {
  const Eigen::VectorXd& found = step.search.individuals[step.found].genome;
  Json names = Json::array(), coordinates = Json::array();
  for (size_t i = 0; i < step.coordinates.size(); ++i) {
    const GraspCoordinate& coordinate = step.coordinates[i];
    const auto k = static_cast<Eigen::Index>(i);
    names.push_back(coordinate.name);
    coordinates.push_back({{"name", coordinate.name},
                           {"unit", coordinate.unit},
                           {"lower", coordinate.per_radian * step.space.lower[k]},
                           {"upper", coordinate.per_radian * step.space.upper[k]},
                           {"start", coordinate.per_radian * step.space.start[k]},
                           {"found", coordinate.per_radian * found[k]}});
  }
  if (space != kThumbSpace) return Json{{"search", space}, {"coordinates", coordinates}};
  return Json{{"joints", names},
              {"lower_rad", JsonAngles(step.space.lower)},
              {"upper_rad", JsonAngles(step.space.upper)},
              {"start_rad", JsonAngles(step.space.start)},
              {"found_rad", JsonAngles(found)}};
}

Json MakeHeadroomJson(const SceneInputs& inputs, const SceneConfig& config,
                      const std::vector<LearningTrial>& trials) {
  if (trials.empty()) return nullptr;
  const Headroom headroom = CalcHeadroom(trials, *inputs.object, config.sim.gravity);
  return {{"bound_n", JsonNumber(headroom.bound)}, {"share", JsonNumber(headroom.share)}};
}

Json MakeTargetJson(const TargetStep& step, const std::string& space) {
  const Individual& best = step.search.individuals[step.search.best];
  Json finalists = Json::array();
  for (const Finalist& finalist : step.finalists) {
    finalists.push_back({{"individual", finalist.number},
                         {"fitness", CalcFitness(finalist.trials, step.grip_limit)},
                         {"score", MakeScore(finalist.trials)}});
  }
  Json json{{"verdict", step.verdict},
            {"taken", step.check.is_taken()},
            {"grip_limit_n", JsonNumber(step.grip_limit)}};
  json.update(MakeCoordinatesJson(step, space));
  json.update({{"found_individual", step.found},
               {"best_individual", best.number},
               {"evaluations", step.search.individuals.size()},
               {"simulated", step.simulated.size()},
               {"start_fitness", step.search.individuals.front().fitness},
               {"best_fitness", best.fitness},
               {"finalists", finalists},
               {"check_before", MakeScore(step.check.before, step.grip_limit)},
               {"check_after", MakeScore(step.check.after, step.grip_limit)}});
  return json;
}

struct IndividualRow {
  const TargetStep* step;
  const Individual* individual;
  double best;  ///< fitness so far

  bool is_simulated() const {
    return std::binary_search(step->simulated.begin(), step->simulated.end(), individual->number);
  }
};

std::vector<CsvColumn<IndividualRow>> ListIndividualColumns(
    const std::vector<GraspCoordinate>& coordinates) {
  using Row = IndividualRow;
  std::vector<CsvColumn<Row>> columns = {
      {"number", "", "in the order of their making, from 0, the start",
       [](const Row& row) { return row.individual->number; }},
      {"generation", "", "of the search; 0: the start",
       [](const Row& row) { return row.individual->generation; }},
      {"parents", "", "their numbers; empty where the method has none",
       [](const Row& row) {
         std::string parents;
         for (const int parent : row.individual->parents) {
           parents += (parents.empty() ? "" : " ") + std::to_string(parent);
         }
         return parents;
       }},
      {"fitness", "number", "", "larger is better; empty: not simulated",
       [](const Row& row) { return row.is_simulated() ? Json(row.individual->fitness) : Json(); }},
      {"best_fitness", "number", "", "largest so far",
       [](const Row& row) { return Json(row.best); }}};
  const auto add = [&](const char* part, const char* meaning, Eigen::VectorXd Individual::*values) {
    for (size_t i = 0; i < coordinates.size(); ++i) {
      const GraspCoordinate& each = coordinates[i];
      columns.push_back(
          {each.name + part + "_" + each.unit, "number", each.unit, meaning + each.name,
           [values, per_radian = each.per_radian, i](const Row& row) {
             const Eigen::VectorXd& all = row.individual->*values;
             return all.size() > 0 ? Json(per_radian * all[static_cast<Eigen::Index>(i)]) : Json();
           }});
    }
  };
  add("", "value of ", &Individual::genome);
  add("_step", "self-adapted standard deviation of ", &Individual::steps);
  return columns;
}

std::string FormatIndividuals(const TargetStep& step) {
  std::vector<IndividualRow> rows;
  double best = step.search.individuals.front().fitness;
  for (const Individual& individual : step.search.individuals) {
    best = std::max(best, individual.fitness);
    rows.push_back({&step, &individual, best});
  }
  return FormatCsv(ListIndividualColumns(step.coordinates), rows);
}

/** Trials of what a step kept, which did not choose it. */
const std::vector<LearningTrial>& ListTold(const GraspCheck& check) {
  return check.is_taken() ? check.after : check.before;
}

SceneConfig LoadSceneConfig(const fs::path& folder, OnDamage on_damage = OnDamage::kRefuse) {
  return ParseFrozen<SceneConfig>(kSceneStore, folder,
                                  LoadFrozen(kSceneStore, folder, on_damage).config);
}

}  // namespace

Json MakeScore(const std::vector<LearningTrial>& trials, double grip_limit) {
  if (trials.empty()) return nullptr;
  const Answer<double> floor = CalcGftFloor(trials);
  const ContactTimesSummary times = SummariseContactTimes(trials);
  Json score = {{"trials", trials.size()},
                {"successes", CountSuccesses(trials)},
                {"mean_sigma", CalcMeanSigma(trials)},
                {"mean_grip_n", JsonNumber(CalcMeanGrip(trials))},
                {"fitness", CalcFitness(trials, grip_limit)},
                {"median_gft_ratio", JsonNumber(CalcMedianGftRatio(trials))},
                {"gft_ratio_floor", floor ? Json(*floor) : Json()},
                {"timed", times.num_timed},
                {"median_gft_s", JsonNumber(times.gft)},
                {"gft_floor_s", JsonNumber(times.gft_floor)},
                {"median_got_s", JsonNumber(times.got)},
                {"median_gct_s", JsonNumber(times.gct)}};
  if (const double strength = CalcMeanStrength(trials); std::isfinite(strength)) {
    score["mean_strength_n"] = strength;
  }
  if (!floor) score["no_gft_ratio_floor"] = floor.reason();
  return score;
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
                                           ", the number of pairs between two looks"});
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

bool HasScene(const fs::path& folder) { return HasFrozen(kSceneStore, folder); }

std::string CalcInputsHash(const SceneInputs& inputs) {
  const Json content = {{"physics", kPhysicsVersion},
                        {"hand", {inputs.hand->id, inputs.hand->content_hash}},
                        {"object", {inputs.object->id, inputs.object->content_hash}},
                        {"grasp", ToJson(inputs.grasp)}};
  return CalcHashHex(FormatJson(content));
}

bool HasSceneResult(const fs::path& folder) {
  return HasManifest(folder) && LoadManifest(folder).Find(kResult);
}

bool IsSceneFinished(const fs::path& folder, const SceneInputs& inputs) {
  return HasSceneResult(folder) && LoadManifest(folder).inputs == CalcInputsHash(inputs);
}

void CreateScene(const fs::path& folder, const SceneConfig& config) {
  if (HasScene(folder)) {
    const std::string text =
        ListDifferences(FindConfigDifferences(LoadSceneConfig(folder), config));
    if (text.empty()) return;
    throw Error(ErrorKind::kUsage, "\"" + folder.string() +
                                       "\" was started with other settings (there and now):" +
                                       text + "\nuse those, or choose another folder with --out");
  }
  MakeFolder(folder);
  WriteFrozen(kSceneStore, folder, ConfigToJson(config));
}

Json MakeIndividualSchema() {
  return MakeTableSchema(ListIndividualColumns({{"COORDINATE", "rad"}}), "");
}

void WriteSceneResult(const fs::path& folder, const SceneConfig& config, const SceneInputs& inputs,
                      const OptimisedGrasp& optimised) {
  const Hand& hand = *inputs.hand;
  const auto write_grasp = [&](const Grasp& grasp, const std::vector<LearningTrial>& trials) {
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
                step1.best < 0 ? step1.standard_trials : ListTold(step1.check));
  }
  if (StepsOf(config.optimise).searches_target) {
    result["target_step"] = MakeTargetJson(step2, config.optimise.search);
    result["target_step"]["headroom_before"] = MakeHeadroomJson(inputs, config, step2.check.before);
    result["target_step"]["headroom_after"] = MakeHeadroomJson(inputs, config, step2.check.after);
    write_grasp(optimised.new_target, ListTold(step2.check));
    WriteFileAtomically(folder / "individuals.csv", FormatIndividuals(step2));
  }
  WriteFileAtomically(folder / kResult, FormatJson(result, 2) + "\n");
  SealStore(kSceneStore, folder, CalcInputsHash(inputs));
}

SceneRecord LoadScene(const fs::path& folder, OnDamage on_damage) {
  SceneRecord scene;
  scene.config = LoadSceneConfig(folder, on_damage);
  std::vector<Damage> damage;
  scene.evaluations =
      LoadAnswers<EvaluationRecord>(folder / "journal.jsonl", scene.findings, damage);
  RefuseAnswers(folder, damage, on_damage);
  const fs::path path = folder / kResult;
  if (!fs::exists(path)) return scene;
  try {
    scene.result = Json::parse(ReadFile(path));
  } catch (const Json::exception& e) {
    throw Error(ErrorKind::kFormat, "\"" + path.string() +
                                        "\" is damaged: " + DescribeJsonFault(e) +
                                        "; delete it and resume: it is rebuilt from the journal");
  }
  return scene;
}

Grasp LoadSceneGrasp(const fs::path& folder, Variant variant, const Hand& hand) {
  return LoadGraspFile((folder / (std::string(NameOf(variant)) + ".yaml")).string(), {&hand}).grasp;
}

}  // namespace graspbench
