#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "core/base/text/text.h"
#include "core/base/units.h"
#include "core/grasp/contact_timing.h"
#include "core/statistics/summary.h"
#include "datasets/analysis/argument/argument_evidence.h"
#include "datasets/analysis/conditions/threshold_summary.h"

namespace graspbench {
namespace {

using Scenes = std::vector<FromFolder<SceneRecord>>;

/** NaN: missing, null or no object. */
double NumberOf(const Json& score, const char* key) {
  const Json* const found = score.is_object() ? score.find(key) : nullptr;
  return found && found->is_number() ? found->get<double>() : kUnset;
}

/** Null where it has no such key. */
Json ValueOf(const Json& object, const char* key) {
  const Json* const found = object.is_object() ? object.find(key) : nullptr;
  return found ? *found : Json();
}

/** Hands in the order in which they come. */
std::vector<std::string> ListHandsOf(const Scenes& scenes) {
  std::vector<std::string> hands;
  for (const auto& scene : scenes) {
    const std::string& hand = scene.result.config.hand;
    if (std::find(hands.begin(), hands.end(), hand) == hands.end()) hands.push_back(hand);
  }
  return hands;
}

/** One number over scenes: the median of what they have. */
class SceneMedian {
 public:
  void Add(const std::string& folder, double value, const char* why_not) {
    if (std::isfinite(value)) {
      values_.push_back(value);
      if (std::find(folders_.begin(), folders_.end(), folder) == folders_.end()) {
        folders_.push_back(folder);
      }
    } else {
      ++left_out_[why_not];
    }
  }
  bool is_empty() const { return values_.empty() && left_out_.empty(); }

  void Finish(ArgumentNumber& number) const {
    number.n = static_cast<int>(values_.size());
    number.of = "scene";
    if (!values_.empty()) number.value = CalcMedian(values_);
    if (const auto interval = CalcMedianInterval(values_)) number.interval = *interval;
    for (const auto& [why, count] : left_out_) {
      number.left_out +=
          (number.left_out.empty() ? "" : ", ") + FormatCount(count, "scene") + " " + why;
    }
    constexpr size_t kMostNamed = 3;
    for (size_t i = 0; i < std::min(folders_.size(), kMostNamed); ++i) {
      number.source += (i == 0 ? "" : ", ") + folders_[i];
    }
    if (folders_.size() > kMostNamed) {
      number.source += " and " + std::to_string(folders_.size() - kMostNamed) + " more";
    }
    constexpr int kLeastScenes = 6;
    if (number.n < kLeastScenes) {
      number.would_decide = FormatCount(kLeastScenes, "scene") + " of a hand or more; there are " +
                            std::to_string(number.n);
    }
    Judge(number);
  }

