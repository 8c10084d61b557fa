#include "workbench/experiments/judge_grasps.h"

#include <algorithm>

#include "core/base/config.h"
#include "core/base/error.h"
#include "datasets/judged_grasps/profile_file.h"
#include "workbench/experiments/output_folder.h"
#include "workbench/experiments/pool/worker_pool.h"
#include "workbench/experiments/run_record.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

/** So many tasks a worker are judged before their lines are written, in order. */
constexpr int kBatch = 16;

std::string NameLabel(const std::optional<bool>& label) {
  return !label ? "" : *label ? "success" : "failure";
}

/** All tasks in their order: grasp by grasp, then its disturbances, then the profiles. */
class Tasks {
 public:
  Tasks(const GraspInputs& inputs, const std::vector<FreeSpaceProfile>& profiles, int jitter)
      : inputs_(inputs), profiles_(profiles), num_variants_(static_cast<size_t>(jitter) + 1) {}

  size_t size() const { return inputs_.grasps.size() * num_variants_ * profiles_.size(); }
  const GraspInput& InputOf(size_t task) const {
    return inputs_.grasps[task / (num_variants_ * profiles_.size())];
  }
  JudgedGrasp Judge(size_t task) const {
    const GraspInput& input = InputOf(task);
    const FreeSpaceProfile& profile = profiles_[task % profiles_.size()];
    JudgedGrasp judged;
    judged.request = static_cast<int>(task);
    judged.source = input.grasp.source;
    judged.index = input.grasp.index;
    judged.object = input.grasp.object;
    judged.profile = profile.name;
    judged.jitter = static_cast<int>(task / profiles_.size() % num_variants_);
    judged.label = NameLabel(input.grasp.label);
    judged.result = JudgeGraspInput(inputs_, input, profile, judged.jitter);
    return judged;
  }

 private:
  const GraspInputs& inputs_;
  const std::vector<FreeSpaceProfile>& profiles_;
  size_t num_variants_;
};

Outcome OutcomeOf(const FreeSpaceResult& result) {
  return result.passed         ? Outcome::kSuccess
         : result.is_numerical ? Outcome::kNumericalFailure
                               : Outcome::kDroppedWhileHolding;
}

void PrepareFolder(const fs::path& folder, const Json& config) {
  if (HasJudgedGrasps(folder)) return CheckSameGrasps(folder, config);
  StagedFolder staged({folder, "", false, {}});
  CreateJudgedGrasps(staged.path(), config);
  staged.Commit();
}

}  // namespace

Json DescribeRequest(const JudgeGraspsRequest& request, const GraspInputs& inputs,
                     const std::vector<FreeSpaceProfile>& profiles) {
  Json config = inputs.description;
  config["jitter"] = request.jitter;
  config["profiles"] = Json::array();
  for (const FreeSpaceProfile& profile : profiles) {
    config["profiles"].push_back({{"name", profile.name}, {"values", ConfigToJson(profile)}});
  }
  Json unread = Json::array();
  for (const UnreadFile& file : inputs.unread) {
    unread.push_back({{"name", file.name}, {"reason", file.reason}});
  }
  config["unread"] = unread;
  return config;
}

bool JudgeGrasps(const JudgeGraspsRequest& request, const GraspInputs& inputs, Observer& observer,
                 const std::atomic<bool>& stop) {
  std::vector<FreeSpaceProfile> profiles;
  for (const std::string& name : request.profiles) {
    profiles.push_back(LoadProfile(name));
    for (size_t i = 0; i + 1 < profiles.size(); ++i) {
      if (profiles[i].name != profiles.back().name) continue;
      throw Error(ErrorKind::kUsage, "two profiles are named \"" + profiles[i].name +
                                         "\"; name each once, or rename a file, for a verdict "
                                         "names its profile");
    }
  }
  PrepareFolder(request.out, DescribeRequest(request, inputs, profiles));
  RunRecorder recorder(request.out, request.num_workers, observer);
  const Tasks tasks(inputs, profiles, request.jitter);
  GraspJournal journal(request.out / "journal.jsonl");
  std::vector<size_t> left;
  for (size_t task = 0; task < tasks.size(); ++task) {
    if (!journal.Find(static_cast<int>(task))) left.push_back(task);
  }
  Stage stage = MakeStage(StageKind::kGrasps, tasks.size());
  stage.num_left = stage.num_trials = static_cast<int>(left.size());
  recorder.BeginStage(stage);
  StatusBoard board(request.num_workers);
  bool is_complete = true;
  const size_t batch = static_cast<size_t>(kBatch * std::max(1, request.num_workers));
  for (size_t first = 0; is_complete && first < left.size(); first += batch) {
    const size_t count = std::min(batch, left.size() - first);
    std::vector<std::optional<JudgedGrasp>> judged(count);
    const auto make_runner = [&](int worker, const std::atomic<bool>&) -> TaskRunner {
      return RunTask([&, worker](size_t i) {
        const GraspInput& input = tasks.InputOf(left[first + i]);
        board.SetBusy(worker, PlannedTrial{"", inputs.hand->id, input.object->id,
                                           input.grasp.source, input.grasp.index});
        judged[i] = tasks.Judge(left[first + i]);
        board.Count(OutcomeOf(judged[i]->result));
        board.SetBusy(worker, std::nullopt);
      });
    };
    is_complete = RunTasks(
        count, request.num_workers, make_runner,
        [&] { recorder.ShowStatus(board.Read(), stage.num_trials); }, stop);
    std::vector<JudgedGrasp> done;  // up to the first that is not, so that the order holds
    for (const auto& one : judged) {
      if (!one) break;
      done.push_back(*one);
    }
    if (!done.empty()) journal.Append(std::move(done));
  }
  if (!left.empty()) {
    recorder.EndStage();
    recorder.Keep(is_complete);
  }
  SealStore(kJudgedGraspStore, request.out);
  if (is_complete) FinishJudgedGrasps(request.out, LoadJudgedGrasps(request.out));
  return is_complete;
}

}  // namespace graspbench
