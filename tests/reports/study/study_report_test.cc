#include "reports/study/study_report.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "core/base/text/text.h"
#include "human_study/study/synthetic/demo_study.h"
#include "reports/study/contrast.h"
#include "reports/study/study_format.h"
#include "tests/reports/report_fixture.h"

namespace graspbench {
namespace {

namespace fs = std::filesystem;

StudyResult MakeStudy(int num_people) {
  const fs::path folder =
      fs::path(::testing::TempDir()) / ("study_report_test_" + std::to_string(::getpid()));
  fs::remove_all(folder);
  SyntheticOptions options;
  options.seed = "study_report_test";
  options.num_people = num_people;
  options.trials_per_size = 2;
  options.diameters = {0.03, 0.06};
  WriteDemoStudy(MakeSyntheticStudy(options), folder);
  const StudyResult made = RunStudy(LoadStudy(folder / "study.yaml"));
  fs::remove_all(folder);
  return made;
}

/** A small made-up study, analysed once for all tests. */
const StudyResult& SmallStudy() {
  static const StudyResult result = MakeStudy(3);
  return result;
}

struct FormattedContrast {
  std::string difference, low, high;
};

int CountOf(const std::string& text, const std::string& part) {
  int count = 0;
  for (size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

TEST(StudyReport, ThePhasesAreMediansOverTheTrialsThatHaveThem) {
  StudyResult result = SmallStudy();
  int num_kept = 0;
  for (StudyTrial& trial : result.trials) {
    if (!trial.IsKept()) continue;
    TrialAnalysis& analysis = *trial.analysis;
    analysis.movement.onset.time = 2.0;
    analysis.phases.reacceleration.time = num_kept == 0 ? std::nan("") : 2.5;
    analysis.closure_start.time = 2.6;
    analysis.movement.end.time = 2.8;
    analysis.timing.gct = 0.3;
    analysis.object.lift_off.time = 3.0;
    ++num_kept;
  }
  ASSERT_GT(num_kept, 2);
  const std::string page = MakeStudyReport(result, nullptr);
  ExpectSoundPage(page);
  ExpectParts(TextOfId(page, "phases"),
              {"medians of " + std::to_string(num_kept) + " trials", "fast approach, 0 to 50 %",
               "slow approach, 50 to 80 %", "pre-grasp, 0 to 60 %", "closure, 60 to 90 %",
               "stabilisation, 90 to 100 %", "Here 10 % of the time",
               std::to_string(num_kept - 1) + " of " + std::to_string(num_kept)});
  for (StudyTrial& trial : result.trials) {
    if (trial.analysis) trial.analysis->phases.reacceleration.time = std::nan("");
  }
  ExpectParts(TextOfId(MakeStudyReport(result, nullptr), "phases"),
              {"fast approach, 0 to 80 %", "no slow approach was found in any trial"});
}

TEST(StudyReport, WithoutATrialThatCountsItSaysWhyAndDrawsNothing) {
  StudyResult result = SmallStudy();
  for (StudyTrial& trial : result.trials) {
    trial.removed = "too short";
    trial.removed_code = "no_reach";
  }
  result.warnings = {{"same_recording", "a is b"}};
  const std::string page = MakeStudyReport(result, nullptr);
  ExpectSoundPage(page);
  ExpectParts(TextOfId(page, "summary"),
              {"0 of 12 trials were analysed", "same_recording : a is b."});
  ExpectParts(TextOfId(page, "removed"), {"too short", "cut.near_m and cut.far_m"});
  EXPECT_EQ(TextOfId(page, "curves"), "no element curves");
  EXPECT_EQ(TextOfId(page, "tests"), "no element tests");
}

TEST(StudyReport, EverySectionSaysItsNumbers) {
  const StudyResult& result = SmallStudy();
  const std::string page = MakeStudyReport(result, nullptr);
  ExpectSoundPage(page);
  ExpectParts(TextOfId(page, "summary"), {"12 of 12 trials were analysed"});
  ExpectParts(TextOfId(page, "published"), {"Jeannerod 1984", "peak opening over diameter"});
  ExpectParts(TextOfId(page, "removed"), {"No trial was removed."});
  ExpectParts(TextOfId(page, "curves"), {"diameter 30\u00A0mm (6 trials)", "One included trial, "});
  const MeasureStatistics& gft = result.statistics.measures.front();
  ExpectParts(TextOfId(page, "measures"),
              {FormatWithUnit(gft.cells->means.col(1).mean(), gft.measure.unit) + ", 6 trials",
               std::string(NameOf(BarKind::kLoftusMasson))});
  ExpectParts(TextOfId(page, "tests"), {"slope over diameter", "s per m of diameter",
                                        "diameter 60\u00A0mm minus diameter 30\u00A0mm"});
  EXPECT_EQ(TextOfId(page, "tests").find("diameter_m"), std::string::npos);
  ExpectParts(TextOfId(page, "tests"),
              {FormatP(gft.anova->effects[0].test->p), "Friedman",
               FormatSignificant(gft.trends[0].slopes.test->mean, 3), "tested against 0.82",
               "mixed model (REML)", "equivalence, two one-sided t tests"});
  ExpectParts(TextOfId(page, "order"), {"pairs of neighbours are tied."});
  ExpectParts(TextOfId(page, "robot"), {"No robot session was named; --robot DIR"});
  ExpectParts(TextOfId(page, "openings"),
              {"virtual_finger", "not testable with 3 persons (5 or more are needed)"});
  ExpectParts(TextOfId(page, "summary"), {"More reliable than the aperture: not testable"});
  ExpectParts(TextOfId(page, "simultaneity"), {"not testable, only 0 trials in which all 5"});
  ExpectParts(TextOfId(page, "bias"), {"half the cut-off"});
  ExpectParts(TextOfId(page, "multiverse"), {"\u25B6"});
  ExpectParts(TextOfId(page, "trials"), {"01-1, "});
  ExpectParts(TextOfId(page, "methods"),
              {"0 of 12 trials were removed.", "a fixed threshold (50\u00A0mm/s)",
               "bounds of 10.0\u00A0ms for grasp forming time"});
}

// The page begins with what was found: persons under each condition, the difference, its interval.
TEST(StudyReport, BeginsWithItsContrast) {
  const StudyResult& result = SmallStudy();
  const std::string page = MakeStudyReport(result, nullptr);
  const std::string summary = TextOfId(page, "summary");
  const FormattedContrast expected = [&] {
    const std::string& main = result.study.config.multiverse.measure;
    for (const MeasureStatistics& statistics : result.statistics.measures) {
      if (statistics.measure.id != main) continue;
      const Eigen::VectorXd difference =
          statistics.cells->means.col(1) - statistics.cells->means.col(0);
      const double mean = difference.mean();
      const double sd = std::sqrt((difference.array() - mean).square().sum() / 2.0);
      const double half = 4.302653 * sd / std::sqrt(3.0);  // t of 2 degrees of freedom, 97.5 %
      const char* unit = statistics.measure.unit;
      return FormattedContrast{FormatWithUnit(mean, unit), FormatValue(mean - half, unit),
                               FormatWithUnit(mean + half, unit)};
    }
    return FormattedContrast{};
  }();
  ExpectParts(summary, {"diameter 60\u00A0mm minus diameter 30\u00A0mm: " + expected.difference +
                            ", 95 % interval " + expected.low + " to " + expected.high,
                        "(paired t test), n = 3 persons.", "Each thin line is one person's mean"});
  EXPECT_LT(summary.find("(paired t test)"), summary.find("12 of 12 trials were analysed"));
  ExpectParts(summary, {"p is not adjusted over the measures", "peak opening"});
  const std::vector<std::string> sentences = DescribeContrasts(result);
  ASSERT_EQ(sentences.size(), result.statistics.measures.size());
  EXPECT_EQ(std::count_if(sentences.begin(), sentences.end(),
                          [&](const std::string& sentence) {
                            return sentence.find(expected.difference + ", 95 % interval " +
                                                 expected.low) != std::string::npos;
                          }),
            1);
  EXPECT_EQ(CountOf(page, "<title>03</title>"), 1) << "a line for each person";
  ExpectParts(TextOfId(page, "removed"), {"Checks that found nothing ("});
}

TEST(StudyReport, TheArgumentsHaveTheirNumbersAndWhatHasNoneItsReason) {
  StudyResult result = SmallStudy();
  IndependenceNull null;
  null.num_trials = 90;
  null.num_incomplete = 2;
  null.num_persons = 5;
  null.gft.fill({0.0301, 0.0402, 0.0383, 0.0424, 0.002, 0.07});
  null.gft_ratio.fill({0.151, 0.202, 0.193, 0.214, 0.002, 0.05});
  null.shared = SharedTiming{0.021, 0.015, 0.006, 40.0};
  result.statistics.independence = null;
  OpeningFamily& family = result.statistics.openings;
  family.num_tests = 1;
  for (size_t i = 1; i < family.rows.size(); ++i) {
    for (OpeningComparison& comparison : family.rows[i].against_aperture) {
      comparison.no_answer = "a reason that stands once";
    }
  }
  family.rows[1].against_aperture[1] = {1.31, 1.12, 1.53, 0.004, 0.012, 5, ""};
  result.study.freeze = FreezeCheck{"abcdef0123456789", 0, {{"contact.cutoff_hz", "20.0", "12.0"}}};
  const std::string page = MakeStudyReport(result, nullptr);
  ExpectSoundPage(page);
  ExpectParts(TextOfId(page, "summary"),
              {"Choices frozen before any recording (SHA-256 abcdef012345): 1 deviation."});
  ExpectParts(TextOfId(page, "findings"),
              {"Not as frozen: contact.cutoff_hz: frozen 20.0, used 12.0."});
  ExpectParts(TextOfId(page, "summary"),
              {"Simultaneity of people: more simultaneous than digits that move independently "
               "(the digits share 21.0"});
  const std::string together = TextOfId(page, "simultaneity");
  ExpectParts(together,
              {"40.2 (38.3 to 42.4)",
               "2 of the included trials lacked a contact or a clock and were left out."});
  const std::string openings = TextOfId(page, "openings");
  ExpectParts(openings, {"shown for virtual_finger", "1.31 (1.12 to 1.53), p 0.012",
                         "spread of persons: a reason that stands once"});
}

// What cannot be had from one person is said once, not in every cell of every table.
TEST(StudyReport, OnePersonGetsASentenceNotAWall) {
  const std::string page = MakeStudyReport(MakeStudy(1), nullptr);
  ExpectSoundPage(page);
  const std::string tests = TextOfId(page, "tests");
  ExpectParts(tests, {"No measure can be tested:"});
  EXPECT_EQ(CountOf(tests, "repeated-measures ANOVA: none: 1 person"), 1);
  EXPECT_EQ(CountOf(tests, "n/a"), 0);
  EXPECT_EQ(CountOf(TextOfId(page, "measures"), "n/a"), 0);
  EXPECT_EQ(CountOf(TextOfId(page, "openings"), "n/a"), 0);
  ExpectParts(tests, {"Each person's line over diameter, in SI units"});
  EXPECT_EQ(CountOf(TextOfId(MakeStudyReport(SmallStudy(), nullptr), "tests"),
                    "No measure can be tested"),
            0);
}

TEST(StudyReport, TheVerdictHasTheRangeOfEveryNumberOverTheChoices) {
  const StudyResult& result = SmallStudy();
  const UniverseSummary range = SummariseUniverses(result.universes);
  ASSERT_GT(range.num_tests, 1);
  double lowest = 1.0;  // counted anew
  for (const Universe& universe : result.universes) {
    if (universe.test) lowest = std::fmin(lowest, universe.test->greenhouse_geisser.p);
  }
  EXPECT_EQ(range.lowest_p, lowest);
  const std::string text = TextOfId(MakeStudyReport(result, nullptr), "summary");
  ExpectParts(text, {"(p " + FormatP(range.lowest_p) + " to " + FormatP(range.highest_p) +
                     ", below 0.05 in " + std::to_string(range.num_significant) + " of " +
                     std::to_string(range.num_tests) + " choices; eta squared "});
}

TEST(StudyReport, TiedDigitsAreOneOrderWhicheverIsNamedFirst) {
  StudyResult result;
  result.digits = {"TH", "FF", "MF"};
  for (const auto& tied : {std::vector<std::string>{"FF", "TH"}, {"TH", "FF"}}) {
    StudyTrial trial;
    trial.participant = "01";
    trial.analysis.emplace();
    trial.analysis->order.groups = {tied, {"MF"}};
    trial.analysis->order.num_ties = 1;
    trial.analysis->num_touching = 3;
    result.trials.push_back(trial);
  }
  const std::string markup = order_study_section().draw({result, nullptr}).markup();
  ExpectParts(markup, {"TH=FF&lt;MF"});
  EXPECT_EQ(markup.find("FF=TH"), std::string::npos);
  ExpectParts(markup, {"thumb before middle: 2 of 2 trials"});
  EXPECT_EQ(markup.find("thumb before index"), std::string::npos);
  ExpectParts(markup, {"2 of 4 pairs of neighbours are tied."});
}

TEST(StudyReport, HumansStandBesideARobot) {
  const RobotSession robot = {"pilot", MakeSession({"tum"}, {"can"}, "g3", 3)};
  const std::string page = MakeStudyReport(SmallStudy(), &robot);
  ExpectSoundPage(page);
  const std::string text = TextOfId(page, "robot");
  ExpectParts(text, {"humans, all trials", "TUM Hand, power (g3)"});
  EXPECT_EQ(text.find("TUM Hand, all trials"), std::string::npos);  // the same trials once more
  ExpectParts(text, {"Session: pilot.", "32.8"});  // GFT% of the fixture's middle trial
  ExpectParts(text, {"Not compared: people grasped no can in an included trial, but cylinder_30mm, "
                     "cylinder_60mm."});
}

// The robot's digits come at 0.4, 0.5 and 0.6 s: the thumb after 16.7 and the middle finger after
// 33.3 % of closing, and later draws, by 0.01 s each, somewhat less.
TEST(StudyReport, OnTheSameObjectsPeopleAndRobotStandInOnePicture) {
  const RobotSession robot = {"pilot", MakeSession({"tum"}, {"cylinder_60mm"}, "g3", 3)};
  const std::string page = MakeStudyReport(SmallStudy(), &robot);
  ExpectSoundPage(page);
  const std::string text = TextOfId(page, "robot");
  ExpectParts(text,
              {"When digits touch: tum, cylinder_60mm, power (g3)", "16.4 (16.3 to 16.5)",
               "32.8 (32.5 to 33.1)", "graspbench simultaneity pilot --schedules --people STUDY"});
  EXPECT_EQ(text.find("ot compared"), std::string::npos);
}

TEST(StudyReport, AStudyWithoutTrialsSaysSo) {
  StudyResult result;
  result.study.config.name = "</script><img src=x>";
  const std::string page = MakeStudyReport(result, nullptr);
  ExpectSoundPage(page);
  EXPECT_EQ(page.find("<img"), std::string::npos);
  ExpectParts(TextOfId(page, "summary"), {"0 of 0 trials were analysed"});
  ExpectParts(TextOfId(page, "trials"), {"No trial could be analysed."});
}

TEST(StudyFormat, ConditionsHaveNamesAndUnits) {
  Factor size, side;
  size.name = "object_width_m";
  size.levels = {"0.03", "0.045"};
  size.numbers = {0.03, 0.045};
  side.name = "side";
  side.levels = {"left", "right, near"};
  EXPECT_EQ(NameOfFactor("object_width_m"), "object width");
  EXPECT_EQ(NameOfFactor("_m"), " m");
  EXPECT_EQ(NameOfCell("", {}), "all trials");
  EXPECT_EQ(NameOfCell("0.045, left", {size, side}), "object width 45\u00A0mm, side left");
  EXPECT_EQ(NameOfCell("0.03, right, near", {size, side}), "0.03, right, near");  // as it stands
  EXPECT_EQ(NameOfEffect("0.045 - 0.03", {size}),
            "object width 45\u00A0mm minus object width 30\u00A0mm");
  EXPECT_EQ(NameOfEffect("intercept at object_width_m = 0", {size}),
            "intercept at object width = 0");
  EXPECT_EQ(FormatSlopeUnit("s per object_width_m"), "s per m of object width");
  EXPECT_EQ(FormatSlopeUnit("1 per side"), "per side");
}

TEST(StudyFormat, PeopleReadMillisecondsMillimetresAndPerCent) {
  EXPECT_EQ(FormatWithUnit(0.0312, "s"), "31.2\u00A0ms");
  EXPECT_EQ(FormatWithUnit(0.0834, "m"), "83.4\u00A0mm");
  EXPECT_EQ(FormatWithUnit(0.215, "1"), "21.5\u00A0%");
  EXPECT_EQ(FormatWithUnit(5.0, ""), "5.0");
  EXPECT_EQ(FormatWithUnit(std::nan(""), "s"), "n/a");
  EXPECT_EQ(FormatP(0.0004), "< 0.001");
  EXPECT_EQ(FormatP(0.0419), "0.042");
}

}  // namespace
}  // namespace graspbench
