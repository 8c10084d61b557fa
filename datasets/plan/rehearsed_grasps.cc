#include "datasets/plan/rehearsed_grasps.h"

#include <algorithm>
#include <utility>

#include "core/base/config.h"
#include "core/base/error.h"
#include "core/base/files/files.h"
#include "core/base/files/kept.h"
#include "core/base/hash.h"
#include "core/base/text/text.h"
#include "core/base/version.h"
#include "core/grasp/grasp_file.h"
#include "core/trial/trial_runner.h"
#include "datasets/plan/grip_check.h"
#include "datasets/plan/session_plan.h"
#include "objects/catalogue.h"

namespace graspbench {
namespace {

constexpr char kRehearsalKind[] = "gbreh002";  ///< changes with a rule of core/rehearse
constexpr char kName[] = "rehearsed";
constexpr int kMostCandidates = 1000, kMostDraws = 100;

std::optional<int> ReadNumber(const std::string& text, int most) {
  if (text.empty() || text.size() > 4 ||
      text.find_first_not_of("0123456789") != std::string::npos) {
    return std::nullopt;
  }
  const int number = std::stoi(text);
  return number >= 1 && number <= most ? std::optional<int>(number) : std::nullopt;
}

std::filesystem::path FindKeptPath(const std::string& hash) {
  return FindCacheRoot() / "rehearsals" / hash;
}

/** With the geometry by which grasps are placed: no change of a rule meets what was kept before. */
uint64_t CalcKeptKey(const std::string& hash) { return CalcHash64(program_sources() + hash); }

std::shared_ptr<const GraspObject> MakeDoubtful(const GraspObject& object) {
  auto doubtful = std::make_shared<GraspObject>(object);
  ModelConfig model;
  model.mass_scale = kDoubtMass;
  ApplyModel(model, *doubtful);
  doubtful->surface.friction_static *= kDoubtFriction;
  doubtful->surface.friction_dynamic *= kDoubtFriction;
  return doubtful;
}

}  // namespace

std::optional<RehearsalConfig> ParseRehearsed(const std::string& name) {
  const size_t length = std::string(kName).size();
  if (name.rfind(kName, 0) != 0) return std::nullopt;
  if (name.size() == length) return RehearsalConfig();
  const bool is_id = name[length] == '-';
  if (!is_id && name[length] != ':') return std::nullopt;
  const std::string rest = name.substr(length + 1);
  const size_t middle = rest.find(is_id ? '-' : ',');
  const std::optional<int> candidates = ReadNumber(rest.substr(0, middle), kMostCandidates);
  const std::optional<int> draws =
      middle == std::string::npos ? std::nullopt : ReadNumber(rest.substr(middle + 1), kMostDraws);
  if (candidates && draws) return RehearsalConfig{*candidates, *draws};
  if (is_id) return std::nullopt;
  throw Error(ErrorKind::kUsage, "the grasp \"" + name +
                                     "\": expected rehearsed:N,k with N candidates from 1 to " +
                                     std::to_string(kMostCandidates) + " and k draws from 1 to " +
                                     std::to_string(kMostDraws) + ", as rehearsed:40,4");
}

std::string NameRehearsed(const RehearsalConfig& config) {
  if (config == RehearsalConfig()) return kName;
  return std::string(kName) + "-" + std::to_string(config.num_candidates) + "-" +
         std::to_string(config.num_draws);
}

std::vector<std::string> JoinRehearsed(const std::vector<std::string>& names) {
  std::vector<std::string> joined;
  for (const std::string& name : names) {
    const bool is_rest = !joined.empty() && joined.back().rfind(std::string(kName) + ":", 0) == 0 &&
                         joined.back().find(',') == std::string::npos &&
                         name.find_first_not_of("0123456789") == std::string::npos;
    if (is_rest) {
      joined.back() += "," + name;
    } else {
      joined.push_back(name);
    }
  }
  for (std::string& name : joined) {
    if (const auto rehearsal = ParseRehearsed(name)) name = NameRehearsed(*rehearsal);
  }
  return joined;
}

std::vector<RehearsalConfig> ListRehearsals(const SessionConfig& config) {
  std::vector<std::string> names = config.grasps;
  const std::string key = "grasp=";
  for (const Condition& condition : config.conditions) {
    for (const std::string& setting : condition.settings) {
      if (setting.rfind(key, 0) == 0) names.push_back(setting.substr(key.size()));
    }
  }
  std::vector<RehearsalConfig> rehearsals;
  for (const std::string& name : names) {
    const std::optional<RehearsalConfig> rehearsal = ParseRehearsed(name);
    if (!rehearsal) continue;
    const bool is_known = std::any_of(rehearsals.begin(), rehearsals.end(),
                                      [&](const auto& one) { return one == *rehearsal; });
    if (!is_known) rehearsals.push_back(*rehearsal);
  }
  return rehearsals;
}

std::vector<Grasp> ListRehearsable(const std::vector<Grasp>& grasps, const GraspObject& object) {
  std::vector<Grasp> rehearsable;
  for (const std::string& id : object.grasp_order) {
    for (const Grasp& grasp : grasps) {
      if (grasp.id == id && grasp.object.empty() && !grasp.placement) rehearsable.push_back(grasp);
    }
  }
  return rehearsable;
}

RehearsalTask MakeRehearsalTask(const SessionConfig& config, const RehearsalConfig& rehearsal,
                                const std::shared_ptr<const Hand>& hand,
                                const std::vector<Grasp>& grasps,
                                const std::shared_ptr<const GraspObject>& object) {
  TrialConditions conditions = config;
  conditions.strategy = FindUsedStrategy(config);
  DropUnusedGrip(conditions.strategy);  // as a session does
  return {hand,
          ListRehearsable(grasps, *object),
          object,
          std::move(conditions),
          config.imperfections,
          rehearsal,
          nullptr};
}

std::string CalcRehearsalHash(const RehearsalTask& task) {
  TrialConditions conditions = task.conditions;
  Json grasps = Json::array();
  for (const Grasp& grasp : task.grasps) {
    grasps.push_back({ToJson(grasp), JsonNumber(grasp.held_share)});
  }
  const Hand& hand = *task.hand;
  Json content = {{"rules", kRehearsalKind},
                  {"physics", kPhysicsVersion},
                  {"hand", {hand.id, hand.content_hash}},
                  {"grasps", grasps},
                  {"object", {task.object->id, task.object->content_hash}},
                  {"approach", RowOf(kApproaches, task.object->approach).name},
                  {"conditions", ConfigToJson(conditions)},
                  {"imperfections", ConfigToJson(task.imperfections)},
                  {"candidates", task.config.num_candidates},
                  {"draws", task.config.num_draws}};
  if (task.config.num_draws < kNumProofDraws) content["proof_draws"] = kNumProofDraws;
  if (task.config.num_postures > 0) content["postures"] = task.config.num_postures;
  if (task.arm) content["arm"] = DescribeArm(*task.arm);
  return CalcHashHex(FormatJson(content));
}

TrialSetup MakeRehearsalSetup(const RehearsalTask& task,
                              const std::shared_ptr<const GraspObject>& object, const Grasp& grasp,
                              const RehearsalQuestion& question) {
  TrialSetup setup;
  setup.hand = task.hand;
  setup.object = object;
  setup.grasp = grasp;
  setup.strategy = task.conditions.strategy;
  setup.strategy.grip_force *= question.grip_share;
  setup.strategy.grip_margin = 1.0 + question.grip_share * (setup.strategy.grip_margin - 1.0);
  setup.sim = task.conditions.sim;
  setup.arm = task.arm;
  const std::string names = FormatJson({task.hand->id, task.object->id, question.draw});
  setup.draw = DrawVariation(task.conditions.variation, *task.hand,
                             RandomStream(names, "object pose of rehearsal"),
                             RandomStream(names, "joint error of rehearsal"));
  return setup;
}

std::optional<Rehearsal> FindKeptRehearsal(const RehearsalTask& task) {
  const std::string hash = CalcRehearsalHash(task);
  const auto text = ReadKept(FindKeptPath(hash), kRehearsalKind, CalcKeptKey(hash));
  if (!text) return std::nullopt;
  try {
    Rehearsal rehearsal;
    ReadRecord(Json::parse(*text), rehearsal);
    return rehearsal;
  } catch (const std::exception&) {  // of another program: as good as absent
    return std::nullopt;
  }
}

Rehearsal FindRehearsal(const RehearsalTask& task) {
  if (task.grasps.empty()) {
    throw Error(ErrorKind::kUsage,
                "the hand \"" + task.hand->id + "\" has no standard grasp to rehearse on \"" +
                    task.object->id + "\"; graspbench hand develop finds grasps");
  }
  if (std::optional<Rehearsal> kept = FindKeptRehearsal(task)) return *kept;
  const std::shared_ptr<const GraspObject> object = CompleteObject(task.object);
  const std::shared_ptr<const GraspObject> doubtful = MakeDoubtful(*object);
  TrialRunner runner(task.hand, object), doubtful_runner(task.hand, doubtful);
  const auto run = [&](const Grasp& grasp, const RehearsalQuestion& question) -> RehearsalAnswer {
    const bool is_doubtful = IsDoubtful(question.draw);
    const TrialResult result =
        (is_doubtful ? doubtful_runner : runner)
            .Run(MakeRehearsalSetup(task, is_doubtful ? doubtful : object, grasp, question));
    return {result.outcome, result.reason};
  };
  const Rehearsal rehearsal =
      RehearseGrasp(CandidateMaker(*task.hand, task.grasps, *object), task.config, run);
  const std::string hash = CalcRehearsalHash(task);
  Keep(FindKeptPath(hash), kRehearsalKind, CalcKeptKey(hash), FormatJson(RecordToJson(rehearsal)));
  return rehearsal;
}

std::string DescribeDoubt(const std::string& hand, const std::string& object,
                          const std::string& grasp, int held, int draws) {
  if (2 * held > draws) return {};
  return hand + ", " + object + ": the grasp chosen by rehearsal, " + grasp + ", held " +
         std::to_string(held) + " of " + std::to_string(draws) + " imagined trials";
}

std::string FormatRehearsedGrasp(const RehearsalTask& task, const GraspCandidate& candidate,
                                 const std::string& id) {
  const std::shared_ptr<const GraspObject> object = CompleteObject(task.object);
  Grasp grasp = CandidateMaker(*task.hand, task.grasps, *object).Make(candidate);
  grasp.id = id;
  return FormatGraspFile(*task.hand, grasp, candidate.standard);
}

}  // namespace graspbench
