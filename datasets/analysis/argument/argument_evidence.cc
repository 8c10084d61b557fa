#include "datasets/analysis/argument/argument_evidence.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "core/base/text/delimited_text.h"
#include "core/base/text/text.h"
#include "core/base/units.h"
#include "datasets/plan/map_design.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

constexpr char kStatistics[] = "statistics.csv";
constexpr int kDeepest = 4;  // folders within folders that are searched for results

// As human_study/study/output/statistics_table.h writes them; tests/reports holds both together.
constexpr char kVerdictAnalysis[] = "independent digits, verdict";
constexpr char kGft[] = "grasp_forming_time_s";

}  // namespace

PeopleEvidence ReadPeopleEvidence(const std::string& text, const std::string& file) {
  Diagnostics problems;
  DataTable table(text, file, problems);
  for (const char* column : {"measure", "analysis", "effect", "estimate", "low", "high", "value",
                             "effect_size", "num_persons", "note"}) {
    table.Require(column);
  }
  problems.ThrowIfErrors(ErrorKind::kFormat, "the study's statistics cannot be read");
  for (size_t row = 0; row < table.num_rows(); ++row) {
    if (table.Text(row, "analysis") != kVerdictAnalysis || table.Text(row, "measure") != kGft) {
      continue;
    }
    PeopleEvidence people;
    people.verdict = table.Text(row, "effect");
    people.ratio = table.Number(row, "estimate");
    people.interval = {table.Number(row, "low"), table.Number(row, "high")};
    people.gft = table.Number(row, "value");
    people.detectable = table.Number(row, "effect_size");
    const double persons = table.Number(row, "num_persons");
    people.num_persons = std::isfinite(persons) ? static_cast<int>(persons) : 0;
    people.note = UnguardCell(table.Text(row, "note"));
    problems.ThrowIfErrors(ErrorKind::kFormat, "the study's statistics cannot be read");
    return people;
  }
  throw Error(ErrorKind::kFormat, file + ": no row \"" + kVerdictAnalysis + "\" of " + kGft +
                                      "; run the study again with this program: graspbench study "
                                      "run STUDY.yaml --out DIR");
}

std::string ArgumentSources::Describe() const {
  std::string text;
  const auto add = [&text](size_t count, const char* what, const char* plural) {
    if (count == 0) return;
    text += (text.empty() ? "" : ", ") +
            (count == 1 ? std::string("1 ") + what : std::to_string(count) + " " + plural);
  };
  const auto num_synthetic = static_cast<size_t>(std::count_if(
      people.begin(), people.end(), [](const auto& one) { return one.is_synthetic; }));
  add(people.size() - num_synthetic, "study", "studies");
  add(num_synthetic, "study of synthetic participants", "studies of synthetic participants");
  add(maps.size(), "map", "maps");
  add(campaigns.size(), "campaign", "campaigns");
  add(scenes.size(), "optimised scene", "optimised scenes");
  add(sessions.size(), "session", "sessions");
  return text;
}

namespace {

/** @returns whether there was a result. @param name  of the folder in results. */
bool LoadFolder(const fs::path& folder, const std::string& name, int depth,
                ArgumentSources& sources) {
  if (fs::exists(folder / kStatistics)) {
    const fs::path file = folder / kStatistics;
    sources.people.push_back(ReadPeopleEvidence(ReadFile(file), name + "/" + kStatistics));
    sources.people.back().folder = name;
    sources.people.back().is_synthetic = fs::exists(folder / "input" / "study.yaml");
    return true;
  }
  const StoreKind* const kind = FindStoreKind(folder);
  if (kind == &kCampaignStore) {
    sources.campaigns.push_back({name, LoadCampaign(folder)});
    for (const SceneRecord& scene : sources.campaigns.back().result.scenes) {
      sources.scenes.push_back({name, scene});
      sources.scenes.back().result.evaluations.clear();
    }
    return true;
  }
  if (kind == &kSceneStore) {
    sources.scenes.push_back({name, LoadScene(folder)});
    sources.scenes.back().result.evaluations.clear();
    return true;
  }
  if (kind == &kSessionStore) {
    Session session = LoadSession(folder, OnDamage::kRefuse, RecordParts::kBrief);
    if (IsMap(session.config)) {
      sources.maps.push_back({name, LoadMap(session)});
    } else {
      sources.sessions.push_back({name, std::move(session)});
    }
    return true;
  }
  if (kind != nullptr || depth == 0) return kind != nullptr;
  std::vector<fs::path> inside;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.is_directory()) inside.push_back(entry.path());
  }
  std::sort(inside.begin(), inside.end());
  bool is_any = false;
  for (const fs::path& path : inside) {
    is_any |= LoadFolder(path, name + "/" + path.filename().string(), depth - 1, sources);
  }
  return is_any;
}

}  // namespace

