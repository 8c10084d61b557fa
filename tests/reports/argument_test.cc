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
  EXPECT_EQ(
      MakeNumber(kFormingTime, -5.0, -25.0, 15.0).would_decide,
      "about 336 scenes instead of 21, if the others vary alike; the catalogue has 21 objects");
  EXPECT_EQ(FormatWanted(8, 2, "object"), "about 8 objects instead of 2");
}

// 98.1 % before leave 1.9 points: no interval can say that 2 are not gained.
TEST(Judge, ACeilingRefutesNothingUnlessTheEffectIsOpposite) {
  const auto judge = [](double room, double low, double high) {
    ArgumentNumber number = MakeNumber(kSuccessChange, 0.5 * (low + high), low, high);
    number.room = room;
    number.would_decide.clear();
    Judge(number);
    return number;
  };
  const ArgumentNumber at_ceiling = judge(1.9, -15.2, 1.0);
  EXPECT_EQ(FormatVerdict(at_ceiling),
            "not decided (ceiling: at most 1.9 points are possible, fewer than the smallest effect "
            "of 2 points)");
  EXPECT_EQ(at_ceiling.would_decide, "harder objects or draws, on which more can be gained");
  EXPECT_EQ(judge(2.0, -15.2, 1.0).verdict, ArgumentVerdict::kRefuted);
  // A loss that matters refutes; a smaller one may be chance among few failures.
  EXPECT_EQ(judge(1.9, -15.2, -2.1).verdict, ArgumentVerdict::kRefuted);
  EXPECT_EQ(judge(1.9, -15.2, -1.9).verdict, ArgumentVerdict::kNotDecided);
  EXPECT_EQ(judge(1.9, 0.1, 1.8).verdict, ArgumentVerdict::kShown);
  EXPECT_EQ(judge(1.9, -15.2, 2.5).why, "");  // too wide an interval is the nearer reason
  ArgumentClaim claim;
  claim.question = &kArgumentQuestions[4];
  claim.numbers = {at_ceiling};
  claim.verdict = JudgeClaim(claim.numbers);
  EXPECT_NE(claim.sentence().find("Not decided: tum (ceiling: at most 1.9 points are possible"),
            std::string::npos)
      << claim.sentence();
}

TEST(DescribeRule, NamesBothLinesAndWhichWins) {
  EXPECT_EQ(DescribeRule(kFormingTime),
            "Shown: the whole interval lies left of 0. Refuted: the whole interval lies right of "
            "-10 ms (marked), so that an effect of 10 ms is excluded. An interval that meets "
            "both is shown.");
  EXPECT_EQ(DescribeRule(kStability),
            "Shown: the whole interval lies right of 1. Refuted: the whole interval lies left of "
            "1.05 (marked), so that an effect of 0.05 is excluded. An interval that meets both "
            "is shown.");
}

// 1.005 lies beyond 1, and the reader must see it.
TEST(FormatNumber, NoEndIsRoundedOntoTheNullValue) {
  EXPECT_EQ(FormatNumber(MakeNumber(kPeopleRatio, 0.9646, 0.3654, 1.0048)),
            "0.965 (0.365 to 1.005), 21 scenes");
  EXPECT_EQ(FormatNumber(MakeNumber(kFormingTime, -20.0, -40.0, 0.0)),
            "-20 ms (-40 to 0), 21 scenes");
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
  EXPECT_NE(text.find("(a) not run: It is not decided whether people's digits touch more "
                      "simultaneously than independent digits would. Command: graspbench "
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
                             "GFT 50 ms, GFT at most 1.2 times its floor in 0 of 8 scenes; a new "
                             "pre-grasp tested in 7 scenes, no change in the others"),
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

TEST(ArgumentWorlds, ACeilingIsNotDecidedAndALossAtItIsRefuted) {
  WorldSize none = SizeOf(Truth::kFalse), loss = none;
  none.is_at_ceiling = loss.is_at_ceiling = true;
  loss.success = -0.1;
  for (uint64_t seed = 1; seed <= 3; ++seed) {
    const ArgumentClaim claim = MakeArgument(MakeArgumentWorld(4, Truth::kFalse, none, seed)).at(4);
    EXPECT_EQ(claim.verdict, ArgumentVerdict::kNotDecided) << seed;
    EXPECT_NE(claim.sentence().find("ceiling"), std::string::npos) << claim.sentence();
    EXPECT_EQ(NameWorld(4, Truth::kFalse, loss, seed), ArgumentVerdict::kRefuted) << seed;
  }
}

// The map's rule asks for more than the interval; the page states which condition is not met.
TEST(Argument, AMapsIntervalLeftOfZeroWithoutItsTestNamesTheTest) {
  MapCell cell;
  cell.hand = "tum";
  cell.late = LateDigit::kLast;
  cell.num_pairs = 588;
  cell.num_objects = 21;
  cell.undelayed = 0.78;
  cell.estimate = -0.02;
  cell.interval = Interval{-0.054, -0.003};
  cell.adjusted_p = 0.067;
  MapPartResult part;
  part.map.hands = {"tum"};
  part.map.cells = {cell};
  MapResult map;
  map.command = "graspbench map simultaneity";
  map.parts = {part};
  const ArgumentNumber open = ListRobotNumbers({{"late", map}}).at(0);
  EXPECT_EQ(FormatVerdict(open), "not decided (adjusted p 0.067, above 0.05)");
  EXPECT_EQ(open.command, "graspbench map simultaneity");
  map.parts[0].map.cells[0].interval = Interval{-0.054, 0.003};
  EXPECT_EQ(FormatVerdict(ListRobotNumbers({{"late", map}}).at(0)), "not decided");
  map.parts[0].map.cells[0].verdict = MapVerdict::kCosts;
  EXPECT_EQ(FormatVerdict(ListRobotNumbers({{"late", map}}).at(0)), "shown");
  map.parts[0].map.cells[0].verdict = MapVerdict::kCeiling;
  EXPECT_EQ(FormatVerdict(ListRobotNumbers({{"late", map}}).at(0)),
            "not decided (ceiling: 78.0\u00a0% succeed without delay)");
}

TEST(ArgumentSources, SyntheticParticipantsAreNoStudy) {
  ArgumentSources sources;
  sources.people.resize(2);
  sources.people[0].is_synthetic = true;
  EXPECT_EQ(sources.Describe(), "1 study, 1 study of synthetic participants");
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