 private:
  std::vector<double> values_;
  std::vector<std::string> folders_;
  std::map<std::string, int> left_out_;
};

constexpr char kEarlier[] = "optimised by an earlier program";

/** Scores of a scene before and after; the same where the standard pre-grasp stays. */
struct PreGraspScores {
  Json before, after;
  bool is_new = false;
};

/** None: result.json says nothing of it. @param alone  of the pre-grasp without added delays. */
std::optional<PreGraspScores> FindPreGrasp(const Json& step, bool alone) {
  const Json* const own = step.find("pregrasp_alone");
  if (own == nullptr) return std::nullopt;
  const Json standard = ValueOf(step, "standard"), before = ValueOf(step, "check_before");
  if (ValueOf(step, "checked").is_null()) return PreGraspScores{standard, standard};
  if (!alone) return PreGraspScores{before, ValueOf(step, "check_after"), true};
  if (own->is_null()) return PreGraspScores{before, before};
  return PreGraspScores{ValueOf(*own, "before"), ValueOf(*own, "after"), true};
}

std::string FormatMedian(const std::vector<double>& before, const std::vector<double>& after) {
  return FormatFixed(MsFromS(CalcMedian(before)), 0) + " to " +
         FormatFixed(MsFromS(CalcMedian(after)), 0) + " ms";
}

void AddPreGraspNumber(const Scenes& scenes, const std::string& hand, bool alone,
                       std::vector<ArgumentNumber>& numbers) {
  SceneMedian change;
  std::map<std::string, std::vector<double>> before, after;
  std::vector<double> floors;
  int num_new = 0, num_near = 0;
  for (const auto& scene : scenes) {
    const Json& result = scene.result.result;
    if (scene.result.config.hand != hand || !result.is_object()) continue;
    const Json* const step = result.find("pregrasp_step");
    if (step == nullptr) continue;
    const std::optional<PreGraspScores> scores = FindPreGrasp(*step, alone);
    if (!scores) {
      change.Add(scene.folder, kUnset, kEarlier);
      continue;
    }
    const double gft_before = NumberOf(scores->before, "median_gft_s");
    const double gft_after = NumberOf(scores->after, "median_gft_s");
    const double difference = MsFromS(gft_after - gft_before);
    change.Add(scene.folder, difference, "in which no trial has all contacts");
    if (!std::isfinite(difference)) continue;
    num_new += scores->is_new;
    for (const char* key : {"median_gft_s", "median_got_s", "median_gct_s"}) {
      before[key].push_back(NumberOf(scores->before, key));
      after[key].push_back(NumberOf(scores->after, key));
    }
    const double floor = NumberOf(scores->after, "gft_floor_s");
    if (!std::isfinite(floor)) continue;
    floors.push_back(floor);
    num_near += gft_after <= kNearGftFloor * floor;
  }
  if (change.is_empty()) return;
  ArgumentNumber number;
  number.measure = &kFormingTime;
  number.subject = hand + ": " + (alone ? "pre-grasp alone" : "pre-grasp and closing delays");
  number.decides = alone;
  number.command = "graspbench optimise --hand " + hand + " --object OBJECT --step 1 --out DIR";
  if (!before.empty()) {
    number.detail = "medians before and after: GFT " +
                    FormatMedian(before["median_gft_s"], after["median_gft_s"]) + ", GOT " +
                    FormatMedian(before["median_got_s"], after["median_got_s"]) + ", GCT " +
                    FormatMedian(before["median_gct_s"], after["median_gct_s"]) + "; ";
    if (!floors.empty()) {
      number.detail += "floor of GFT " + FormatFixed(MsFromS(CalcMedian(floors)), 0) +
                       " ms, GFT at most 1.2 times its floor in " + std::to_string(num_near) +
                       " of " + FormatCount(static_cast<int>(floors.size()), "scene") + "; ";
    }
    number.detail += std::string(alone ? "a new pre-grasp" : "a new pre-grasp or new delays") +
                     " tested in " + FormatCount(num_new, "scene") + ", no change in the others";
  }
  change.Finish(number);
  numbers.push_back(number);
}

/** As the thesis spends them on one grasp; fewer do not decide. */
constexpr int kFullSearch = 1000;

/** "thumb alone, by sigma"; with the evaluations where they are fewer than those of the thesis. */
std::string NameSearch(const OptimiseConfig& config) {
  const std::string space = config.search == kThumbSpace    ? "thumb alone"
                            : config.search == "all-digits" ? "all digits"
                                                            : config.search;
  return space + ", by " + config.fitness +
         (config.evaluations < kFullSearch ? ", " + FormatCount(config.evaluations, "evaluation")
                                           : "");
}

std::string MakeTargetCommand(const OptimiseConfig& config, const std::string& hand) {
  const OptimiseConfig plain;
  std::string command = "graspbench optimise --hand " + hand + " --object OBJECT --step 2";
  if (config.fitness != plain.fitness) command += " --fitness " + config.fitness;
  if (config.search != plain.search) command += " --search " + config.search;
  if (config.race) command += " --race";
  if (config.evaluations != plain.evaluations) {
    command += " --evaluations " + std::to_string(config.evaluations);
  }
  return command + " --out DIR";
}

}  // namespace

std::vector<ArgumentNumber> ListPreGraspNumbers(const Scenes& scenes) {
  std::vector<ArgumentNumber> numbers;
  for (const bool alone : {true, false}) {
    for (const std::string& hand : ListHandsOf(scenes)) {
      AddPreGraspNumber(scenes, hand, alone, numbers);
    }
  }
  return numbers;
}

std::vector<ArgumentNumber> ListTargetNumbers(const Scenes& scenes) {
  struct Search {
    std::string hand, name, command;
    bool decides = false;
    SceneMedian ratio = {};
    int num_scenes = 0, num_taken = 0;
  };
  std::vector<Search> searches;
  for (const auto& scene : scenes) {
    const Json& result = scene.result.result;
    if (!result.is_object()) continue;
    const Json* const step = result.find("target_step");
    if (step == nullptr) continue;
    const SceneConfig& config = scene.result.config;
    const std::string name = NameSearch(config.optimise);
    auto search = std::find_if(searches.begin(), searches.end(), [&](const Search& known) {
      return known.hand == config.hand && known.name == name;
    });
    if (search == searches.end()) {
      const bool decides = config.optimise.search == kThumbSpace &&
                           config.optimise.evaluations >= kFullSearch &&
                           FitnessOf(config.optimise).value == FitnessKind::kSigma;
      search = searches.insert(
          searches.end(),
          {config.hand, name, MakeTargetCommand(config.optimise, config.hand), decides});
    }
    ++search->num_scenes;
    search->num_taken += step->value("taken", false);
    const Json before = ValueOf(*step, "check_before"), after = ValueOf(*step, "check_after");
    const double start = NumberOf(before, "fitness");
    if (!std::isfinite(start)) {
      search->ratio.Add(scene.folder, kUnset, kEarlier);
    } else if (!(start > 0.0)) {
      search->ratio.Add(scene.folder, kUnset, "without a success of the start");
    } else {
      const double found = after.is_null() ? start : NumberOf(after, "fitness");
      search->ratio.Add(scene.folder, found / start, kEarlier);
    }
  }
  std::vector<ArgumentNumber> numbers;
  for (const Search& search : searches) {
    ArgumentNumber number;
    number.measure = &kStability;
    number.subject = search.hand + ": " + search.name;
    number.decides = search.decides;
    number.command = search.command;
    number.detail = "the new target was accepted in " + std::to_string(search.num_taken) + " of " +
                    FormatCount(search.num_scenes, "scene");
    search.ratio.Finish(number);
    numbers.push_back(number);
  }
  std::stable_partition(numbers.begin(), numbers.end(),
                        [](const ArgumentNumber& number) { return number.decides; });
  return numbers;
}

}  // namespace graspbench