ArgumentSources LoadArgumentSources(const std::vector<fs::path>& folders) {
  ArgumentSources sources;
  for (const fs::path& folder : folders) {
    if (!fs::is_directory(folder)) {
      throw Error(ErrorKind::kNotFound, folder.string() +
                                            ": no such folder; expected a result of graspbench "
                                            "study run, map, optimise, campaign or run");
    }
    const fs::path plain = fs::absolute(folder).lexically_normal();
    const std::string name =
        (plain.has_filename() ? plain : plain.parent_path()).filename().string();
    if (!LoadFolder(folder, name, kDeepest, sources)) {
      throw Error(ErrorKind::kUsage, folder.string() +
                                         ": contains no study, map, optimisation, campaign or "
                                         "session; expected finished results");
    }
  }
  return sources;
}

std::vector<ArgumentNumber> ListPeopleNumbers(const std::vector<PeopleEvidence>& people) {
  std::vector<ArgumentNumber> numbers;
  for (const PeopleEvidence& study : people) {
    ArgumentNumber number;
    number.measure = &kPeopleRatio;
    number.subject = study.folder + (study.is_synthetic ? " (synthetic participants)" : "");
    number.decides = !study.is_synthetic;
    number.value = study.ratio;
    number.interval = study.interval;
    number.n = study.num_persons;
    number.of = "person";
    number.detail = study.note;
    if (std::isfinite(study.gft)) {
      number.detail = "mean GFT " + FormatFixed(MsFromS(study.gft), 1) + " ms; " + number.detail;
    }
    number.source = study.folder;
    number.command = study.is_synthetic ? "graspbench study demo --out DIR"
                                        : "graspbench study run STUDY.yaml --out DIR";
    if (!std::isfinite(number.interval.low)) {
      number.would_decide =
          "recordings of 5 persons or more instead of " + std::to_string(number.n);
    }
    Judge(number);
    // The study's verdict asks three clocks and a bound of their error; an interval cannot show it.
    if (study.verdict == "more simultaneous") {
      if (std::isfinite(number.interval.low)) number.verdict = ArgumentVerdict::kShown;
    } else if (number.verdict == ArgumentVerdict::kShown) {
      number.verdict = ArgumentVerdict::kNotDecided;
      number.why = "the study's own verdict is \"" + study.verdict + "\"";
      number.would_decide =
          "an external start signal with recorded time, or trials in which one digit alone is "
          "delayed at random";
    }
    if (number.verdict != ArgumentVerdict::kNotDecided) number.would_decide.clear();
    numbers.push_back(number);
  }
  return numbers;
}

