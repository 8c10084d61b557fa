#include "datasets/benchmark/entry_pack.h"

#include <regex>
#include <set>
#include <tuple>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "core/base/text/text.h"
#include "datasets/journal/checked_line.h"
#include "datasets/journal/sealed_store.h"
#include "datasets/pipeline/pipeline_pack.h"
#include "datasets/pipeline/stable_files.h"
#include "datasets/session/find_trial.h"
#include "datasets/session/ro_crate.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

constexpr char kFactsFile[] = "entry.json";
constexpr char kSessionFolder[] = "session";

[[noreturn]] void Refuse(const std::string& reason) { throw Error(ErrorKind::kUsage, reason); }

size_t CountCharacters(std::string_view text) {
  size_t count = 0;
  for (; !text.empty(); ++count) text.remove_prefix(ReadCodePoint(text).size);
  return count;
}

void CheckText(const std::string& what, const std::string& text, size_t most) {
  if (!IsUtf8(text)) Refuse("the entry's " + what + " is not UTF-8");
  if (text.find_first_not_of(" \t\n\r") == text.npos) Refuse("the entry's " + what + " is empty");
  if (const size_t count = CountCharacters(text); count > most) {
    Refuse("the entry's " + what + " has " + std::to_string(count) +
           " characters; expected at most " + std::to_string(most));
  }
}

/** Each hand meets each draw once, so that no best of several attempts counts. */
void CheckDraws(const Session& session, const Benchmark& benchmark) {
  std::set<std::tuple<std::string, std::string, int>> draws;
  for (const PlannedTrial& planned : session.plan) {
    if (draws.emplace(planned.hand, planned.object, planned.trial).second) continue;
    Refuse("the plan has the draw " + NameTrial(planned) +
           " with more than one grasp; an entry has one for each draw");
  }
  const size_t num =
      session.config.hands.size() * benchmark.objects.size() * size_t(benchmark.session.trials);
  if (draws.size() != num) {
    Refuse("the plan has " + std::to_string(draws.size()) + " draws; " + benchmark.name + " has " +
           std::to_string(num) + " of these hands");
  }
}

void CheckPlan(const Session& session, const SessionInputs& inputs) {
  const std::vector<PlannedTrial> plan = MakePlan(session.config, inputs);
  for (size_t i = 0; i < plan.size() && i < session.plan.size(); ++i) {
    if (plan[i] == session.plan[i]) continue;
    Refuse("the plan is not what configuration, hand, object and grasps give: line " +
           std::to_string(i + 1) + " is " + NameTrial(session.plan[i]) + " with id " +
           session.plan[i].id + ", expected " + NameTrial(plan[i]) + " with id " + plan[i].id);
  }
  if (plan.size() == session.plan.size()) return;
  Refuse("the plan has " + FormatCount(int64_t(session.plan.size()), "trial") + "; expected " +
         std::to_string(plan.size()));
}

void CheckFinished(const Session& session) {
  const std::vector<PlannedTrial> left = FindUnfinished(session);
  if (!left.empty()) {
    Refuse(FormatCount(int64_t(left.size()), "trial is", "trials are") + " not finished, first " +
           NameTrial(left.front()));
  }
  if (session.config.policy.command.empty()) return;
  for (const TrialRecord& record : session.records) {
    if (record.result.policy) continue;
    Refuse("its controller is an external program, and trial " + NameTrial(record.plan) +
           " has no recorded actions");
  }
}

bool IsOfEntry(const std::string& path) {
  const std::string prefix = std::string(kSessionFolder) + "/";
  if (path == kFactsFile) return true;
  if (path.compare(0, prefix.size(), prefix) != 0) return false;
  const std::string name = path.substr(prefix.size());
  return name == kManifestFile || name.rfind("inputs/grasps/", 0) == 0 ||
         IsMatch(name, {"session.json", "plan.jsonl", "inputs/policies.json", "journal/0.jsonl"});
}

/** Only what GatherEntry writes: a hand of its own would be taken for the program's. */
void CheckFiles(const Manifest& manifest) {
  for (const ManifestFile& file : manifest.files) {
    if (!IsOfEntry(file.path)) Refuse("the pack holds \"" + file.path + "\", which no entry has");
  }
}

/** Equal lines cost a store nothing, but a packed session has each once. */
void CheckLines(const Session& session) {
  size_t num_lines = 0;
  ForEachLine(ReadFile(session.folder / "journal" / "0.jsonl"),
              [&](std::string_view, int, bool) { ++num_lines; });
  if (num_lines == session.records.size()) return;
  Refuse("its journal has " + FormatCount(int64_t(num_lines), "line") + " for " +
         FormatCount(int64_t(session.records.size()), "trial") + "; expected one for each");
}

