#include "tests/datasets/journal/store_mutations.h"

#include <algorithm>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "datasets/campaign/campaign_store.h"
#include "datasets/journal/checked_line.h"
#include "datasets/session/judgement_store.h"
#include "tests/datasets/session/fake_session.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

Judgement MakeJudgement(double force) {
  Judgement judgement;
  judgement.loads = {{"force +x", force, true}};
  judgement.breaking_force = force;
  judgement.verdicts = {{"graspa", true, 4.0}};
  return judgement;
}

void MakeInputs(const fs::path& folder) {
  const fs::path block = folder / "inputs" / "objects" / "block";
  MakeFolder(block / "meshes");
  WriteFile(block / "object.yaml", "name: block\nmesh: meshes/block.obj\n");
  WriteFile(block / "meshes" / "block.obj", "v 0 0 0\nv 0 1 0\n");
}

void MakeSession(const fs::path& folder, int trials) {
  if (trials > 2) MakeInputs(folder);
  const auto plan = CreateFakeSession(folder, trials);
  JournalWriter first(folder, 0), second(folder, 1);
  for (size_t i = 0; i < plan.size(); ++i) {
    (i % 2 == 0 ? first : second).Append(MakeFakeRecord(plan[i]));
  }
  JudgementWriter judge(folder, 0);
  for (const PlannedTrial& planned : plan) judge.Append(planned.id, MakeJudgement(trials));
  SealStore(kSessionStore, folder);
}

void FillJournal(const fs::path& path, int count) {
  MakeFolder(path.parent_path());
  EvaluationJournal journal(path);
  for (int i = 0; i < count; ++i) {
    EvaluationRecord record;
    record.request = i;
    record.stage = LearningStage::kSearch;
    record.individual.number = i;
    record.individual.genome = Eigen::Vector2d(0.1, 0.2 * i);
    record.trial_ids = {path.parent_path().filename().string() + std::to_string(i)};
    record.trials.resize(1);
    record.trials[0].outcome = Outcome::kSuccess;
    record.trials[0].sigma = 0.1 * i;
    journal.Append({record});
  }
}

void MakeScene(const fs::path& folder, const std::string& object) {
  SceneConfig config;
  config.hand = "tum";
  config.object = object;
  if (object == "mug") MakeInputs(folder);
  CreateScene(folder, config);
  FillJournal(folder / "journal.jsonl", 6);
  WriteFile(folder / "new-pregrasp.yaml", "pregrasp of: " + object + "\n");
  WriteFile(folder / "new-target.yaml", "target of: " + object + "\n");
  WriteFile(folder / "individuals.csv", "number\n" + object + "\n");
  WriteFile(folder / "result.json", "{\"object\":\"" + object + "\"}\n");
  SealStore(kSceneStore, folder, "hash of " + object);
}

void MakeCampaign(const fs::path& folder) {
  CampaignConfig config;
  config.comparison.scenes = {"tum/mug"};
  MakeInputs(folder);
  CreateCampaign(folder, config);
  MakeScene(folder / "scenes" / "tum-mug", "mug");
  MakeScene(folder / "scenes" / "tum-pencil", "pencil");
  MakeSession(folder / "benchmark", 2);
  FillJournal(folder / "comparison" / "tum-mug" / "es-1.jsonl", 5);
  FillJournal(folder / "comparison" / "tum-mug" / "de-1.jsonl", 4);
  WriteDerived(kCampaignStore, folder, {{"summary.csv", "hand,object\ntum,mug\n"}});
}

void MakeStudy(const fs::path& folder) {
  MakeFolder(folder / "tidy");
  Manifest manifest;
  manifest.kind = "study";
  for (const char* name : {"index.html", "measures.csv", "tidy/data.csv"}) {
    WriteFile(folder / name, std::string("content of ") + name + "\n");
    manifest.files.push_back(SealFile(folder, name));
  }
  WriteManifest(folder, manifest);
}

std::vector<std::string> SplitLines(const std::string& text) {
  std::vector<std::string> lines;
  for (size_t start = 0; start < text.size();) {
    const size_t end = std::min(text.find('\n', start), text.size() - 1) + 1;
    lines.push_back(text.substr(start, end - start));
    start = end;
  }
  return lines;
}

std::string Join(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line;
  return text;
}

bool IsJournal(const std::string& name) {
  return name.find(".jsonl") != name.npos && name.find("plan") == name.npos;
}

bool IsFound(const std::vector<fs::path>& stores) {
  for (const fs::path& store : stores) {
    try {
      if (!CheckStore(store).damages.empty()) return true;
    } catch (const Error&) {
      return true;
    }
  }
  return false;
}

void Repair(const std::vector<fs::path>& stores) {
  for (const fs::path& store : stores) {
    try {
      RepairStore(store);
    } catch (const Error&) {  // beyond repair, and said so
    }
  }
}

}  // namespace

Files ReadFiles(const fs::path& folder) {
  Files files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) {
      files[entry.path().lexically_relative(folder).string()] = ReadFile(entry.path());
    }
  }
  return files;
}

void WriteFiles(const fs::path& folder, const Files& files) {
  const Files now = ReadFiles(folder);
  for (const auto& [name, content] : now) {
    if (files.count(name) == 0) fs::remove(folder / name);
  }
  for (const auto& [name, content] : files) {
    const auto there = now.find(name);
    if (there != now.end() && there->second == content) continue;
    MakeFolder((folder / name).parent_path());
    WriteFile(folder / name, content);
  }
}