namespace {

/** "1 of 93 single regions show a cost". */
std::string DescribeRegions(const SimultaneityMap& map, const std::string& hand) {
  int num_regions = 0, num_costs = 0;
  for (const MapCell& region : map.cells) {
    if (region.hand != hand || region.measure != MapMeasure::kSuccess ||
        region.late != LateDigit::kLast || region.where.empty() || region.num_pairs == 0) {
      continue;
    }
    ++num_regions;
    num_costs += region.verdict == MapVerdict::kCosts;
  }
  return "of " + FormatCount(num_regions, "region") +
         " of the map, each with a part of the pairs, " + std::to_string(num_costs) +
         " show a cost on their own";
}

/** Why the interval alone would be enough, but its cell is not decided. */
std::string DescribeUndecided(const MapCell& cell) {
  if (cell.verdict == MapVerdict::kCeiling || cell.verdict == MapVerdict::kFloor) {
    return std::string(RowOf(kMapVerdicts, cell.verdict).name) + ": " +
           FormatPercent(cell.undelayed) + " succeed without delay";
  }
  if (!cell.interval || (cell.interval->low <= 0.0 && cell.interval->high >= 0.0)) return "";
  return "adjusted p " + FormatFixed(cell.adjusted_p, 3) + ", above 0.05";
}

/** That of all regions of a part; none where it was not asked. */
void AddMapNumber(const FromFolder<MapResult>& map, const MapPartResult& part, MapMeasure asked,
                  const std::string& hand, std::vector<ArgumentNumber>& numbers) {
  const MapCell* const cell = FindCell(part.map, asked, hand, LateDigit::kLast, {});
  if (cell == nullptr || cell->num_pairs == 0) return;
  const bool is_success = asked == MapMeasure::kSuccess;
  const double scale = RowOf(kMapMeasures, asked).scale;
  ArgumentNumber number;
  number.measure = is_success ? &kLateSuccess : &kLateThreshold;
  number.subject = hand + (is_success ? "" : ": grip threshold");
  number.decides = is_success;
  number.value = scale * cell->estimate;
  if (cell->interval) number.interval = {scale * cell->interval->low, scale * cell->interval->high};
  number.n = cell->num_pairs;
  number.of = "pair";
  number.detail = FormatCount(cell->num_objects, "object");
  if (is_success) {
    number.detail += ", " + FormatPercent(cell->undelayed) + " succeed without delay; adjusted p " +
                     FormatFixed(cell->adjusted_p, 3) + "; " + DescribeRegions(part.map, hand);
  }
  if (part.num_trials < part.num_planned) {
    number.left_out = FormatCount(part.num_planned - part.num_trials, "planned trial") +
                      " of the map, not finished";
  }
  number.source = map.folder;
  number.command = map.result.command;
  if (part.num_trials < part.num_planned) {
    number.would_decide = "the rest of the map; repeat the command to continue";
  } else if (cell->verdict == MapVerdict::kCosts) {
    number.verdict = ArgumentVerdict::kShown;
  } else if (cell->verdict == MapVerdict::kGains || cell->verdict == MapVerdict::kNone) {
    number.verdict = ArgumentVerdict::kRefuted;
  } else if (cell->num_objects_to_decide > 0) {
    number.would_decide = FormatWanted(cell->num_objects_to_decide, cell->num_objects, "object");
  } else if (cell->verdict == MapVerdict::kCeiling) {
    number.would_decide = "harder regions: nearly all trials without delay succeed";
  } else if (cell->verdict == MapVerdict::kFloor) {
    number.would_decide = "easier regions: nearly no trial without delay succeeds";
  } else {
    number.would_decide = "more objects";
  }
  if (number.verdict == ArgumentVerdict::kNotDecided && part.num_trials >= part.num_planned) {
    number.why = DescribeUndecided(*cell);
  }
  numbers.push_back(number);
}

/** Those that decide first, in their order. */
void PutDecidingFirst(std::vector<ArgumentNumber>& numbers) {
  std::stable_partition(numbers.begin(), numbers.end(),
                        [](const ArgumentNumber& number) { return number.decides; });
}

}  // namespace

std::vector<ArgumentNumber> ListRobotNumbers(const std::vector<FromFolder<MapResult>>& maps) {
  std::vector<ArgumentNumber> numbers;
  for (const FromFolder<MapResult>& map : maps) {
    for (const MapPartResult& part : map.result.parts) {
      const bool is_first = &part == &map.result.parts.front();
      for (const std::string& hand : part.map.hands) {
        if (is_first) AddMapNumber(map, part, MapMeasure::kSuccess, hand, numbers);
        AddMapNumber(map, part, MapMeasure::kThreshold, hand, numbers);
      }
    }
  }
  PutDecidingFirst(numbers);
  return numbers;
}

