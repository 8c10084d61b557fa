#include "datasets/analysis/campaign/campaign_summary.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "core/base/error.h"
#include "core/base/text/csv.h"
#include "core/base/text/text.h"
#include "core/statistics/multiple_tests.h"
#include "core/statistics/proportion.h"
#include "core/statistics/summary.h"
#include "datasets/analysis/campaign/headrooms.h"
#include "datasets/journal/sealed_store.h"

namespace graspbench {

namespace fs = std::filesystem;

namespace {

VariantSummary Summarise(const std::vector<const TrialRecord*>& records) {
  VariantSummary summary;
  const PlannedTrial& plan = records.front()->plan;
  summary.hand = plan.hand;
  summary.object = plan.object;
  summary.grasp = plan.grasp;
  summary.variant = VariantOfGrasp(plan.grasp);
  CellSummary cell;
  cell.records = records;
  for (const TrialRecord* record : records) {
    ++summary.trials;
    summary.successes += record->result.outcome == Outcome::kSuccess;
  }
  const auto calc = [&](const char* measure) {
    return CalcCellValue(FindVariantMeasure(measure), cell);
  };
  summary.mean_sigma = calc("sigma");
  summary.median_gft_ratio = calc("GFT%");
  if (const Answer<double> floor = CalcGftFloorOf(records)) summary.gft_ratio_floor = *floor;
  summary.median_got_ratio = calc("GOT%");
  summary.median_gft = calc("GFT");
  summary.median_got = calc("GOT");
  summary.median_gct = calc("GCT");
  summary.mean_breaking_force = calc("breaking");
  summary.median_grip = calc("grip");
  summary.median_sigma_ratio = calc("sigma/grip");
  summary.median_breaking_ratio = calc("breaking/grip");
  return summary;
}

/** NaN: none. */
double FindHeadroomShare(const Campaign& campaign, const VariantSummary& summary) {
  if (summary.variant == kStandardGrasp) return kUnset;
  for (const SceneRecord& scene : campaign.scenes) {
    if (scene.config.hand != summary.hand || scene.config.object != summary.object) continue;
    const Answer<SceneHeadroom> headroom = FindHeadroom(scene);
    if (!headroom) return kUnset;
    return summary.variant == kNewTarget ? headroom->kept_share : headroom->start_share;
  }
  return kUnset;
}

std::vector<CsvColumn<ComparisonRun>> ListComparisonColumns() {
  using Run = ComparisonRun;
  return {{"hand", "", "id of the hand", &Run::hand},
          {"object", "", "id of the object", &Run::object},
          {"method", "", "search of step 2", &Run::method},
          {"seed", "", "of the search", &Run::seed},
          {"evaluations", "", "grasps that it simulated",
           [](const Run& run) { return run.fitness.size(); }},
          {"start_fitness", "number", "", "fitness of the start",
           [](const Run& run) { return Json(run.fitness.front()); }},
          {"best_fitness", "number", "", "largest fitness that it found",
           [](const Run& run) {
             return Json(*std::max_element(run.fitness.begin(), run.fitness.end()));
           }},
          {"evaluations_to_90", "integer", "",
           "evaluations to 90 % of the largest gain of all searches of this hand and object; "
           "empty: never reached",
           [](const Run& run) {
             return run.evaluations_to_90 > 0 ? Json(run.evaluations_to_90) : Json();
           }}};
}

std::vector<CsvColumn<VariantSummary>> ListVariantColumns() {
  std::vector<CsvColumn<VariantSummary>> columns;
  AddFieldColumns<VariantSummary>(
      [](const VariantSummary& summary) -> const VariantSummary& { return summary; }, columns);
  return columns;
}

}  // namespace

std::vector<VariantSummary> SummariseVariants(const Campaign& campaign) {
  std::vector<VariantSummary> summaries;
  std::vector<const TrialRecord*> cell;
  const auto finish_cell = [&] {
    if (cell.empty()) return;
    summaries.push_back(Summarise(cell));
    summaries.back().headroom_share = FindHeadroomShare(campaign, summaries.back());
    cell.clear();
  };
  for (const TrialRecord& record : campaign.benchmark.records) {
    if (!cell.empty()) {
      const PlannedTrial& last = cell.back()->plan;
      if (last.hand != record.plan.hand || last.object != record.plan.object ||
          last.grasp != record.plan.grasp) {
        finish_cell();
      }
    }
    cell.push_back(&record);
  }
  finish_cell();
  return summaries;
}

Json MakeVariantSchema() { return MakeTableSchema(ListVariantColumns(), ""); }

Json MakeComparisonSchema() { return MakeTableSchema(ListComparisonColumns(), ""); }

void ExportCampaign(const fs::path& folder, const Campaign& campaign) {
  std::map<std::string, std::string> tables = {
      {"summary.csv", FormatCsv(ListVariantColumns(), SummariseVariants(campaign))}};
  if (!campaign.comparison.empty()) {
    tables["comparison.csv"] = FormatCsv(ListComparisonColumns(), campaign.comparison);
  }
  WriteDerived(kCampaignStore, folder, tables);
}

namespace {

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

const TrialRecord* FindTrial(const CellSummary& cell, int trial) {
  for (const TrialRecord* record : cell.records) {
    if (record->plan.trial == trial) return record;
  }
  return nullptr;
}

double SigmaOf(const TrialRecord& record) {
  const double sigma = record.result.stability.sigma;
  return std::isfinite(sigma) ? sigma : 0.0;
}

double BreakingForceOf(const TrialRecord& record) {
  if (record.judgement) return record.judgement->breaking_force;
  return record.result.outcome == Outcome::kSuccess ? kMissing : 0.0;
}

double GripForceOf(const TrialRecord& record) { return record.result.stability.hold.normal_force; }

/** None when the object was lost: then there was no force to hold with either. */
double DivideByGrip(double force, const TrialRecord& record) {
  return force == 0.0 ? kMissing : force / GripForceOf(record);
}

/** Of b and a; none where it is so small that the same grasp, once from the catalogue and once from
its file with its rounded angles, gives it. */
double CalcDifference(double a, double b) {
  constexpr double kNegligible = 1e-6;
  return std::abs(b - a) <= kNegligible * std::max(std::abs(a), std::abs(b)) ? 0.0 : b - a;
}

}  // namespace

const std::vector<VariantMeasure>& ListVariantMeasures() {
  static const std::vector<VariantMeasure> measures = {
      {"success [%]", "share of successful trials", 100.0, 0, true, VariantMeasure::kMean,
       [](const TrialRecord& r) { return r.result.outcome == Outcome::kSuccess ? 1.0 : 0.0; }},
      {"sigma [N]", "stability; 0 when the object is lost", 1.0, 2, true, VariantMeasure::kMean,
       SigmaOf},
      {"breaking force [N]",
       "smallest pull in six directions that breaks the grasp; 0 when the object was lost", 1.0, 2,
       true, VariantMeasure::kMean, BreakingForceOf},
      {"grip [N]", "sum of the hand's normal forces on the object in the hold", 1.0, 1, false,
       VariantMeasure::kMedianOfHaving, GripForceOf},
      {"sigma/grip [%]", "held grasps: higher means better holding, not harder squeezing", 100.0, 1,
       true, VariantMeasure::kMedianOfHaving,
       [](const TrialRecord& r) { return DivideByGrip(SigmaOf(r), r); }},
      {"breaking/grip [%]", "held grasps: breaking force at equal grip", 100.0, 1, true,
       VariantMeasure::kMedianOfHaving,
       [](const TrialRecord& r) { return DivideByGrip(BreakingForceOf(r), r); }},
      {"GFT% [%]", "grasp forming time over grasp closure time", 100.0, 1, false,
       VariantMeasure::kMedianMissingIsInfinite,
       [](const TrialRecord& r) { return r.result.timing.gft_ratio; }},
      {"GOT% [%]", "grasp opposing time over grasp closure time", 100.0, 1, false,
       VariantMeasure::kMedianMissingIsInfinite,
       [](const TrialRecord& r) { return r.result.timing.got_ratio; }},
      {"GFT [ms]", "grasp forming time", 1000.0, 0, false, VariantMeasure::kMedianOfHaving,
       [](const TrialRecord& r) { return r.result.timing.gft; }},
      {"GOT [ms]", "grasp opposing time", 1000.0, 0, false, VariantMeasure::kMedianOfHaving,
       [](const TrialRecord& r) { return r.result.timing.got; }},
      {"GCT [ms]", "grasp closure time", 1000.0, 0, false, VariantMeasure::kMedianOfHaving,
       [](const TrialRecord& r) { return r.result.timing.gct; }},
  };
  return measures;
}

const VariantMeasure& FindVariantMeasure(const std::string& name) {
  for (const VariantMeasure& measure : ListVariantMeasures()) {
    const std::string full = measure.name;
    if (full.substr(0, full.find(' ')) == name) return measure;
  }
  GRASPBENCH_DEMAND(false, name);
}

bool SceneVariants::IsComplete() const {
  return std::all_of(cells.begin(), cells.end(), [](const CellSummary* cell) {
    return cell != nullptr && cell->tally.finished > 0;
  });
}

int CountComplete(const std::vector<SceneVariants>& scenes) {
  return static_cast<int>(std::count_if(
      scenes.begin(), scenes.end(), [](const SceneVariants& scene) { return scene.IsComplete(); }));
}

double CalcCellValue(const VariantMeasure& measure, const CellSummary& cell) {
  std::vector<double> values;
  for (const TrialRecord* record : cell.records) {
    const double value = measure.value(*record);
    if (std::isfinite(value)) {
      values.push_back(value);
    } else if (measure.of_cell == VariantMeasure::kMedianMissingIsInfinite) {
      values.push_back(std::numeric_limits<double>::infinity());
    }
  }
  if (measure.of_cell == VariantMeasure::kMean && !values.empty()) return CalcMoments(values).mean;
  const double median = CalcMedian(values);
  return std::isinf(median) ? kMissing : median;
}

std::vector<double> ListPairedDifferences(const VariantMeasure& measure, const SceneVariants& scene,
                                          Variant a, Variant b) {
  std::vector<double> differences;
  if (!scene.cells[a] || !scene.cells[b]) return differences;
  for (const TrialRecord* before : scene.cell(a).records) {
    const TrialRecord* after = FindTrial(scene.cell(b), before->plan.trial);
    if (after == nullptr) continue;
    const double difference = CalcDifference(measure.value(*before), measure.value(*after));
    if (std::isfinite(difference)) differences.push_back(difference);
  }
  return differences;
}

PairedDifference CalcPairedDifference(const VariantMeasure& measure, const SceneVariants& scene,
                                      Variant a, Variant b) {
  const std::vector<double> differences = ListPairedDifferences(measure, scene, a, b);
  const auto mean = [&](const std::vector<size_t>& members) {
    double sum = 0.0;
    for (size_t member : members) sum += differences[member];
    return sum / static_cast<double>(members.size());
  };
  constexpr int kResamples = 1999;
  PairedDifference difference;
  difference.num_pairs = static_cast<int>(differences.size());
  if (!differences.empty()) difference.mean = CalcMoments(differences).mean;
  difference.interval = CalcBootstrap(
      differences.size(), mean, scene.key + " " + measure.name + " " + WordsOf(b), kResamples);
  return difference;
}

StepEffect CalcStepEffect(const VariantMeasure& measure, const std::vector<SceneVariants>& scenes,
                          Variant a, Variant b, const std::string& hand) {
  StepEffect effect;
  std::vector<double> before, after;
  for (const SceneVariants& scene : scenes) {
    if (!scene.IsComplete() || (!hand.empty() && scene.hand != hand)) continue;
    const double value_a = CalcCellValue(measure, scene.cell(a));
    const double value_b = CalcCellValue(measure, scene.cell(b));
    const double gain = CalcDifference(value_a, value_b);
    if (!std::isfinite(gain)) continue;
    before.push_back(value_a);
    after.push_back(gain == 0.0 ? value_a : value_b);
    if (measure.is_larger_better ? gain < 0.0 : gain > 0.0) {
      effect.worse.push_back(&scene);
    }
  }
  effect.num_scenes = static_cast<int>(before.size());
  effect.median_before = CalcMedian(before);
  effect.median_after = CalcMedian(after);
  const auto ratio = [&](const std::vector<size_t>& members) {
    std::vector<double> drawn_before, drawn_after;
    for (size_t member : members) {
      drawn_before.push_back(before[member]);
      drawn_after.push_back(after[member]);
    }
    const double median = CalcMedian(drawn_before);
    return median > 0.0 ? CalcMedian(drawn_after) / median : kMissing;
  };
  effect.ratio = CalcBootstrap(before.size(), ratio, std::string(measure.name) + hand + WordsOf(b));
  return effect;
}

PairedCounts CountPairedSuccesses(const SceneVariants& scene, Variant a, Variant b) {
  PairedCounts counts;
  for (const TrialRecord* before : scene.cell(a).records) {
    const TrialRecord* after = FindTrial(scene.cell(b), before->plan.trial);
    if (after == nullptr) continue;
    counts.Add(before->result.outcome == Outcome::kSuccess,
               after->result.outcome == Outcome::kSuccess);
  }
  return counts;
}

std::vector<LowerSuccess> ListSignificantlyLower(const std::vector<SceneVariants>& scenes,
                                                 Variant a, Variant b) {
  constexpr double kSignificance = 0.05;
  std::vector<LowerSuccess> tested;
  std::vector<double> p;
  for (const SceneVariants& scene : scenes) {
    if (!scene.IsComplete()) continue;
    tested.push_back({&scene, CountPairedSuccesses(scene, a, b), kUnset});
    p.push_back(CalcMcNemarExactTwoSided(tested.back().counts));
  }
  const std::vector<double> p_holm = AdjustHolm(p);
  std::vector<LowerSuccess> lower;
  for (size_t i = 0; i < tested.size(); ++i) {
    tested[i].p_holm = p_holm[i];
    const PairedCounts& counts = tested[i].counts;
    if (counts.second_only < counts.first_only && p_holm[i] < kSignificance) {
      lower.push_back(tested[i]);
    }
  }
  return lower;
}

std::vector<VariantTotal> ListVariantTotals(const Campaign& campaign) {
  const std::vector<VariantSummary> summaries = SummariseVariants(campaign);
  std::vector<VariantTotal> totals;
  for (const VariantRow& row : kVariants) {
    VariantTotal total;
    total.variant = row.value;
    std::vector<double> sigma, gft, floors, got, gft_time, got_time, gct;
    for (const VariantSummary& summary : summaries) {
      if (summary.variant != row.value) continue;
      ++total.num_scenes;
      total.trials += summary.trials;
      total.successes += summary.successes;
      sigma.push_back(summary.mean_sigma);
      gft.push_back(summary.median_gft_ratio);
      floors.push_back(summary.gft_ratio_floor);
      got.push_back(summary.median_got_ratio);
      gft_time.push_back(summary.median_gft);
      got_time.push_back(summary.median_got);
      gct.push_back(summary.median_gct);
    }
    total.median_sigma = CalcMedianOfFinite(sigma);
    total.median_gft_ratio = CalcMedianOfFinite(gft);
    total.median_gft_floor = CalcMedianOfFinite(floors);
    total.median_got_ratio = CalcMedianOfFinite(got);
    total.median_gft = CalcMedianOfFinite(gft_time);
    total.median_got = CalcMedianOfFinite(got_time);
    total.median_gct = CalcMedianOfFinite(gct);
    totals.push_back(total);
  }
  return totals;
}

std::vector<MethodTotal> ListMethodTotals(const Campaign& campaign) {
  std::vector<MethodTotal> totals;
  if (campaign.comparison.empty()) return totals;
  for (const std::string& method : campaign.config.comparison.methods) {
    MethodTotal total;
    total.method = method;
    std::vector<double> best, evaluations;
    for (const ComparisonRun& run : campaign.comparison) {
      if (run.method != method) continue;
      best.push_back(*std::max_element(run.fitness.begin(), run.fitness.end()));
      if (run.evaluations_to_90 > 0) evaluations.push_back(run.evaluations_to_90);
    }
    total.num_searches = static_cast<int>(best.size());
    total.median_best_fitness = CalcMedianOfFinite(best);
    total.num_reached_90 = static_cast<int>(evaluations.size());
    total.median_evaluations_to_90 = CalcMedianOfFinite(evaluations);
    totals.push_back(total);
  }
  return totals;
}

GftWithoutVariation CalcGftWithoutVariation(const std::vector<SceneVariants>& scenes) {
  std::vector<double> before, after;
  for (const SceneVariants& scene : scenes) {
    const Json* const step = scene.scene->result.find("pregrasp_step");
    if (step == nullptr || !step->contains("standard")) continue;
    const auto find_ratio = [](const Json& score) {
      return NumberFrom(score.at("gft_ratio_without_variation"));
    };
    const double standard = find_ratio(step->at("standard"));
    double taken = standard;
    for (const Json& shot : step->at("shots")) {
      if (shot.at("name") == step->at("taken")) taken = find_ratio(shot.at("score"));
    }
    if (!std::isfinite(standard) || !std::isfinite(taken)) continue;
    before.push_back(standard);
    after.push_back(taken);
  }
  return {static_cast<int>(before.size()), CalcMedian(before), CalcMedian(after)};
}

const SceneVariants* FindScene(const std::vector<SceneVariants>& scenes, const std::string& hand,
                               const std::string& object) {
  for (const SceneVariants& scene : scenes) {
    if (scene.hand == hand && scene.object == object && scene.IsComplete()) return &scene;
  }
  return nullptr;
}

HandComparison CompareHands(const VariantMeasure& measure, const std::vector<SceneVariants>& scenes,
                            Variant variant, const std::string& hand_a, const std::string& hand_b) {
  HandComparison comparison;
  std::vector<double> a, b;
  for (const SceneVariants& scene_a : scenes) {
    if (scene_a.hand != hand_a || !scene_a.IsComplete()) continue;
    const SceneVariants* scene_b = FindScene(scenes, hand_b, scene_a.object);
    if (scene_b == nullptr) continue;
    const double value_a = CalcCellValue(measure, scene_a.cell(variant));
    const double value_b = CalcCellValue(measure, scene_b->cell(variant));
    if (!std::isfinite(value_a) || !std::isfinite(value_b)) continue;
    a.push_back(value_a);
    b.push_back(value_b);
    const double lead = measure.is_larger_better ? value_a - value_b : value_b - value_a;
    comparison.num_a_better += lead > 0.0 ? 1 : 0;
    comparison.num_b_better += lead < 0.0 ? 1 : 0;
  }
  comparison.num_objects = static_cast<int>(a.size());
  comparison.median_a = CalcMedian(a);
  comparison.median_b = CalcMedian(b);
  return comparison;
}

std::vector<SceneVariants> ListScenes(const Campaign& campaign, const SessionSummary& benchmark) {
  std::vector<SceneVariants> scenes;
  for (const SceneRecord& record : campaign.scenes) {
    SceneVariants scene;
    scene.scene = &record;
    scene.hand = record.config.hand;
    scene.object = record.config.object;
    scene.grasp = record.config.grasp;
    scene.key = MakePlainKey({scene.hand, scene.object});
    for (const VariantRow& variant : kVariants) {
      const std::string grasp = variant.value == kStandardGrasp ? scene.grasp : variant.name;
      scene.cells[variant.value] = benchmark.FindCell(scene.hand, scene.object, grasp);
    }
    scenes.push_back(scene);
  }
  return scenes;
}

std::vector<MethodCurve> ListMethodCurves(const Campaign& campaign) {
  std::vector<MethodCurve> curves;
  std::map<std::vector<std::string>, std::vector<const ComparisonRun*>> groups;
  std::vector<std::vector<std::string>> order;
  for (const ComparisonRun& run : campaign.comparison) {
    const std::vector<std::string> key = {run.hand, run.object, run.method};
    if (groups[key].empty()) order.push_back(key);
    groups[key].push_back(&run);
  }
  for (const auto& key : order) {
    const std::vector<const ComparisonRun*>& runs = groups[key];
    MethodCurve curve;
    curve.hand = key[0];
    curve.object = key[1];
    curve.method = key[2];
    curve.num_seeds = static_cast<int>(runs.size());
    size_t length = runs.front()->fitness.size();
    for (const ComparisonRun* run : runs) length = std::min(length, run->fitness.size());
    std::vector<double> best(runs.size(), -std::numeric_limits<double>::infinity());
    for (size_t i = 0; i < length; ++i) {
      for (size_t r = 0; r < runs.size(); ++r) best[r] = std::max(best[r], runs[r]->fitness[i]);
      std::vector<double> sorted = best;
      std::sort(sorted.begin(), sorted.end());
      curve.evaluations.push_back(static_cast<double>(i + 1));
      curve.low.push_back(CalcSortedQuantile(sorted, 0.25));
      curve.median.push_back(CalcSortedQuantile(sorted, 0.5));
      curve.high.push_back(CalcSortedQuantile(sorted, 0.75));
    }
    curve.final_median = length > 0 ? curve.median.back() : kMissing;
    // Never counts as infinitely many.
    std::vector<double> to_90;
    for (const ComparisonRun* run : runs) {
      to_90.push_back(run->evaluations_to_90 > 0 ? run->evaluations_to_90
                                                 : std::numeric_limits<double>::max());
    }
    const double median = CalcMedian(to_90);
    curve.median_evaluations_to_90 = median < 1e9 ? median : kMissing;
    curves.push_back(curve);
  }
  return curves;
}

MethodDuel CompareMethods(const std::vector<MethodCurve>& curves, const std::string& method,
                          const std::string& other) {
  MethodDuel duel;
  for (const MethodCurve& a : curves) {
    if (a.method != method || !std::isfinite(a.final_median)) continue;
    for (const MethodCurve& b : curves) {
      const bool is_other = b.method == other && b.hand == a.hand && b.object == a.object;
      if (!is_other || !std::isfinite(b.final_median)) continue;
      ++duel.num_scenes;
      duel.num_won += a.final_median > b.final_median;
    }
  }
  return duel;
}

}  // namespace graspbench
