#include "datasets/judged_grasps/grasp_store.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/config.h"
#include "core/base/text/record_fields.h"
#include "datasets/journal/checked_line.h"
#include "datasets/plan/frozen_folder.h"

namespace graspbench {

namespace fs = std::filesystem;

namespace {

constexpr size_t kMostNearest = 100;
constexpr char kSuccess[] = "success";

using GraspKey = std::pair<std::string, int>;
GraspKey KeyOf(const JudgedGrasp& judged) { return {judged.source, judged.index}; }

ProfileSummary& FindProfile(const std::string& name, std::vector<ProfileSummary>& profiles) {
  for (ProfileSummary& profile : profiles) {
    if (profile.profile == name) return profile;
  }
  profiles.emplace_back().profile = name;
  return profiles.back();
}

std::vector<std::pair<std::string, int>> SortByCount(const std::map<std::string, int>& counts) {
  std::vector<std::pair<std::string, int>> sorted(counts.begin(), counts.end());
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const auto& a, const auto& b) { return a.second > b.second; });
  return sorted;
}

constexpr char kJournal[] = "journal.jsonl";

std::vector<CsvColumn<JudgedGrasp>> ListColumns() {
  std::vector<CsvColumn<JudgedGrasp>> columns;
  AddFieldColumns<JudgedGrasp>([](const JudgedGrasp& j) -> const JudgedGrasp& { return j; },
                               columns);
  AddFieldColumns<FreeSpaceResult>(
      [](const JudgedGrasp& j) -> const FreeSpaceResult& { return j.result; }, columns);
  return columns;
}

/** How far from the border of pass and fail: the larger share of shift and turn that a pass used is
below 1, of a failure above it; the distance of its logarithm from 0. Infinite where a grasp failed
before it was tested. */
double CalcMargin(const JudgedGrasp& judged, double max_shift, double max_turn_deg) {
  const FreeSpaceResult& result = judged.result;
  const double used =
      std::max(result.worst_shift / max_shift, result.worst_turn_deg / max_turn_deg);
  return used > 0.0 ? std::abs(std::log(used)) : std::numeric_limits<double>::infinity();
}

}  // namespace

double CalcKappa(const PairedCounts& counts) {
  const double n = counts.num_pairs();
  const double observed = (counts.both + counts.neither) / n;
  const double first = (counts.both + counts.first_only) / n;
  const double second = (counts.both + counts.second_only) / n;
  const double expected = first * second + (1.0 - first) * (1.0 - second);
  return expected < 1.0 ? (observed - expected) / (1.0 - expected) : kUnset;
}

JudgedSummary SummariseJudged(const std::vector<JudgedGrasp>& judged,
                              const std::map<std::string, std::pair<double, double>>& limits) {
  JudgedSummary summary;
  std::map<std::string, std::map<GraspKey, bool>> verdicts;  // by profile
  std::map<std::string, std::map<std::string, int>> stages;  // by profile
  std::map<std::string, std::pair<int, int>> disturbed;      // passed, all
  std::vector<std::pair<double, const JudgedGrasp*>> margins;
  for (const JudgedGrasp& one : judged) {
    if (one.jitter > 0) continue;
    ProfileSummary& profile = FindProfile(one.profile, summary.profiles);
    ++profile.num_judged;
    profile.num_passed += one.result.passed;
    profile.num_numerical += one.result.is_numerical;
    if (!one.result.passed) ++stages[one.profile][one.result.failed_stage];
    if (!one.label.empty()) profile.labels.Add(one.label == kSuccess, one.result.passed);
    verdicts[one.profile][KeyOf(one)] = one.result.passed;
    const auto& [max_shift, max_turn_deg] = limits.at(one.profile);
    const double margin = CalcMargin(one, max_shift, max_turn_deg);
    if (std::isfinite(margin)) margins.emplace_back(margin, &one);
  }
  for (const JudgedGrasp& one : judged) {
    if (one.jitter == 0 || !verdicts[one.profile][KeyOf(one)]) continue;
    disturbed[one.profile].first += one.result.passed;
    ++disturbed[one.profile].second;
  }
  for (ProfileSummary& profile : summary.profiles) {
    profile.stages = SortByCount(stages[profile.profile]);
    const auto& [passed, all] = disturbed[profile.profile];
    profile.jitter_share = CalcShare(passed, all);
    summary.num_grasps = std::max(summary.num_grasps, profile.num_judged);
  }
  for (size_t p = 0; p + 1 < summary.profiles.size(); ++p) {
    ProfileTransition transition{summary.profiles[p].profile, summary.profiles[p + 1].profile, {}};
    const auto& to = verdicts[transition.to];
    for (const auto& [key, passed] : verdicts[transition.from]) {
      if (const auto found = to.find(key); found != to.end()) {
        transition.counts.Add(passed, found->second);
      }
    }
    summary.transitions.push_back(transition);
  }
  std::stable_sort(margins.begin(), margins.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  for (const auto& margin : margins) {
    if (summary.nearest.size() < kMostNearest) summary.nearest.push_back(margin.second);
  }
  return summary;
}

std::map<std::string, std::pair<double, double>> FindLimits(const Json& config) {
  std::map<std::string, std::pair<double, double>> limits;
  try {
    for (const Json& profile : config.at("profiles")) {
      limits[profile.at("name").get<std::string>()] = {
          profile.at("values").at("max_shift_m").get<double>(),
          profile.at("values").at("max_turn_deg").get<double>()};
    }
  } catch (const Json::exception& e) {
    throw Error(ErrorKind::kFormat, std::string("grasps.json holds no profiles: ") + e.what());
  }
  return limits;
}

std::string JudgedGrasp::Format(const JudgedGrasp& record) {
  return FormatCheckedLine(RecordToJson(record));
}

JudgedGrasp JudgedGrasp::Parse(std::string_view line) {
  return ReadCheckedLine(line, [](const Json& json) {
    JudgedGrasp record;
    ReadRecord(json, record);
    return record;
  });
}

bool HasJudgedGrasps(const fs::path& folder) { return HasFrozen(kJudgedGraspStore, folder); }

void CreateJudgedGrasps(const fs::path& folder, const Json& config) {
  WriteFrozen(kJudgedGraspStore, folder, config);
}

void CheckSameGrasps(const fs::path& folder, const Json& config) {
  CheckSameFrozen(kJudgedGraspStore, folder, config);
}

Json LoadGraspConfig(const fs::path& folder) {
  return LoadFrozen(kJudgedGraspStore, folder).config;
}

std::vector<JudgedGrasp> LoadJudgedGrasps(const fs::path& folder) {
  LoadFrozen(kJudgedGraspStore, folder);
  Diagnostics findings;
  std::vector<Damage> damage;
  std::vector<JudgedGrasp> judged = LoadAnswers<JudgedGrasp>(folder / kJournal, findings, damage);
  RefuseAnswers(folder, damage, OnDamage::kRefuse);
  return judged;
}

Json MakeGraspTableSchema() { return MakeTableSchema(ListColumns(), ""); }

void FinishJudgedGrasps(const fs::path& folder, const std::vector<JudgedGrasp>& judged) {
  WriteDerived(kJudgedGraspStore, folder,
               {{kGraspTable, FormatCsv(ListColumns(), judged)},
                {"grasps.schema.json", FormatJson(MakeGraspTableSchema(), 2) + "\n"}});
}

}  // namespace graspbench