namespace {

struct ClaimRun {
  const char* what;
  const char* command;
};
/** What each claim may be asked, with the command; the first is what decides it. */
constexpr ClaimRun kPeopleRuns[] = {
    {"a study of participants", "graspbench study run STUDY.yaml --out DIR"}};
constexpr ClaimRun kRobotRuns[] = {
    {"success with a late digit",
     "graspbench map simultaneity --quick --hand tum,shadow --out DIR"},
    {"grip thresholds with a late digit",
     "graspbench map simultaneity --hand tum,shadow --out DIR"},
    {"the same with grasps evolved on the catalogue",
     "graspbench map simultaneity --quick --hand tum-evolved,shadow-evolved --out DIR"}};
constexpr ClaimRun kPreGraspRuns[] = {
    {"step 1 on all objects", "graspbench campaign --out DIR"},
    {"step 1 on one object", "graspbench optimise --hand HAND --object OBJECT --step 1 --out DIR"}};
constexpr ClaimRun kTargetRuns[] = {
    {"thumb alone, by sigma, on all objects", "graspbench campaign --out DIR"},
    {"thumb alone, by sigma, on one object",
     "graspbench optimise --hand HAND --object OBJECT --step 2 --out DIR"},
    {"thumb alone, by strength",
     "graspbench optimise --hand HAND --object OBJECT --step 2 --fitness strength --out DIR"},
    {"all digits, by strength",
     "graspbench optimise --hand HAND --object OBJECT --step 2 --fitness strength --search "
     "all-digits --race --out DIR"}};
constexpr ClaimRun kSuccessRuns[] = {
    {"grasps before and after on the objects of the optimisation", "graspbench campaign --out DIR"},
    {"the same with shipped evolved grasps", "graspbench run --hand HAND,HAND-evolved --out DIR"},
    {"the same on unseen objects",
     "graspbench run --hand HAND,HAND-evolved --object FOLDER --out DIR"}};

template <size_t N, class IsThere>
std::vector<NotRun> ListNotRun(const ClaimRun (&runs)[N], const IsThere& is_there) {
  std::vector<NotRun> missing;
  for (size_t i = 0; i < N; ++i) {
    if (!is_there(i)) missing.push_back({runs[i].what, runs[i].command});
  }
  return missing;
}

/** Whether any number has this in its subject. */
bool HasSubject(const std::vector<ArgumentNumber>& numbers, const std::string& part) {
  return std::any_of(numbers.begin(), numbers.end(), [&](const ArgumentNumber& number) {
    return number.subject.find(part) != std::string::npos;
  });
}

}  // namespace

std::vector<ArgumentClaim> MakeArgument(const ArgumentSources& sources) {
  std::vector<ArgumentClaim> claims(kNumArgumentClaims);
  for (size_t i = 0; i < claims.size(); ++i) claims[i].question = &kArgumentQuestions[i];
  claims[0].numbers = ListPeopleNumbers(sources.people);
  claims[1].numbers = ListRobotNumbers(sources.maps);
  claims[2].numbers = ListPreGraspNumbers(sources.scenes);
  claims[3].numbers = ListTargetNumbers(sources.scenes);
  claims[4].numbers = ListSuccessNumbers(sources);
  for (ArgumentClaim& claim : claims) claim.verdict = JudgeClaim(claim.numbers);

  claims[0].not_run = ListNotRun(kPeopleRuns, [&](size_t) { return claims[0].was_run(); });
  claims[1].not_run = ListNotRun(kRobotRuns, [&](size_t run) {
    const auto& numbers = claims[1].numbers;
    if (run == 0) return claims[1].was_run();
    if (run == 2) return HasSubject(numbers, "-evolved");
    return std::any_of(numbers.begin(), numbers.end(), [](const ArgumentNumber& number) {
      return number.measure == &kLateThreshold;
    });
  });
  claims[2].not_run = ListNotRun(kPreGraspRuns, [&](size_t) { return claims[2].was_run(); });
  claims[3].not_run = ListNotRun(kTargetRuns, [&](size_t run) {
    return run < 2 ? claims[3].was_run() : HasSubject(claims[3].numbers, kTargetRuns[run].what);
  });
  claims[4].not_run = ListNotRun(kSuccessRuns, [&](size_t run) {
    return run < 2 ? claims[4].was_run() : HasSubject(claims[4].numbers, "unseen");
  });
  return claims;
}

}  // namespace graspbench
