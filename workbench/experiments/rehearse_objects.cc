#include "workbench/experiments/rehearse_objects.h"

#include <algorithm>
#include <chrono>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "core/base/config.h"
#include "core/base/error.h"
#include "core/grasp/grasp_file.h"
#include "datasets/grasps/map_to_hand.h"
#include "datasets/grasps/write_grasps.h"
#include "datasets/plan/conditions.h"
#include "datasets/plan/frozen_folder.h"
#include "datasets/plan/session_inputs.h"
#include "datasets/plan/session_plan.h"
#include "workbench/experiments/output_folder.h"
#include "workbench/experiments/pool/worker_pool.h"
#include "workbench/experiments/run_record.h"

namespace graspbench {

namespace fs = std::filesystem;

namespace {

/** Pairs of each worker that are rehearsed before their lines are written. */
constexpr size_t kPairsOfWorker = 8;
constexpr char kDexgraspbenchRoot[] = "wrist";
/** Other programs press with drives alone, without a regulated grip. So they get a posture this
share of the way from contact to target. Of 0.1, 0.25, 0.5 and 1 it passed most of the TUM Hand's
grasps under dexgraspbench-fc. */
constexpr double kSqueezeShare = 0.5;

Json DescribeRehearsals(const RehearseRequest& request) {
  Json pairs = Json::array();
  for (const RehearsalTask& task : request.tasks) {
    pairs.push_back(
        {{"hand", task.hand->id}, {"object", task.object->id}, {"hash", CalcRehearsalHash(task)}});
  }
  const RehearsalTask& first = request.tasks.front();
  Json config = {{"candidates", request.types_only ? Json("types") : first.config.num_candidates},
                 {"draws", first.config.num_draws},
                 {"conditions", ConfigToJson(first.conditions)},
                 {"imperfections", ConfigToJson(first.imperfections)},
                 {"pairs", pairs}};
  if (first.config.num_postures > 0) config["postures"] = first.config.num_postures;
  if (request.shard.count > 1) config["shard"] = FormatShard(request.shard);
  return config;
}

void PrepareRehearsalFolder(const fs::path& folder, const Json& config) {
  if (HasFrozen(kRehearsalStore, folder)) return CheckSameFrozen(kRehearsalStore, folder, config);
  StagedFolder staged({folder, "", false, {}});
  WriteFrozen(kRehearsalStore, staged.path(), config);
  staged.Commit();
}

/** What its choice came to, for the counts of a progress. */
Outcome SummariseOutcome(const Rehearsal& rehearsal) {
  for (const Outcome outcome : rehearsal.choice().outcomes) {
    if (!IsSuccess(outcome)) return outcome;
  }
  return Outcome::kSuccess;
}

/** A stage of rehearsals, from its first task to its last. */
class RehearsalStage {
 public:
  RehearsalStage(size_t num_tasks, int num_workers, Observer& observer)
      : num_workers_(num_workers),
        observer_(observer),
        board_(num_workers),
        stage_(MakeStage(StageKind::kRehearsal, num_tasks)) {
    observer_.BeginStage(stage_);
  }

  /** @returns the results up to the first that is missing when it was stopped. */
  std::vector<Rehearsal> Run(const std::vector<const RehearsalTask*>& tasks) {
    std::vector<std::optional<Rehearsal>> found(tasks.size());
    const auto make_runner = [&](int worker, const std::atomic<bool>&) -> TaskRunner {
      return RunTask([&, worker](size_t i) {
        const RehearsalTask& task = *tasks[i];
        board_.SetBusy(worker, PlannedTrial{"", task.hand->id, task.object->id, "", 0});
        found[i] = FindRehearsal(task);
        board_.Count(SummariseOutcome(*found[i]));
        board_.SetBusy(worker, std::nullopt);
      });
    };
    RunTasks(
        tasks.size(), CalcNumWorkers(num_workers_, tasks.size()), make_runner,
        [&] { observer_.ShowStatus(board_.Read(), stage_.num_trials); }, observer_.stop());
    std::vector<Rehearsal> results;
    for (std::optional<Rehearsal>& one : found) {
      if (!one) break;
      results.push_back(std::move(*one));
    }
    return results;
  }

