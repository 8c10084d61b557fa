#include "datasets/pipeline/pipeline_state.h"

#include <algorithm>
#include <set>

#include "core/base/files/files.h"
#include "core/base/hash.h"
#include "core/base/text/json.h"
#include "datasets/pipeline/stable_files.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

constexpr int kLockSchema = 1;
constexpr char kInput[] = "input ";
constexpr char kGiven[] = "argument ";
constexpr char kParameter[] = "parameter ";
constexpr char kNeeded[] = "stage ";

bool HasPrefix(const std::string& text, const std::string& prefix) {
  return text.compare(0, prefix.size(), prefix) == 0;
}

using TextMap = std::map<std::string, std::string>;

Json ToJson(const TextMap& map) {
  Json json = Json::object();
  for (const auto& [key, value] : map) json[key] = value;
  return json;
}

std::string FormatLock(const PipelineLock& lock) {
  Json stages = Json::object();
  for (const auto& [name, stage] : lock) {
    stages[name] = {{"facts", ToJson(stage.facts)},
                    {"sources", ToJson(stage.sources)},
                    {"files", ToJson(stage.files)}};
  }
  Json json = {{"schema", kLockSchema}, {"stages", stages}};
  json["sha256"] = CalcSha256(FormatJson(json, 1));
  return FormatJson(json, 1) + "\n";
}

std::string JoinValues(const std::vector<std::string>& values) {
  std::string text;
  for (const std::string& value : values) text += (text.empty() ? "" : ", ") + value;
  return values.empty() ? "true" : text;
}

/** But those of other stages. */
StageFacts MakeFacts(const Pipeline& pipeline, const PipelineStage& stage,
                     const StageFacts& program) {
  StageFacts facts = program;
  facts["command"] = stage.command.name;
  for (const StageParameter& parameter : stage.parameters) {
    facts[kParameter + parameter.option] = JoinValues(parameter.values);
  }
  for (const StageInput& input : stage.inputs) {
    if (!input.option.empty()) {
      std::string& given = facts[kGiven + input.option];
      given += (given.empty() ? "" : ", ") + input.path;
    }
    if (!input.stage.empty()) continue;
    const fs::path path = fs::path(pipeline.folder) / input.path;
    const bool is_folder = fs::is_directory(path);
    for (const auto& [file, sha256] : ListStableFiles(path)) {
      facts[kInput + input.path + (is_folder ? "/" + file : "")] = sha256;
    }
  }
  return facts;
}

/** "parameter trials was 3, is 4". */
std::string DescribeChange(const std::string& fact, const std::string* before,
                           const std::string* now) {
  if (fact == "program") return "the program is another build";
  if (fact == "data") return "hands or objects of the program have changed";
  if (HasPrefix(fact, kNeeded)) return fact + " was made again";
  if (HasPrefix(fact, kInput)) {
    return fact + (!before ? " is new" : !now ? " is not read any more" : " has changed");
  }
  if (!before) return fact + " is new: " + *now;
  if (!now) return fact + " was " + *before + ", is not given any more";
  return fact + " was " + *before + ", is " + *now;
}

const std::string* FindValue(const TextMap& map, const std::string& key) {
  const auto found = map.find(key);
  return found == map.end() ? nullptr : &found->second;
}

std::set<std::string> ListKeysOf(const TextMap& a, const TextMap& b) {
  std::set<std::string> keys;
  for (const TextMap* map : {&a, &b}) {
    for (const auto& item : *map) keys.insert(item.first);
  }
  return keys;
}

/** What is not as locked; at most three files and how many more. */
std::vector<std::string> DescribeEdits(const TextMap& before, const TextMap& now, bool& is_edited) {
  constexpr size_t kMaxShown = 3;
  std::vector<std::string> texts;
  for (const std::string& file : ListKeysOf(before, now)) {
    const std::string *was = FindValue(before, file), *is = FindValue(now, file);
    if (was && is && *was == *is) continue;
    is_edited = is_edited || is;
    texts.push_back("result " + file + (!was ? " was added" : !is ? " is missing" : " was edited"));
  }
  if (texts.size() > kMaxShown) {
    const size_t more = texts.size() - kMaxShown;
    texts.resize(kMaxShown);
    texts.push_back("and " + std::to_string(more) + " more of its files");
  }
  return texts;
}

/** Commands make no links: somebody has put one there, and what it leads to is not of the stage. */
void AddLinks(const fs::path& result, StageState& state) {
  const auto add = [&](const std::string& text) {
    state.is_edited = true;
    state.reasons.push_back(text);
  };
  if (fs::is_symlink(result)) return add("its result was replaced by a link");
  for (const auto& entry : fs::recursive_directory_iterator(result)) {
    if (!entry.is_symlink()) continue;
    return add("result " + entry.path().lexically_relative(result).generic_string() +
               " was replaced by a link");
  }
}

