#include "datasets/journal/store_kind.h"

#include <fnmatch.h>

#include <algorithm>

namespace graspbench {
namespace fs = std::filesystem;

namespace {

void AddMatches(const fs::path& folder, const fs::path& inside, const std::string& pattern,
                std::vector<std::string>& names) {
  const size_t slash = pattern.find('/');
  const std::string part = pattern.substr(0, slash);
  std::error_code status;
  if (part.find('*') == std::string::npos) {
    const fs::path name = inside / part;
    if (slash != std::string::npos) {
      AddMatches(folder, name, pattern.substr(slash + 1), names);
    } else if (fs::exists(fs::symlink_status(folder / name, status))) {
      names.push_back(name.generic_string());
    }
    return;
  }
  const std::string head = part.substr(0, part.find('*')), tail = part.substr(part.find('*') + 1);
  for (const auto& entry : fs::directory_iterator(folder / inside, status)) {
    const std::string name = entry.path().filename().string();
    if (name.size() < head.size() + tail.size() || name[0] == '.' ||
        name.compare(0, head.size(), head) != 0 ||
        name.compare(name.size() - tail.size(), tail.size(), tail) != 0) {
      continue;
    }
    if (slash == std::string::npos) {
      names.push_back((inside / name).generic_string());
    } else {
      AddMatches(folder, inside / name, pattern.substr(slash + 1), names);
    }
  }
}

/** The questions and answers of a search: answer_journal.h. */
LineKind MakeEvaluationLines(const char* journals, const char* result) {
  return {{journals}, {"stage", "trials"}, "id", "request", result};
}

const LineKind kWorkerLines = {{"workers/*.jsonl"}, {"shard"}};

}  // namespace

const StoreKind kSessionStore = {
    /*name=*/"session",
    /*file=*/"session.json",
    /*schema=*/7,
    /*command=*/"graspbench run",
    /*remedy=*/"rerun the session into a new folder",
    /*files=*/
    {"session.json", "plan.jsonl", "inputs/policies.json", "inputs/grasps/*", "inputs/*/*/*",
     "inputs/*/*/*/*"},
    /*derived=*/{"basin.csv"},
    /*journals=*/{"journal/*.jsonl", "judge/*.jsonl", "explain/*.jsonl", "workers/*.jsonl"},
    /*stores=*/{"sensitivity/*", "numerics/*", "delays/*", "thresholds/*", "map/*", "schedules/*"},
    /*keeps_torn_lines=*/true,
    /*shared_journals=*/
    {"journal/*-*.jsonl", "judge/*-*.jsonl", "explain/*-*.jsonl", "workers/*-*.jsonl"},
    /*outputs=*/{"check-numerics", "export", "report"},
    /*lines=*/
    {{{"journal/*.jsonl"}, {"trial_id", "hand", "result"}},
     {{"judge/*.jsonl"}, {"trial_id", "judge_version", "judgement"}},
     {{"explain/*.jsonl"}, {"trial_id", "explain_version", "explanation"}},
     kWorkerLines}};
const StoreKind kSceneStore = {
    /*name=*/"optimisation",
    /*file=*/"scene.json",
    /*schema=*/6,
    /*command=*/"graspbench optimise",
    /*remedy=*/"optimise into a new folder",
    /*files=*/{"scene.json", "inputs/grasps/*", "inputs/*/*/*", "inputs/*/*/*/*"},
    /*derived=*/{"result.json", "new-*.yaml", "individuals.csv"},
    /*journals=*/{"journal.jsonl"},
    /*stores=*/{},
    /*keeps_torn_lines=*/false,
    /*shared_journals=*/{},
    /*outputs=*/{},
    /*lines=*/{MakeEvaluationLines("journal.jsonl", "result.json")}};
const StoreKind kCampaignStore = {
    /*name=*/"campaign",
    /*file=*/"campaign.json",
    /*schema=*/5,
    /*command=*/"graspbench campaign",
    /*remedy=*/"rerun the campaign into a new folder",
    /*files=*/
    {"campaign.json", "scenes/*/scene.json", "benchmark/session.json", "inputs/*/*/*",
     "inputs/*/*/*/*"},
    /*derived=*/{"summary.csv", "comparison.csv"},
    /*journals=*/{"comparison/*/*.jsonl", "workers/*.jsonl"},
    /*stores=*/{"scenes/*", "benchmark"},
    /*keeps_torn_lines=*/false,
    /*shared_journals=*/{"workers/*-*.jsonl"},
    /*outputs=*/{"real", "report"},
    /*lines=*/{MakeEvaluationLines("comparison/*/*.jsonl", ""), kWorkerLines}};
const StoreKind kDevelopmentStore = {
    /*name=*/"development",
    /*file=*/"development.json",
    /*schema=*/1,
    /*command=*/"graspbench hand develop",
    /*remedy=*/"develop the hand into a new folder",
    /*files=*/{"development.json"},
    /*derived=*/{"result.json"},
    /*journals=*/{"journal.jsonl"},
    /*stores=*/{},
    /*keeps_torn_lines=*/false,
    /*shared_journals=*/{},
    /*outputs=*/{},
    /*lines=*/
    {{{"journal.jsonl"}, {"request", "stage", "id", "trials"}, "", "request", "result.json"}}};
const StoreKind kJudgedGraspStore = {
    /*name=*/"grasp judgement",
    /*file=*/"grasps.json",
    /*schema=*/1,
    /*command=*/"graspbench grasps judge",
    /*remedy=*/"judge the grasps into a new folder",
    /*files=*/{"grasps.json"},
    /*derived=*/{"grasps.csv"},
    /*journals=*/{"journal.jsonl"},
    /*stores=*/{},
    /*keeps_torn_lines=*/false,
    /*shared_journals=*/{},
    /*outputs=*/{"report"},
    /*lines=*/{{{"journal.jsonl"}, {"request", "profile", "result"}, "", "request", "grasps.csv"}}};
const StoreKind kRehearsalStore = {
    /*name=*/"rehearsal",
    /*file=*/"rehearsal.json",
    /*schema=*/1,
    /*command=*/"graspbench rehearse",
    /*remedy=*/"rehearse into a new folder",
    /*files=*/{"rehearsal.json"},
    /*derived=*/
    {"candidates.csv", "types.json", "grasps/*/*.yaml", "isaac/*/*.yaml", "dexgraspbench/*/*.npy"},
    /*journals=*/{"journal.jsonl"},
    /*stores=*/{},
    /*keeps_torn_lines=*/false,
    /*shared_journals=*/{},
    /*outputs=*/{"report"},
    /*lines=*/
    {{{"journal.jsonl"}, {"request", "hash", "result"}, "", "request", "candidates.csv"}}};

const StoreKind* FindStoreKind(const fs::path& folder) {
  for (const StoreKind* kind : {&kCampaignStore, &kSessionStore, &kSceneStore, &kDevelopmentStore,
                                &kJudgedGraspStore, &kRehearsalStore}) {
    std::error_code status;
    if (fs::exists(folder / kind->file, status)) return kind;
  }
  return nullptr;
}

bool IsMatch(const std::string& name, const std::vector<std::string>& patterns) {
  return std::any_of(patterns.begin(), patterns.end(), [&](const std::string& pattern) {
    return ::fnmatch(pattern.c_str(), name.c_str(), FNM_PATHNAME | FNM_PERIOD) == 0;
  });
}

std::vector<std::string> ListMatches(const fs::path& folder,
                                     const std::vector<std::string>& patterns) {
  std::vector<std::string> names;
  for (const std::string& pattern : patterns) AddMatches(folder, {}, pattern, names);
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

}  // namespace graspbench