 private:
  int num_workers_;
  Observer& observer_;
  StatusBoard board_;
  Stage stage_;
};

[[noreturn]] void ThrowStopped() {
  throw Error(ErrorKind::kInterrupted,
              "stopped; finished pairs are kept. Repeat the command to continue");
}

/** Rehearsals by their hashes, of other folders. */
std::map<std::string, Rehearsal> LoadParts(const std::vector<std::string>& parts) {
  std::map<std::string, Rehearsal> known;
  for (const std::string& part : parts) {
    for (RehearsedPair& pair : LoadRehearsals(part)) known.emplace(pair.hash, pair.result);
  }
  return known;
}

double CalcSqueeze(const Grasp& grasp) {
  const double contact = grasp.placement ? grasp.placement->closing_at_contact : 0.0;
  return contact + kSqueezeShare * (1.0 - contact);
}

/** For a hand with the joints and the root of DexGraspBench's: the open hand, the posture in which
its pads are as far apart as the object is wide, the squeeze. Nothing: another hand. */
std::optional<ForeignGrasp> MakeDexgraspbenchGrasp(const Hand& hand, const Grasp& grasp,
                                                   const GraspObject& object) {
  const auto root = std::find_if(hand.links.begin(), hand.links.end(), [](const HandLink& link) {
    return link.name == kDexgraspbenchRoot;
  });
  if (root == hand.links.end()) return std::nullopt;
  ForeignGrasp foreign;
  foreign.root_link = root->name;
  foreign.joint_names = ListDexgraspbenchJoints();
  foreign.object = object.id;
  const Placement placement = CalcPlacement(hand, grasp, object);
  Pose X_OH = placement.X_WH;
  X_OH.pretranslate(Eigen::Vector3d(0.0, 0.0, -0.5 * object.size.z()));
  for (const auto& [name, closing] :
       {std::pair("pregrasp", 0.0), std::pair("grasp", placement.closing_at_contact),
        std::pair("squeeze", CalcSqueeze(grasp))}) {
    const Eigen::VectorXd q = CalcClosingPosture(hand, grasp, closing);
    GraspStage stage = {
        name, X_OH * CalcLinkPose(hand, q, static_cast<int>(root - hand.links.begin())), {}};
    for (const std::string& joint : foreign.joint_names) {
      const auto found = std::find_if(hand.joints.begin(), hand.joints.end(),
                                      [&](const HandJoint& one) { return one.name == joint; });
      if (found == hand.joints.end()) return std::nullopt;
      stage.joints.push_back(q[found - hand.joints.begin()]);
    }
    foreign.stages.push_back(std::move(stage));
  }
  return foreign;
}

/** The chosen grasp as a grasp file, and that grasp for other programs, by places in the folder. */
void AddGraspFiles(const RehearsalTask& task, const RehearsedCandidate& choice,
                   std::map<std::string, std::string>& files) {
  const Hand& hand = *task.hand;
  const GraspObject& object = *task.object;
  const std::string place = hand.id + "/" + object.id;
  std::string& text = files["grasps/" + place + ".yaml"];
  text = FormatRehearsedGrasp(task, choice.candidate, NameRehearsed(task.config));
  const Grasp grasp = ParseGraspFile(text, place, {&hand}).grasp;
  Grasp pressed = grasp;
  pressed.q_target = CalcClosingPosture(hand, grasp, CalcSqueeze(grasp));
  const double held_share =
      static_cast<double>(choice.CountHeld()) / static_cast<double>(choice.outcomes.size());
  files["isaac/" + place + ".yaml"] = FormatIsaacGrasp(hand, pressed, object.id, object.size,
                                                       object.mass_properties.p_OOcm, held_share);
  if (const auto foreign = MakeDexgraspbenchGrasp(hand, grasp, object)) {
    files["dexgraspbench/" + place + ".npy"] = WriteGrasps({*foreign}, "dexgraspbench").bytes;
  }
}

}  // namespace

std::vector<RehearsalTask> ListRehearsalTasks(const SessionConfig& config,
                                              const RehearsalConfig& rehearsal) {
  SessionConfig plain = config;
  plain.grasps = {"all"};
  plain.conditions.clear();
  CheckSessionConfig(plain);
  const SessionInputs inputs = LoadSessionInputs(plain, FieldUse::kLater);
  CheckInputs(config, inputs);
  std::vector<RehearsalTask> tasks;
  for (const SessionHand& hand : inputs.hands) {
    for (const auto& object : inputs.objects) {
      tasks.push_back(MakeRehearsalTask(plain, rehearsal, hand.hand, hand.grasps, object));
      tasks.back().arm = hand.arm;
    }
  }
  return tasks;
}

std::vector<RehearsalTask> ListUnrehearsed(const SessionConfig& config) {
  std::vector<SessionConfig> configs = {config};
  for (const Condition& condition : config.conditions) {
    if (ChoosesGraspAgain(condition)) configs.push_back(ApplyCondition(condition, config).config);
  }
  std::vector<RehearsalTask> tasks;
  std::set<std::string> hashes;
  const auto add = [&](RehearsalTask task) {
    if (!FindKeptRehearsal(task) && hashes.insert(CalcRehearsalHash(task)).second) {
      tasks.push_back(std::move(task));
    }
  };
  for (const SessionConfig& one : configs) {
    const bool is_base = &one == &configs.front();
    for (const RehearsalConfig& rehearsal : ListRehearsals(one)) {
      for (RehearsalTask& task : ListRehearsalTasks(one, rehearsal)) add(std::move(task));
    }
    if (!HasBestGrasp(one)) continue;
    for (const RehearsalTask& task : ListRehearsalTasks(one, {})) {
      if (NeedsType(task) && !(is_base && FindShippedType(task))) {
        add(MakeTypeTask(task, kTypeDraws));
      }
    }
  }
  return tasks;
}

RehearsalTime EstimateRehearsalTime(const std::vector<RehearsalTask>& tasks) {
  std::map<std::string, RehearsalTime> times;
  RehearsalTime sum;
  for (const RehearsalTask& task : tasks) {
    if (FindKeptRehearsal(task)) continue;
    if (times.count(task.hand->id) == 0) {
      RehearsalTask without = task;
      without.config.num_postures = 0;
      const auto start = std::chrono::steady_clock::now();
      const Rehearsal found = FindRehearsal(without);
      const double time =
          std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      times[task.hand->id] = {
          time, time * task.config.num_postures / static_cast<double>(found.tried.size())};
    }
    sum.candidates += times[task.hand->id].candidates;
    sum.postures += times[task.hand->id].postures;
  }
  return sum;
}

std::vector<Rehearsal> RehearseTasks(const std::vector<RehearsalTask>& tasks, int num_workers,
                                     Observer& observer) {
  std::vector<const RehearsalTask*> all;
  for (const RehearsalTask& task : tasks) all.push_back(&task);
  if (all.empty()) return {};
  std::vector<Rehearsal> results = RehearsalStage(all.size(), num_workers, observer).Run(all);
  if (results.size() < all.size()) ThrowStopped();
  observer.EndStage();
  return results;
}

std::vector<RehearsedPair> RehearseObjects(const RehearseRequest& request, Observer& observer) {
  PrepareRehearsalFolder(request.out, DescribeRehearsals(request));
  RunRecorder recorder(request.out, request.num_workers, observer);
  const std::map<std::string, Rehearsal> known = LoadParts(request.parts);
  bool is_complete = true;
  {
    RehearsalJournal journal(request.out / "journal.jsonl");
    std::vector<size_t> left;
    for (size_t i = 0; i < request.tasks.size(); ++i) {
      if (IsCardOf(i, request.shard) && !journal.Find(static_cast<int>(i))) left.push_back(i);
    }
    const size_t batch = kPairsOfWorker * static_cast<size_t>(std::max(1, request.num_workers));
    std::optional<RehearsalStage> stage;
    if (!left.empty()) stage.emplace(left.size(), request.num_workers, recorder);
    for (size_t first = 0; is_complete && first < left.size(); first += batch) {
      const size_t count = std::min(batch, left.size() - first);
      std::vector<RehearsedPair> pairs;
      std::vector<const RehearsalTask*> unknown;
      for (size_t i = first; i < first + count; ++i) {
        const RehearsalTask& task = request.tasks[left[i]];
        const std::string hash = CalcRehearsalHash(task);
        pairs.push_back({static_cast<int>(left[i]), task.hand->id, task.object->id, hash, {}});
        if (known.count(hash) == 0) unknown.push_back(&task);
      }
      std::vector<Rehearsal> found = stage->Run(unknown);
      std::vector<RehearsedPair> done;  // up to the first that is not, so that the order holds
      size_t next = 0;
      for (RehearsedPair& pair : pairs) {
        const auto part = known.find(pair.hash);
        is_complete = part != known.end() || next < found.size();
        if (!is_complete) break;
        pair.result = part != known.end() ? part->second : std::move(found[next++]);
        done.push_back(std::move(pair));
      }
      if (!done.empty()) journal.Append(std::move(done));
    }
    if (!left.empty()) {
      if (is_complete) recorder.EndStage();
      recorder.Keep(is_complete);
    }
  }
  SealStore(kRehearsalStore, request.out);
  if (!is_complete) ThrowStopped();
  std::vector<RehearsedPair> pairs = LoadRehearsals(request.out);
  std::map<std::string, std::string> grasps;
  for (const RehearsedPair& pair : pairs) {
    AddGraspFiles(request.tasks[static_cast<size_t>(pair.request)], pair.result.choice(), grasps);
  }
  RehearsedTypes types;
  for (const RehearsedPair& pair : pairs) {
    if (!request.types_only) break;
    const RehearsalTask& task = request.tasks[static_cast<size_t>(pair.request)];
    types[{pair.hand, pair.object}] = MakeType(task, pair.result);
  }
  if (request.types_only) grasps["types.json"] = FormatTypes(types);
  FinishRehearsals(request.out, pairs, std::move(grasps));
  return pairs;
}

}  // namespace graspbench