fs::path FindFailure(const fs::path& results, const std::string& stage) {
  return results / kStageLogs / (stage + ".failed");
}

void FindReasons(const PipelineStage& stage, const fs::path& results, const PipelineLock& lock,
                 const std::set<std::string>& stale, StageState& state) {
  std::error_code status;
  if (fs::exists(FindFailure(results, stage.name), status)) {
    state.reasons.push_back("it failed with exit code " +
                            ReadFile(FindFailure(results, stage.name)) + "; it said why in " +
                            kStageLogs + "/" + stage.name + ".txt");
    return;
  }
  const auto found = lock.find(stage.name);
  if (found == lock.end()) {
    state.reasons.push_back("it has not run yet");
    return;
  }
  const LockedStage& locked = found->second;
  for (const std::string& fact : ListKeysOf(locked.facts, state.facts)) {
    const std::string *before = FindValue(locked.facts, fact), *now = FindValue(state.facts, fact);
    if (before && now && *before == *now) continue;
    const std::string name = HasPrefix(fact, kNeeded) ? fact.substr(sizeof kNeeded - 1) : "";
    const bool waits = now && !name.empty() && stale.count(name) > 0;
    state.reasons.push_back(waits ? fact + " is stale" : DescribeChange(fact, before, now));
  }
  const fs::path result = results / stage.name;
  if (!fs::is_directory(result, status)) {
    state.reasons.push_back("its result is missing");
  } else {
    const auto edits = DescribeEdits(locked.files, ListStableFiles(result), state.is_edited);
    state.reasons.insert(state.reasons.end(), edits.begin(), edits.end());
    AddLinks(result, state);
  }
  // The same key and yet other bytes: another processor, or a stage that is not reproducible.
  for (const auto& [needed, sha256] : locked.sources) {
    const auto source = lock.find(needed);
    if (!state.reasons.empty() || source == lock.end()) continue;
    if (CalcStableSha256(source->second.files) != sha256) {
      state.reasons.push_back("stage " + needed + " gave different bytes in a repetition");
    }
  }
}

}  // namespace

PipelineLock LoadPipelineLock(const fs::path& results) {
  const fs::path path = results / kPipelineLock;
  std::error_code status;
  if (!fs::exists(path, status)) return {};
  const std::string text = ReadFile(path);
  try {
    const Json json = Json::parse(text);
    PipelineLock lock;
    for (const auto& [name, stage] : json.at("stages").items()) {
      lock[name] = {stage.at("facts").get<TextMap>(), stage.at("sources").get<TextMap>(),
                    stage.at("files").get<TextMap>()};
    }
    if (json.at("schema") == kLockSchema && FormatLock(lock) == text) return lock;
  } catch (const Json::exception&) {
  }
  throw Error(ErrorKind::kFormat,
              "\"" + path.string() +
                  "\" was changed; remove it, and the next run makes every stage again and keeps "
                  "the present results as <stage>.set-aside");
}

void WritePipelineLock(const fs::path& results, const PipelineLock& lock) {
  WriteFileAtomically(results / kPipelineLock, FormatLock(lock));
}

std::string CalcStageKey(const StageFacts& facts) {
  Sha256 sum;
  for (const auto& [name, value] : facts) sum.Add(name + '\n' + value + '\n');
  return sum.CalcDigest();
}

std::vector<StageState> FindStageStates(const Pipeline& pipeline, const fs::path& results,
                                        const PipelineLock& lock, const StageFacts& program) {
  std::vector<StageState> states;
  TextMap keys;
  std::set<std::string> stale;
  for (const PipelineStage& stage : pipeline.stages) {
    StageState state;
    state.stage = stage.name;
    state.facts = MakeFacts(pipeline, stage, program);
    for (const std::string& needed : stage.ListNeeded()) {
      state.facts[kNeeded + needed] = keys.at(needed);
    }
    FindReasons(stage, results, lock, stale, state);
    keys[stage.name] = CalcStageKey(state.facts);
    if (!state.IsFresh()) stale.insert(stage.name);
    states.push_back(std::move(state));
  }
  return states;
}

void KeepFailure(const fs::path& results, const std::string& stage, int exit_code) {
  WriteFileAtomically(FindFailure(results, stage), std::to_string(exit_code));
}

void ForgetFailure(const fs::path& results, const std::string& stage) {
  fs::remove(FindFailure(results, stage));
}

LockedStage MakeLockedStage(const PipelineStage& stage, const StageFacts& facts,
                            const fs::path& results, const PipelineLock& lock) {
  LockedStage locked;
  locked.facts = facts;
  for (const std::string& needed : stage.ListNeeded()) {
    locked.sources[needed] = CalcStableSha256(lock.at(needed).files);
  }
  locked.files = ListStableFiles(results / stage.name);
  return locked;
}

}  // namespace graspbench