std::multiset<std::string> ListRecords(const Files& files) {
  std::multiset<std::string> records;
  for (const auto& [name, content] : files) {
    if (!IsJournal(name)) continue;
    for (std::string line : SplitLines(content)) {
      if (line.back() != '\n') continue;
      line.pop_back();
      try {
        ParseCheckedLine(line);
        records.insert(line);
      } catch (const Error&) {
      }
    }
  }
  return records;
}

Mutator::Mutator(const Files& files, const std::string& seed, int num_kinds)
    : whole_(files), num_kinds_(num_kinds), random_(seed, "mutation") {
  for (const auto& [name, content] : files) {
    names_.push_back(name);
    if (IsJournal(name) && !content.empty()) journals_.push_back(name);
  }
}

std::string Mutator::Mutate(Files& files) {
  files = whole_;
  const std::string name = Choose(names_), other = Choose(names_);
  std::string& content = files[name];
  switch (random_.NextIndex(num_kinds_)) {
    case 0:
    case 1: {
      if (content.empty()) return "";
      const int bit = ChooseIndex(8 * content.size());
      char& byte = content[static_cast<size_t>(bit / 8)];
      byte = static_cast<char>(byte ^ (1 << bit % 8));
      return "flip bit " + std::to_string(bit) + " of " + name;
    }
    case 2:
      if (content.empty()) return "";
      content.resize(static_cast<size_t>(ChooseIndex(content.size())));
      return "cut " + name + " to " + std::to_string(content.size());
    case 3:
      files.erase(name);
      return "delete " + name;
    case 4:
      std::swap(content, files[other]);
      return "swap " + name + " and " + other;
    case 5:
      return MutateLine(files, name, other, "delete");
    case 6:
      return MutateLine(files, name, other, "swap");
    case 7:
      return MutateLine(files, name, other, "move");
    case 8: {
      const size_t digit =
          content.find_first_of("0123456789", static_cast<size_t>(ChooseIndex(content.size() + 1)));
      if (digit == content.npos) return "";
      content[digit] = content[digit] == '9' ? '0' : static_cast<char>(content[digit] + 1);
      return "change digit " + std::to_string(digit) + " of " + name;
    }
    case 9: {
      const size_t at =
          random_.NextIndex(2) ? 0 : static_cast<size_t>(ChooseIndex(content.size() + 1));
      content.insert(at, 1, " \n{x"[random_.NextIndex(4)]);
      return "insert a byte at " + std::to_string(at) + " of " + name;
    }
    case 10:
      content += "{\"trial_id\":\"0123456789abcdef\",\"hand\":\"tu";
      return "begin a line at the end of " + name;
    default:
      return AddLine(files);
  }
}

int Mutator::ChooseIndex(size_t count) { return random_.NextIndex(static_cast<int>(count)); }

const std::string& Mutator::Choose(const std::vector<std::string>& names) {
  return names[static_cast<size_t>(ChooseIndex(names.size()))];
}

std::string Mutator::MutateLine(Files& files, const std::string& name, const std::string& other,
                                const std::string& what) {
  std::vector<std::string> lines = SplitLines(files[name]);
  if (lines.empty()) return "";
  const auto line = static_cast<size_t>(ChooseIndex(lines.size()));
  const std::string taken = lines[line];
  if (what == "swap") {
    std::swap(lines[line], lines[static_cast<size_t>(ChooseIndex(lines.size()))]);
    files[name] = Join(lines);
  } else {
    lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(line));
    files[name] = Join(lines);
    if (what == "move") files[other] += taken;
  }
  return what + " line " + std::to_string(line + 1) + " of " + name +
         (what == "move" ? " to " + other : "");
}

std::string Mutator::AddLine(Files& files) {
  const std::string &from = Choose(journals_), &to = Choose(journals_);
  const std::vector<std::string> lines = SplitLines(whole_.at(from));
  const auto line = static_cast<size_t>(ChooseIndex(lines.size()));
  files[to] += lines[line];
  return "copy line " + std::to_string(line + 1) + " of " + from + " to the end of " + to;
}

std::vector<fs::path> MakeStores(const fs::path& folder) {
  MakeSession(folder / "session", 3);
  MakeSession(folder / "other", 1);
  MakeScene(folder / "scene", "mug");
  MakeCampaign(folder / "campaign");
  MakeStudy(folder / "study");
  return {folder / "session", folder / "other", folder / "scene", folder / "campaign",
          folder / "study"};
}

MutationCount MutateStores(const fs::path& folder, const std::string& seed, int count) {
  const std::vector<fs::path> stores = MakeStores(folder);
  const Files whole = ReadFiles(folder);
  Mutator mutator(whole, seed, kNumHashedMutations);
  MutationCount result;
  if (IsFound(stores)) result.examples += "damage is found in whole stores\n";
  while (result.mutations < count) {
    Files files;
    const std::string what = mutator.Mutate(files);
    if (files == whole) continue;  // two equal lines have changed places
    ++result.mutations;
    WriteFiles(folder, files);
    if (!IsFound(stores)) {
      ++result.undetected;
      result.examples += "undetected: " + what + "\n";
    }
    Repair(stores);
    const auto before = ListRecords(files), after = ListRecords(ReadFiles(folder));
    if (!std::includes(after.begin(), after.end(), before.begin(), before.end())) {
      ++result.records_lost;
      result.examples += "lost records: " + what + "\n";
    }
    WriteFiles(folder, whole);
  }
  return result;
}

}  // namespace graspbench
