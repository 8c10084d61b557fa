#include <gtest/gtest.h>

#include <cmath>

#include "core/base/text/text.h"
#include "human_study/study/output/statistics_table.h"
#include "reports/kind_pages.h"
#include "reports/page/html.h"
#include "tests/reports/argument_worlds.h"

namespace graspbench {
namespace {

ArgumentNumber MakeNumber(const ArgumentMeasure& measure, double value, double low, double high) {
  ArgumentNumber number;
  number.measure = &measure;
  number.subject = "tum";
  number.decides = true;
  number.value = value;
  number.interval = {low, high};
  number.n = 21;
  number.of = "scene";
  Judge(number);
  return number;
}

TEST(JudgeNumber, FollowsTheClaimedSideAndTheSmallestEffect) {
  // Step 1 expects less, and 10 ms matter.
  EXPECT_EQ(JudgeNumber(kFormingTime, {-30.0, -1.0}), ArgumentVerdict::kShown);
  EXPECT_EQ(JudgeNumber(kFormingTime, {-9.0, 4.0}), ArgumentVerdict::kRefuted);
  EXPECT_EQ(JudgeNumber(kFormingTime, {2.0, 9.0}), ArgumentVerdict::kRefuted);
  EXPECT_EQ(JudgeNumber(kFormingTime, {-11.0, 4.0}), ArgumentVerdict::kNotDecided);
  EXPECT_EQ(JudgeNumber(kStability, {1.01, 1.4}), ArgumentVerdict::kShown);
  EXPECT_EQ(JudgeNumber(kStability, {0.9, 1.04}), ArgumentVerdict::kRefuted);
  EXPECT_EQ(JudgeNumber(kStability, {0.9, 1.2}), ArgumentVerdict::kNotDecided);
  // Nothing changes: no step is refuted by less.
  EXPECT_EQ(JudgeNumber(kFormingTime, {0.0, 0.0}), ArgumentVerdict::kRefuted);
}

TEST(JudgeNumber, WithoutAnIntervalNothingIsDecided) {
  const ArgumentNumber number = MakeNumber(kStability, 3.0, kUnset, kUnset);
  EXPECT_EQ(number.verdict, ArgumentVerdict::kNotDecided);
  EXPECT_EQ(FormatNumber(number), "3.00 (no interval), 21 scenes");
}

// Half the width of 40 about 5: 10 points are to be told apart from 5, so 5 must be resolved, a
// quarter of the half-width 20: sixteen times as many.
TEST(CountToDecide, IsTheSquareOfTheHalfWidthOverWhatIsToBeDecided) {
  EXPECT_EQ(CountToDecide(kFormingTime, -5.0, {-25.0, 15.0}, 10), 160);
  EXPECT_EQ(CountToDecide(kFormingTime, -40.0, {-80.0, 0.0}, 10), 0);  // it is wide enough apart
  EXPECT_EQ(MakeNumber(kFormingTime, -5.0, -25.0, 15.0).would_decide,
            "about 336 scenes instead of 21");
}

TEST(JudgeClaim, OneOfTwoHandsRefutes) {
  const ArgumentNumber shown = MakeNumber(kStability, 1.3, 1.1, 1.5);
  const ArgumentNumber refuted = MakeNumber(kStability, 1.0, 0.98, 1.02);
  const ArgumentNumber open = MakeNumber(kStability, 1.1, 0.9, 1.4);
  EXPECT_EQ(JudgeClaim({shown, shown}), ArgumentVerdict::kShown);
  EXPECT_EQ(JudgeClaim({shown, refuted}), ArgumentVerdict::kRefuted);
  EXPECT_EQ(JudgeClaim({shown, open}), ArgumentVerdict::kNotDecided);
  EXPECT_EQ(JudgeClaim({}), ArgumentVerdict::kNotDecided);
  ArgumentNumber beside = refuted;
  beside.decides = false;
  EXPECT_EQ(JudgeClaim({shown, beside}), ArgumentVerdict::kShown);
  EXPECT_EQ(JudgeClaim({beside}), ArgumentVerdict::kNotDecided);
}

TEST(Argument, WithoutAnyResultEveryClaimIsNotRunAndNamesItsCommand) {
  const std::vector<ArgumentClaim> claims = MakeArgument({});
  ASSERT_EQ(claims.size(), 5u);
  for (const ArgumentClaim& claim : claims) {
    EXPECT_EQ(claim.verdict, ArgumentVerdict::kNotDecided);
    EXPECT_FALSE(claim.was_run());
    ASSERT_FALSE(claim.not_run.empty());
    EXPECT_EQ(claim.not_run.front().command.rfind("graspbench ", 0), 0u);
  }
  const std::string text = FormatArgument(claims);
  EXPECT_NE(text.find("(a) not decided: It is not decided whether people's digits touch more "
                      "simultaneously than independent digits would. Not run. Command: graspbench "
                      "study run STUDY.yaml --out DIR\n"),
            std::string::npos)
      << text;
}

TEST(ArgumentWorlds, AFewOfEachClaimAndTruthGetTheirName) {
  for (int claim = 0; claim < kNumArgumentClaims; ++claim) {
    for (const Truth truth : {Truth::kTrue, Truth::kFalse, Truth::kAbsent}) {
      const ArgumentVerdict right = truth == Truth::kTrue    ? ArgumentVerdict::kShown
                                    : truth == Truth::kFalse ? ArgumentVerdict::kRefuted
                                                             : ArgumentVerdict::kNotDecided;
      int num_right = 0;
      for (uint64_t seed = 1; seed <= 2; ++seed) {
        const ArgumentVerdict verdict = NameWorld(claim, truth, SizeOf(truth), seed);
        num_right += verdict == right;
        if (truth == Truth::kAbsent) {
          EXPECT_EQ(verdict, right) << kArgumentQuestions[claim].id;
        }
      }
      EXPECT_GE(num_right, 1) << kArgumentQuestions[claim].id << static_cast<int>(truth);
    }
  }
}

// The numbers of the line are those of the table: medians by hand.
TEST(Argument, Step1IsTheMedianOverScenesOfWhatResultJsonSays) {
  ArgumentSources sources;
  const auto score = [](double gft) {
    return Json{{"median_gft_s", gft},
                {"gft_floor_s", 0.05},
                {"median_got_s", 0.04},
                {"median_gct_s", 0.5}};
  };
  for (int i = 0; i < 7; ++i) {
    SceneRecord scene;
    scene.config.hand = "tum";
    scene.result["pregrasp_step"] = {
        {"checked", "pre-grasp and closing delays"},
        {"pregrasp_alone", {{"before", score(0.1)}, {"after", score(0.1 - 0.001 * i)}}},
        {"check_before", score(0.1)},
        {"check_after", score(0.04)}};
    sources.scenes.push_back({"scenes", scene});
  }
  SceneRecord kept;  // nothing looked better: the standard pre-grasp stays
  kept.config.hand = "tum";
  kept.result["pregrasp_step"] = {
      {"checked", Json()}, {"pregrasp_alone", Json()}, {"standard", score(0.2)}};
  sources.scenes.push_back({"kept", kept});
  const std::vector<ArgumentNumber> numbers = ListPreGraspNumbers(sources.scenes);
  ASSERT_EQ(numbers.size(), 2u);
  EXPECT_EQ(numbers[0].subject, "tum: pre-grasp alone");
  EXPECT_TRUE(numbers[0].decides);
  EXPECT_EQ(numbers[0].n, 8);
  EXPECT_NEAR(numbers[0].value, -2.5, 1e-9);  // of 0, 0, -1, .., -6
  EXPECT_EQ(numbers[0].verdict, ArgumentVerdict::kRefuted);
  EXPECT_NE(
      numbers[0].detail.find("GFT 100 to 98 ms, GOT 40 to 40 ms, GCT 500 to 500 ms; floor of "
                             "GFT 50 ms, reached within 1.2 times in 0 of 8 scenes; a new one "
                             "was tried in 7"),
      std::string::npos)
      << numbers[0].detail;
  EXPECT_EQ(numbers[1].subject, "tum: pre-grasp and closing delays");
  EXPECT_FALSE(numbers[1].decides);
  EXPECT_NEAR(numbers[1].value, -60.0, 1e-9);
  EXPECT_EQ(numbers[1].interval.high, 0.0);  // of eight, that of order statistics is all of them
  EXPECT_EQ(numbers[1].verdict, ArgumentVerdict::kNotDecided);
}

TEST(Argument, AStudyOfAnEarlierProgramIsNamed) {
  const std::vector<StatisticRow> none;
  try {
    ReadPeopleEvidence(
        "measure,analysis,effect,estimate,low,high,value,effect_size,num_persons,"
        "note\ngct,t,e,1,,,,,,\n",
        "study/statistics.csv");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(std::string(error.what()),
              "study/statistics.csv: no row \"independent digits, verdict\" of "
              "grasp_forming_time_s; run the study again with this program: graspbench study run "
              "STUDY.yaml --out DIR");
  }
  EXPECT_STREQ(kIndependenceVerdictAnalysis, "independent digits, verdict");
}

TEST(ArgumentPage, SaysWhatTheTerminalSays) {
  const WorldSize size = SizeOf(Truth::kTrue);
  ArgumentSources sources = MakeArgumentWorld(2, Truth::kTrue, size, 1);
  for (const auto& scene : MakeArgumentWorld(3, Truth::kFalse, SizeOf(Truth::kFalse), 1).scenes) {
    sources.scenes.push_back(scene);
  }
  const std::vector<ArgumentClaim> claims = MakeArgument(sources);
  const std::string page = MakeArgumentPage(claims, sources.Describe());
  for (const ArgumentClaim& claim : claims) {
    EXPECT_NE(page.find(Text(claim.sentence()).markup()), std::string::npos) << claim.sentence();
    for (const ArgumentNumber& number : claim.numbers) {
      EXPECT_NE(page.find(FormatNumber(number)), std::string::npos) << FormatNumber(number);
    }
    for (const NotRun& one : claim.not_run) {
      EXPECT_NE(page.find(Text(one.command).markup()), std::string::npos) << one.command;
    }
  }
  EXPECT_NE(page.find("<svg"), std::string::npos);
}

}  // namespace
}  // namespace graspbench