/** A grasp file without its copy would be looked for on this machine. */
void CheckGraspCopies(const Session& session) {
  const std::vector<std::string>& grasps = session.config.grasps;
  for (size_t i = 0; i < grasps.size(); ++i) {
    if (IsGraspFile(grasps[i]) && FindGraspInput(grasps[i], i, session.folder) == grasps[i]) {
      Refuse("the grasp file \"" + grasps[i] + "\" is not in the pack");
    }
  }
}

EntryFacts ReadFacts(const fs::path& file) {
  EntryFacts facts;
  try {
    ReadRecord(Json::parse(ReadFile(file)), facts);
  } catch (const Json::exception& fault) {
    Refuse(std::string("entry.json cannot be read: ") + fault.what());
  }
  CheckFacts(facts);
  return facts;
}

}  // namespace

void CheckFacts(const EntryFacts& facts) {
  CheckText("name", facts.name, kLongestName);
  CheckText("author", facts.by, kLongestName);
  CheckText("licence", facts.licence, kLongestName);
  CheckText("text on its method", facts.notes, kLongestNotes);
  static const std::regex date("[0-9]{4}-(0[1-9]|1[0-2])-(0[1-9]|[12][0-9]|3[01])");
  if (facts.date.empty() || std::regex_match(facts.date, date)) return;
  Refuse("the entry's date \"" + facts.date + "\" is none; expected one as 2026-11-28");
}

void CheckEntry(const Session& session, const SessionInputs& inputs, const Benchmark& benchmark) {
  if (session.physics_version != benchmark.physics) {
    throw Error(ErrorKind::kVersion, "its trials were simulated with physics version " +
                                         std::to_string(session.physics_version) + "; " +
                                         benchmark.name + " is of version " +
                                         std::to_string(benchmark.physics));
  }
  CheckSettings(benchmark, session.config);
  CheckPins(benchmark, inputs);
  CheckDraws(session, benchmark);
  CheckPlan(session, inputs);
  CheckFinished(session);
}

void GatherEntry(const Session& session, const EntryFacts& facts, const fs::path& folder) {
  CheckFacts(facts);
  const fs::path packed = folder / kSessionFolder;
  CopyStableFiles(session.folder, packed);
  std::error_code status;
  for (const auto& entry : fs::directory_iterator(packed)) {
    const std::string name = entry.path().filename().string();
    if (name == "session.json" || name == "plan.jsonl" || name == "inputs" || name == "journal") {
      continue;
    }
    fs::remove_all(entry.path(), status);
  }
  SealStore(kSessionStore, packed, FindManifest(session.folder).value_or(Manifest()).inputs);
  WriteFile(folder / kFactsFile, FormatJson(RecordToJson(facts), 2) + "\n");
  SealPack(folder, kEntryPack, MakeOrigin("graspbench entry SESSION"));
}

Entry LoadEntry(const fs::path& pack, const fs::path& folder, const Benchmark& benchmark) {
  CheckFiles(Unpack(pack, folder, kEntryPack));
  Entry entry;
  entry.facts = ReadFacts(folder / kFactsFile);
  if (entry.facts.benchmark != benchmark.name) {
    Refuse("it is an entry of " + entry.facts.benchmark + " and not of " + benchmark.name);
  }
  if (entry.facts.benchmark_sha256 != benchmark.sha256) {
    Refuse("it was made for another file of " + benchmark.name + " (SHA-256 " +
           entry.facts.benchmark_sha256.substr(0, 16) + ".., here " +
           benchmark.sha256.substr(0, 16) + "..)");
  }
  entry.session = LoadSession(folder / kSessionFolder, OnDamage::kRefuse, RecordParts::kBrief);
  CheckSettings(benchmark, entry.session.config);  // before a name in it is looked for
  CheckGraspCopies(entry.session);
  entry.inputs = LoadSessionInputs(entry.session.config, FieldUse::kLater, entry.session.folder);
  CheckEntry(entry.session, entry.inputs, benchmark);
  CheckLines(entry.session);
  return entry;
}

std::string DescribeYear(const EntryFacts& facts) {
  return facts.date.empty() ? "not declared" : facts.date.substr(0, 4);
}

std::string DescribeController(const SessionConfig& config) {
  const std::string text = config.policy.command.empty() ? "strategy" : "recorded actions";
  return HasArm(config.arm) ? text + ", arm " + config.arm.model : text;
}

std::string DescribeSensing(const SessionConfig& config) {
  std::string text = "pose " + config.positioning;
  if (!config.policy.command.empty()) text += ", controller told " + config.policy.object_pose;
  return text + ", touch " + config.touch;
}

}  // namespace graspbench
