#include "workbench/tables/optimise_tables.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/files/files.h"
#include "core/base/text/text.h"
#include "core/base/units.h"
#include "core/hand/hand.h"
#include "core/optimise/contact_times.h"
#include "core/optimise/learning_trial.h"
#include "core/statistics/proportion.h"
#include "datasets/analysis/campaign/campaign_summary.h"
#include "datasets/analysis/campaign/headrooms.h"
#include "workbench/tables/text_table.h"
#include "workbench/terminal/terminal.h"

namespace graspbench {

namespace {

std::string FormatPercentage(double ratio) {
  return std::isfinite(ratio) ? FormatFixed(100.0 * ratio, 1) : "n/a";
}

template <class Row>
CsvColumn<Row> MakeShareColumn(const char* name, const char* heading, double Row::*member) {
  return CsvColumn<Row>(name, "", "", member).Shown(heading, [member](const Row& row) {
    return FormatPercentage(row.*member);
  });
}

CsvColumn<VariantTotal> MakeTimeColumn(const char* name, const char* heading,
                                       double VariantTotal::*member) {
  return CsvColumn<VariantTotal>(name, "", "", member)
      .Shown(heading, [member](const VariantTotal& row) {
        const double time = row.*member;
        return std::isfinite(time) ? FormatFixed(MsFromS(time), 0) : "n/a";
      });
}

std::vector<CsvColumn<VariantTotal>> ListVariantColumns() {
  using Row = VariantTotal;
  using C = CsvColumn<Row>;
  return {
      C("variant", "", "", [](const Row& row) { return NameOf(row.variant); }).Shown("variant"),
      C("scenes", "", "", &Row::num_scenes).Shown("scenes"),
      C("trials", "", "", &Row::trials).Shown("trials"),
      C("successes", "", "", &Row::successes).Shown("successes"),
      C::ForPeople("95 % interval [%]", "",
                   [](const Row& row) { return FormatRateInterval(row.successes, row.trials); }),
      C("median_sigma_n", "", "", &Row::median_sigma)
          .Shown("median sigma", [](const Row& row) { return FormatFixed(row.median_sigma, 3); }),
      MakeShareColumn("median_gft_ratio", "median GFT%", &Row::median_gft_ratio),
      MakeShareColumn("median_gft_ratio_floor", "its floor", &Row::median_gft_floor),
      MakeShareColumn("median_got_ratio", "median GOT%", &Row::median_got_ratio),
      MakeTimeColumn("median_gft_s", "median GFT [ms]", &Row::median_gft),
      MakeTimeColumn("median_got_s", "median GOT [ms]", &Row::median_got),
      MakeTimeColumn("median_gct_s", "median GCT [ms]", &Row::median_gct)};
}

std::vector<CsvColumn<MethodTotal>> ListMethodColumns() {
  using Row = MethodTotal;
  using C = CsvColumn<Row>;
  return {C("method", "", "", &Row::method).Shown("method"),
          C("searches", "", "", &Row::num_searches).Shown("searches"),
          C("median_best_fitness", "", "", &Row::median_best_fitness)
              .Shown("median best fitness",
                     [](const Row& row) { return FormatFixed(row.median_best_fitness, 3); }),
          C("reached_90", "", "", &Row::num_reached_90).Shown("reached 90 %"),
          C("median_evaluations_to_90", "", "", &Row::median_evaluations_to_90)
              .Shown("median evaluations to 90 %", [](const Row& row) {
                const double median = row.median_evaluations_to_90;
                return std::isfinite(median) ? FormatFixed(median, 0) : "n/a";
              })};
}

}  // namespace

std::string FormatVariantsTable(const Campaign& campaign) {
  return FormatTable(ShowTable(ListVariantColumns(), ListVariantTotals(campaign)));
}

std::string FormatComparisonTable(const Campaign& campaign) {
  const std::vector<MethodTotal> totals = ListMethodTotals(campaign);
  return totals.empty() ? "" : FormatTable(ShowTable(ListMethodColumns(), totals));
}

std::string FormatCampaign(const Campaign& campaign, const std::filesystem::path& folder,
                           const std::filesystem::path& report) {
  const std::string comparison = FormatComparisonTable(campaign);
  std::string headroom;
  for (const Headrooms& hand : ListHeadrooms(campaign)) {
    headroom += "\nheadroom " + hand.hand + ": " + DescribeHeadrooms(hand);
  }
  return "\n" + FormatVariantsTable(campaign) + (comparison.empty() ? "" : "\n" + comparison) +
         headroom + "\nreport   " + report.string() + "\ndata     " +
         (folder / "summary.csv").string() + "\n";
}

Json MakeCampaignJson(const Campaign& campaign, const std::filesystem::path& folder,
                      const std::filesystem::path& report) {
  Json headrooms = Json::array();
  for (const Headrooms& hand : ListHeadrooms(campaign)) {
    headrooms.push_back({{"hand", hand.hand},
                         {"scenes", hand.num_scenes},
                         {"median_share_start", JsonNumber(hand.median_start)},
                         {"median_share_kept", JsonNumber(hand.median_kept)},
                         {"scenes_without", hand.num_without},
                         {"why_without", hand.why_without}});
  }
  return {{"campaign", folder.string()},
          {"report", report.string()},
          {"scenes", campaign.scenes.size()},
          {"variants", MakeJsonRows(ListVariantColumns(), ListVariantTotals(campaign))},
          {"methods", MakeJsonRows(ListMethodColumns(), ListMethodTotals(campaign))},
          {"headroom", headrooms}};
}

std::string DescribeNumericalFailures(const Campaign& campaign) {
  std::string text;
  const auto add = [&text](const std::string& where, const std::string& what) {
    if (!what.empty()) text += (text.empty() ? "" : "\n") + where + ": " + what;
  };
  for (const SceneRecord& scene : campaign.scenes) {
    add(scene.config.hand + ", " + scene.config.object,
        DescribeNumericalFailures(scene.evaluations));
  }
  const auto& records = campaign.benchmark.records;
  const auto count = std::count_if(records.begin(), records.end(), [](const TrialRecord& record) {
    return record.result.outcome == Outcome::kNumericalFailure;
  });
  if (count > 0) {
    add("benchmark", FormatCount(count, "trial") +
                         " failed numerically; benchmark/export/trials.csv names them");
  }
  return text;
}

namespace {

std::string FormatAngles(const Hand& hand, const Grasp& grasp, const Eigen::VectorXd& q) {
  const Digit& digit = hand.digits[static_cast<size_t>(FindOpposingDigit(hand, grasp))];
  std::string text;
  for (const int joint : FindDrivenJoints(hand, digit)) {
    text += (text.empty() ? "" : " ") + FormatFixed(DegFromRad(q[joint]), 1);
  }
  return MakePlainText(text);
}

/** What step 2 makes larger, of trials that were asked for it. */
std::string FormatGoal(const std::vector<LearningTrial>& trials, bool finds_strength) {
  const double goal = finds_strength ? CalcMeanStrength(trials) : CalcMeanSigma(trials);
  return std::isfinite(goal) ? FormatFixed(goal, 3) : "n/a";
}

constexpr char kMoreThanSides[] = ", so it does not hold by side friction alone";

/** What is left for another grasp of the same grip. */
std::string FormatHeadroom(const SceneInputs& inputs, const SceneConfig& config,
                           const GraspCheck& check) {
  const auto calc = [&](const std::vector<LearningTrial>& trials) {
    return CalcHeadroom(trials, *inputs.object, config.sim.gravity);
  };
  const Headroom before = calc(check.before);
  if (!std::isfinite(before.share)) return "headroom unknown: the start held nothing\n";
  std::string text =
      "headroom the start resists " + FormatFixed(before.share, 2) + " of the " +
      FormatFixed(before.bound, 2) + " N that friction and grip allow at the sides" +
      (before.share > 1.0 ? std::string(kMoreThanSides)
                          : ": at equal grip at most times " +
                                FormatFixed(CalcMostGain(before.share), 2) + " by the sides");
  const Headroom after = calc(check.after);
  if (!check.after.empty() && std::isfinite(after.share)) {
    text += "; the new target " + FormatFixed(after.share, 2) + " of " +
            FormatFixed(after.bound, 2) + " N" +
            (after.share > 1.0 && before.share <= 1.0 ? kMoreThanSides : "");
  }
  return text + "\n";
}

void AddTrials(const std::string& step, const std::string& what,
               const std::vector<LearningTrial>& trials, bool finds_strength, TextTable& table) {
  if (trials.empty()) return;
  const double median = CalcMedianGftRatio(trials);
  const Answer<double> floor = CalcGftFloor(trials);
  const ContactTimesSummary times = SummariseContactTimes(trials);
  const auto format_ms = [](double time) {
    return std::isfinite(time) ? FormatFixed(MsFromS(time), 0) : "n/a";
  };
  table.AddRow({step, what,
                std::to_string(CountSuccesses(trials)) + " of " + std::to_string(trials.size()),
                FormatGoal(trials, finds_strength), FormatFixed(CalcMeanGrip(trials), 1),
                std::isfinite(median) ? FormatFixed(100.0 * median, 1) : "n/a",
                floor ? FormatFixed(100.0 * *floor, 1) : "no floor", format_ms(times.gft),
                format_ms(times.gft_floor), format_ms(times.got), format_ms(times.gct)});
}

/** Pre-grasp and closing delays are two results: the pre-grasp alone has its own row. */
void AddPreGraspStep(const PreGraspStep& step, bool finds_strength, TextTable& table) {
  const bool was_checked = step.best >= 0;
  AddTrials("step 1", "before", was_checked ? step.check.before : step.standard_trials,
            finds_strength, table);
  if (step.alone >= 0 && step.alone != step.best) {
    AddTrials("step 1", "pre-grasp alone, first 20", step.alone_trials, finds_strength, table);
  }
  if (was_checked) {
    AddTrials("step 1", NameWhatChanged(step.shots[static_cast<size_t>(step.best)]),
              step.check.after, finds_strength, table);
  }
}

/** What another space than the thumb has changed, in degrees and millimetres. */
std::string FormatCoordinates(const TargetStep& step, const std::string& space) {
  TextTable table({space, "start", "found"});
  const auto format = [&](const GraspCoordinate& coordinate, double radians) {
    const double value = coordinate.per_radian * radians;
    return coordinate.unit == std::string("m") ? FormatFixed(MmFromM(value), 1) + " mm"
                                               : FormatFixed(DegFromRad(value), 1) + " deg";
  };
  const Individual& found = step.search.individuals[static_cast<size_t>(step.found)];
  for (size_t i = 0; i < step.coordinates.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    table.AddRow({step.coordinates[i].name, format(step.coordinates[i], step.space.start[k]),
                  format(step.coordinates[i], found.genome[k])});
  }
  return "\n" + table.Format();
}

}  // namespace

std::string FormatOptimisation(const SceneInputs& inputs, const SceneConfig& config,
                               const OptimisedGrasp& result) {
  const Hand& hand = *inputs.hand;
  const PreGraspStep& step1 = result.pregrasp_step;
  const TargetStep& step2 = result.target_step;
  const bool finds_strength = FindsStrength(config.optimise);
  TextTable decisions({"fresh trials", "", "success",
                       finds_strength ? "mean strength [N]" : "mean sigma [N]", "mean grip [N]",
                       "median GFT%", "its floor", "GFT [ms]", "its floor [ms]", "GOT [ms]",
                       "GCT [ms]"});
  TextTable angles(
      {hand.digits[static_cast<size_t>(FindOpposingDigit(hand, inputs.grasp))].name + " [deg]",
       "pre-grasp", "target"});
  const auto add_angles = [&](const std::string& variant, const Grasp& grasp) {
    angles.AddRow({variant, FormatAngles(hand, grasp, grasp.q_pre),
                   FormatAngles(hand, grasp, grasp.q_target)});
  };
  std::string text = "\n";
  add_angles(WordsOf(kStandardGrasp), inputs.grasp);
  if (StepsOf(config.optimise).learns_pregrasp) {
    text += "step 1   " + step1.verdict + "\n";
    AddPreGraspStep(step1, finds_strength, decisions);
    add_angles(WordsOf(kNewPreGrasp), result.new_pregrasp);
  }
  if (StepsOf(config.optimise).searches_target) {
    const SearchResult& search = step2.search;
    text += "step 2   " + step2.verdict + "; fitness " +
            FormatFixed(search.individuals.front().fitness, 3) + " -> " +
            FormatFixed(search.individuals[static_cast<size_t>(search.best)].fitness, 3) + " in " +
            FormatCount(static_cast<int>(search.individuals.size()), "evaluation") +
            "; found number " + std::to_string(step2.found) + "\n" +
            FormatHeadroom(inputs, config, step2.check);
    AddTrials("step 2", "before", step2.check.before, finds_strength, decisions);
    AddTrials("step 2", "after", step2.check.after, finds_strength, decisions);
    add_angles(WordsOf(kNewTarget), result.new_target);
  }
  text += "\n" + decisions.Format() + "\n" + angles.Format();
  const std::string& space = config.optimise.search;
  if (!StepsOf(config.optimise).searches_target || space == kThumbSpace) return text;
  return text + FormatCoordinates(step2, space);
}

std::string ListSceneFiles(const std::filesystem::path& folder) {
  std::string text;
  for (const Variant variant : kNewVariants) {
    const std::filesystem::path path = folder / (std::string(NameOf(variant)) + ".yaml");
    if (std::filesystem::exists(path)) text += "grasp    " + path.string() + "\n";
  }
  return text + "data     " + (folder / "result.json").string() + "\n";
}

Json MakeSceneJson(const std::filesystem::path& folder) {
  Json grasps = Json::array();
  for (const Variant variant : kNewVariants) {
    const std::filesystem::path path = folder / (std::string(NameOf(variant)) + ".yaml");
    if (std::filesystem::exists(path)) grasps.push_back(path.string());
  }
  return {{"folder", folder.string()},
          {"grasps", grasps},
          {"result", Json::parse(ReadFile(folder / "result.json"))}};
}

std::string DescribeNumericalFailures(const std::vector<EvaluationRecord>& evaluations) {
  constexpr int kMaxNamed = 10;
  std::string text;
  int count = 0;
  for (const EvaluationRecord& evaluation : evaluations) {
    for (size_t i = 0; i < evaluation.trials.size(); ++i) {
      const LearningTrial& trial = evaluation.trials[i];
      if (trial.outcome != Outcome::kNumericalFailure || ++count > kMaxNamed) continue;
      text += "\n  " + evaluation.trial_ids[i] + ": question " +
              std::to_string(evaluation.request) + ", " + NameOf(evaluation.stage) +
              ", individual " + std::to_string(evaluation.individual.number) + ", draw " +
              std::to_string(trial.draw);
    }
  }
  if (count == 0) return "";
  if (count > kMaxNamed) text += "\n  and " + std::to_string(count - kMaxNamed) + " more";
  return FormatCount(count, "trial") + " failed numerically or timed out" + text;
}

std::string FormatReplay(const ReplayedIndividual& replayed) {
  return replayed.grasp.id + ": fitness " + FormatFixed(replayed.stored_fitness, 6) + " stored, " +
         FormatFixed(replayed.fitness, 6) + " now; " +
         (replayed.is_same ? "all numbers match" : "numbers differ") + "\n";
}

}  // namespace graspbench
