#include "workbench/experiments/judge_grasps.h"

#include <algorithm>
#include <map>

#include "core/base/config.h"
#include "core/base/error.h"
#include "workbench/experiments/output_folder.h"
#include "workbench/experiments/pool/worker_pool.h"
#include "workbench/experiments/run_record.h"

namespace graspbench {

namespace fs = std::filesystem;

namespace {

/** So many tasks a worker are judged before their lines are written, in order. */
constexpr int kBatch = 16;
constexpr char kShardKey[] = "shard";

std::string NameLabel(const std::optional<bool>& label) {
  return !label ? "" : *label ? "success" : "failure";
}

/** All tasks in their order: grasp by grasp, then its disturbances, then the profiles. */
class Tasks {
 public:
  Tasks(const GraspInputs& inputs, const std::vector<FreeSpaceProfile>& profiles, int jitter)
      : inputs_(inputs), profiles_(profiles), num_variants_(static_cast<size_t>(jitter) + 1) {}

  size_t size() const { return inputs_.grasps.size() * num_variants_ * profiles_.size(); }
  size_t GraspOf(size_t task) const { return task / (num_variants_ * profiles_.size()); }
  const GraspInput& InputOf(size_t task) const { return inputs_.grasps[GraspOf(task)]; }
  bool DoesFit(size_t task) const {
    return InputOf(task).unfit.count(task % profiles_.size()) == 0;
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

/** The value under a full key, "drives.law". */
Json FindValue(const Json& config, const std::string& key) {
  const Json* at = &config;
  size_t start = 0;
  for (size_t dot = key.find('.'); dot != std::string::npos; dot = key.find('.', start)) {
    at = &at->at(key.substr(start, dot - start));
    start = dot + 1;
  }
  return at->at(key.substr(start));
}

std::string FormatValue(const Json& value) {
  return value.is_string() ? value.get<std::string>() : FormatJson(value);
}

}  // namespace

Json DescribeRequest(const JudgeGraspsRequest& request, const GraspInputs& inputs) {
  Json config = inputs.description;
  config["jitter"] = request.jitter;
  if (request.shard.count > 1) config[kShardKey] = FormatShard(request.shard);
  config["profiles"] = Json::array();
  for (const FreeSpaceProfile& profile : request.profiles) {
    config["profiles"].push_back({{"name", profile.name}, {"values", ConfigToJson(profile)}});
  }
  Json unread = Json::array();
  for (const UnreadFile& file : inputs.unread) {
    unread.push_back({{"name", file.name}, {"reason", file.reason}});
  }
  config["unread"] = unread;
  return config;
}

bool JudgeGrasps(const JudgeGraspsRequest& request, const GraspInputs& inputs, Observer& observer) {
  PrepareFolder(request.out, DescribeRequest(request, inputs));
  RunRecorder recorder(request.out, request.num_workers, observer);
  const Tasks tasks(inputs, request.profiles, request.jitter);
  GraspJournal journal(request.out / "journal.jsonl");
  std::vector<size_t> left;
  size_t num_own = 0;
  for (size_t task = 0; task < tasks.size(); ++task) {
    if (!IsCardOf(tasks.GraspOf(task), request.shard) || !tasks.DoesFit(task)) continue;
    ++num_own;
    if (!journal.Find(static_cast<int>(task))) left.push_back(task);
  }
  Stage stage = MakeStage(StageKind::kGrasps, num_own);
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
        [&] { recorder.ShowStatus(board.Read(), stage.num_trials); }, observer.stop());
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

void MergeJudgedGrasps(const std::vector<fs::path>& parts, const fs::path& out) {
  Json whole;
  std::map<int, fs::path> folders;  // by the shard's number
  std::vector<JudgedGrasp> judged;
  int num_shards = 0;
  for (const fs::path& part : parts) {
    Json config = LoadGraspConfig(part);
    if (!config.contains(kShardKey)) {
      throw Error(ErrorKind::kUsage,
                  "\"" + part.string() + "\" is not a shard: it holds all grasps");
    }
    const Shard shard = ParseShard(config.at(kShardKey).get<std::string>());
    config.erase(kShardKey);
    if (whole.is_null()) whole = config;
    if (config != whole || (num_shards > 0 && shard.count != num_shards)) {
      throw Error(ErrorKind::kUsage, "\"" + part.string() + "\" and \"" + parts[0].string() +
                                         "\" are shards of different requests");
    }
    num_shards = shard.count;
    if (!folders.emplace(shard.number, part).second) {
      throw Error(ErrorKind::kUsage, "\"" + part.string() + "\" and \"" +
                                         folders.at(shard.number).string() + "\" are both shard " +
                                         FormatShard(shard));
    }
    if (!fs::exists(part / kGraspTable)) {
      throw Error(ErrorKind::kUsage, "shard " + FormatShard(shard) + " in \"" + part.string() +
                                         "\" is not finished; repeat its command to continue");
    }
    for (JudgedGrasp& one : LoadJudgedGrasps(part)) judged.push_back(std::move(one));
  }
  for (int number = 1; number <= num_shards; ++number) {
    if (folders.count(number) > 0) continue;
    throw Error(ErrorKind::kUsage, "shard " + FormatShard({number, num_shards}) + " is missing");
  }
  std::sort(judged.begin(), judged.end(),
            [](const JudgedGrasp& a, const JudgedGrasp& b) { return a.request < b.request; });
  for (size_t i = 1; i < judged.size(); ++i) {
    if (judged[i].request != judged[i - 1].request) continue;
    throw Error(ErrorKind::kUsage, "two shards hold a verdict on " + judged[i].source + ", grasp " +
                                       std::to_string(judged[i].index) + ", under " +
                                       judged[i].profile);
  }
  if (HasJudgedGrasps(out)) {
    throw Error(ErrorKind::kUsage, "\"" + out.string() +
                                       "\" holds judged grasps already; choose "
                                       "another folder with --out");
  }
  PrepareFolder(out, whole);
  GraspJournal(out / "journal.jsonl").Append(judged);
  FinishJudgedGrasps(out, LoadJudgedGrasps(out));
}

std::vector<ExplainStep> ExplainGrasp(const GraspInputs& inputs, const GraspInput& input,
                                      const FreeSpaceProfile& from, const FreeSpaceProfile& to) {
  FreeSpaceProfile profile = from;
  std::vector<ExplainStep> steps = {{"", "", "", JudgeGraspInput(inputs, input, profile), false}};
  const Json before = ConfigToJson(from), after = ConfigToJson(to);
  for (const std::string& key : ListConfigKeys(from)) {
    const Json a = FindValue(before, key), b = FindValue(after, key);
    if (a == b || key == "about" || key == "source") continue;
    SetConfigValue(key + "=" + FormatValue(b), profile);
    ExplainStep step{key, FormatValue(a), FormatValue(b), JudgeGraspInput(inputs, input, profile),
                     false};
    step.turns = step.result.passed != steps.back().result.passed;
    steps.push_back(std::move(step));
  }
  return steps;
}

}  // namespace graspbench
