#include "human_study/statistics/reliability/reliability.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"
#include "tests/human_study/faults.h"
#include "tests/human_study/statistics/known_studies.h"

namespace graspbench {

namespace {

// Shrout and Fleiss 1979, table 2: six targets, four judges. Digits beyond theirs: R, psych 2.2.
std::vector<PersonTrials> MakeShroutFleiss() {
  return {{"1", {9, 2, 5, 8}}, {"2", {6, 1, 3, 2}},  {"3", {8, 4, 6, 8}},
          {"4", {7, 1, 2, 6}}, {"5", {10, 5, 6, 9}}, {"6", {6, 2, 4, 7}}};
}

void ExpectIcc(const Icc& icc, const char* name, double value, double low, double high) {
  EXPECT_EQ(NameOf(icc), name);
  EXPECT_NEAR(icc.value, value, 1e-9) << name;
  EXPECT_NEAR(icc.interval.low, low, 1e-9) << name;
  EXPECT_NEAR(icc.interval.high, high, 1e-9) << name;
}

TEST(Icc, AgreesWithShroutAndFleiss) {
  const auto one_way = CalcIcc(MakeShroutFleiss(), IccForm::kOneWay);
  const auto agreement = CalcIcc(MakeShroutFleiss(), IccForm::kAgreement);
  const auto consistency = CalcIcc(MakeShroutFleiss(), IccForm::kConsistency);
  ASSERT_TRUE(one_way && agreement && consistency);
  ExpectIcc(one_way->single, "ICC(1,1)", 0.1657417684, -0.13293232487, 0.7225600623);
  ExpectIcc(agreement->single, "ICC(2,1)", 0.2897637795, 0.01878651337, 0.7610843696);
  ExpectIcc(consistency->single, "ICC(3,1)", 0.7148407148, 0.34246476503, 0.9458582600);
  ExpectIcc(one_way->average, "ICC(1,k)", 0.4427971337, -0.88444215524, 0.9124154203);
  ExpectIcc(agreement->average, "ICC(2,k)", 0.6200505476, 0.07113681530, 0.9272320402);
  ExpectIcc(consistency->average, "ICC(3,k)", 0.9093155424, 0.67567471382, 0.9858916782);
  EXPECT_EQ(one_way->average.num_trials, 4.0);
}

std::vector<PersonTrials> MakeUnbalanced() {
  return {{"A", {10.1, 9.7, NAN, 10.6}},
          {"B", {12.0, 11.4, 12.9, 12.2}},
          {"C", {9.0, 9.9}},
          {"D", {11.1, 10.2, 10.9, 11.8, 10.5}},
          {"E", {8.7, 9.1, 8.2}}};
}

TEST(Icc, AllowsDifferentNumbersOfTrialsInTheOneWayFormAlone) {
  // Formulas of Searle and of Thomas and Hultquist evaluated in R.
  const auto one_way = CalcIcc(MakeUnbalanced(), IccForm::kOneWay);
  ASSERT_TRUE(one_way) << one_way.reason();
  EXPECT_NEAR(one_way->average.num_trials, 3.32352941176, 1e-11);
  EXPECT_NEAR(one_way->single.value, 0.841649541463, 1e-11);
  EXPECT_NEAR(one_way->single.interval.low, 0.503311559398, 1e-11);
  EXPECT_NEAR(one_way->single.interval.high, 0.979543435655, 1e-11);
  EXPECT_EQ(CalcIcc(MakeUnbalanced(), IccForm::kAgreement).reason(),
            "persons have 2 to 5 trials; a two-way form needs the same for all");
  EXPECT_EQ(CalcIcc({{"A", {1, 2}}, {"B", {3, NAN}}}, IccForm::kConsistency).reason(),
            "person \"B\" has no value in trial 2; a two-way form needs all");
}

TEST(Icc, GivesReasons) {
  for (IccForm form : {IccForm::kAgreement, IccForm::kConsistency}) {
    EXPECT_EQ(CalcIcc({{"A", {1, 2}}}, form).reason(), "1 person; expected 2 or more");
    EXPECT_EQ(CalcIcc({{"A", {1}}, {"B", {2}}}, form).reason(),
              "one trial a person; expected 2 or more");
    EXPECT_EQ(CalcIcc({{"A", {0.1, 0.3}}, {"B", {0.4, 0.6}}}, form).reason(),
              "persons differ by the same amount in every trial: no rest to compare with");
  }
  EXPECT_EQ(CalcIcc({{"A", {1, 1}}, {"B", {2, 2}}}, IccForm::kOneWay).reason(),
            "the values of every group are equal: no spread within");
  EXPECT_EQ(CalcIcc({{"A", {1, -1}}, {"B", {-1, 1}}}, IccForm::kAgreement).reason(),
            "neither persons nor trials differ");
  EXPECT_EQ(CalcIcc({}, IccForm::kOneWay).reason(), "0 persons with a value; expected 2 or more");
  EXPECT_EQ(CalcIcc({{"A", {1}}, {"B", {2, NAN}}}, IccForm::kOneWay).reason(),
            "no person has two trials");
}

TEST(Icc, NegativeOnesStayAndTheirIntervalIsOrdered) {
  const std::vector<PersonTrials> alike = {
      {"A", {1.0, 5.0, 3.1}}, {"B", {5.2, 1.0, 3.0}}, {"C", {3.0, 2.9, 3.2}}};
  for (IccForm form : {IccForm::kOneWay, IccForm::kAgreement, IccForm::kConsistency}) {
    const auto icc = CalcIcc(alike, form);
    ASSERT_TRUE(icc) << icc.reason();
    EXPECT_LT(icc->single.value, 0.0);
    EXPECT_LT(icc->single.interval.low, icc->single.value);
    EXPECT_GT(icc->single.interval.high, icc->single.value);
    EXPECT_EQ(CalcTrialsNeeded(icc->single, 0.9).reason(),
              "the ICC of one trial is not positive: no number of trials would do");
  }
}

TEST(Icc, FormsDifferByPracticeAlone) {
  std::vector<PersonTrials> practised = MakeShroutFleiss();
  for (PersonTrials& person : practised) {
    for (size_t trial = 0; trial < person.values.size(); ++trial) {
      person.values[trial] += 3.0 * static_cast<double>(trial);
    }
  }
  const double plain = CalcIcc(MakeShroutFleiss(), IccForm::kConsistency)->single.value;
  EXPECT_NEAR(CalcIcc(practised, IccForm::kConsistency)->single.value, plain, 1e-12);
  EXPECT_LT(CalcIcc(practised, IccForm::kAgreement)->single.value, plain);
}

TEST(Reliability, AgreesWithR) {
  const auto result = CalcReliability(MakeUnbalanced());
  ASSERT_TRUE(result) << result.reason();
  EXPECT_EQ(result->num_persons, 5);
  EXPECT_EQ(result->num_values, 17);
  EXPECT_EQ(result->num_missing, 1);
  EXPECT_NEAR(result->mean, 10.255, 1e-12);
  EXPECT_NEAR(result->within_person_sd, 0.567585040129, 1e-11);
  EXPECT_NEAR(result->within_person_interval.low, 0.407007277877, 1e-11);
  EXPECT_NEAR(result->within_person_interval.high, 0.936932570141, 1e-11);
  EXPECT_NEAR(result->between_person_sd, 1.30853975975, 1e-10);
  EXPECT_NEAR(result->minimal_detectable_change, 1.959964 * std::sqrt(2.0) * 0.56758504, 1e-6);
  EXPECT_FALSE(result->agreement);
  // 0.9 (1 - 0.8416) / (0.8416 * 0.1) = 1.69
  EXPECT_EQ(result->trials_needed->num_trials, 2);
  EXPECT_EQ(result->trials_needed->fewest, 1);
  EXPECT_EQ(*result->trials_needed->most, 9);  // 8.88
}

TEST(Reliability, RecoversWhatTheTrialsWereMadeOf) {
  // 400 persons x 5 trials: standard deviation 3 between, 2 within; ICC = 9 / 13.
  RandomStream random("reliability", "test");
  std::vector<PersonTrials> persons;
  for (int p = 0; p < 400; ++p) {
    const double own = 50.0 + 3.0 * random.NextNormal();
    persons.push_back({std::to_string(p), {}});
    for (int t = 0; t < 5; ++t) persons.back().values.push_back(own + 2.0 * random.NextNormal());
  }
  const auto result = CalcReliability(persons);
  EXPECT_NEAR(result->within_person_sd, 2.0, 0.1);
  EXPECT_NEAR(result->between_person_sd, 3.0, 0.35);
  EXPECT_NEAR(result->one_way->single.value, 9.0 / 13.0, 0.06);
  EXPECT_NEAR(result->agreement->single.value, 9.0 / 13.0, 0.06);
  EXPECT_EQ(result->trials_needed->num_trials, 4);  // 9 * 4 / 9
}

TEST(Reliability, TheTrialsNeededReachWhatWasWantedAndNoFewerDo) {
  for (double icc : {0.05, 0.3, 0.5, 0.75, 0.89, 0.9, 0.99, 1.0}) {
    const auto needed = CalcTrialsNeeded({IccForm::kOneWay, 1.0, icc, {-0.1, 1.0}}, 0.9);
    const auto of_mean = [&](double k) { return k * icc / (1.0 + (k - 1.0) * icc); };
    EXPECT_GE(of_mean(needed->num_trials), 0.9 - 1e-9);
    if (needed->num_trials > 1) {
      EXPECT_LT(of_mean(needed->num_trials - 1), 0.9);
    }
    EXPECT_EQ(needed->most.reason(), "the interval of the ICC reaches 0");
  }
  EXPECT_EQ(CalcTrialsNeeded({IccForm::kOneWay, 1.0, 0.5, {0.1, 0.9}}, 0.9)->num_trials, 9);
}

TEST(Reliability, GivesReasons) {
  EXPECT_EQ(CalcReliability({{"A", {1, 2}}}).reason(), "1 person with a value; expected 2 or more");
  EXPECT_EQ(CalcReliability({{"A", {1, INFINITY}}, {"B", {1, 2}}}).reason(),
            "person \"A\": a value is infinite");
  EXPECT_EQ(CalcReliability({{"A", {NAN}}, {"B", {}}}).reason(),
            "0 persons with a value; expected 2 or more");
}

TEST(ListTrials, TakesOneCellInOrder) {
  MeasureTable table = MakeReachTable();
  table.rows.push_back({"P2", "5", {"45"}, NAN});
  const auto trials = ListTrials(table, 1);
  ASSERT_TRUE(trials);
  ASSERT_EQ(trials->size(), 8u);
  EXPECT_EQ((*trials)[1].person, "P2");
  EXPECT_EQ((*trials)[1].values.size(), 2u);
  EXPECT_EQ((*trials)[1].values[0], 71.0);
  table.rows[0].levels = {"x"};
  EXPECT_EQ(ListTrials(table, 1).reason(),
            "person \"P1\", trial \"1\": \"x\" is not a level of factor \"size\"");
}

/** The ratings of Shrout and Fleiss (1979), judges as sessions; every session has two trials about
the rating, and two conditions that differ by 2. */
MeasureTable MakeSessions() {
  const double ratings[6][4] = {{9, 2, 5, 8}, {6, 1, 3, 2},  {8, 4, 6, 8},
                                {7, 1, 2, 6}, {10, 5, 6, 9}, {6, 2, 4, 7}};
  MeasureTable table;
  table.factors = {{"side", {"left", "right"}, {}, ""}};
  table.sessions = {"1", "2", "3", "4"};
  for (int person = 0; person < 6; ++person) {
    for (int session = 0; session < 4; ++session) {
      for (const int side : {0, 1}) {
        for (const double off : {-0.25, 0.25}) {
          table.rows.push_back({"P" + std::to_string(person),
                                "",
                                {side == 0 ? "left" : "right"},
                                ratings[person][session] + off + (side == 0 ? -1.0 : 1.0),
                                {},
                                std::to_string(session + 1)});
        }
      }
    }
  }
  return table;
}

TEST(Retest, IsShroutAndFleissOfTheSessionsMeans) {
  const Answer<Retest> retest = CalcRetest(MakeSessions());
  ASSERT_TRUE(retest) << retest.reason();
  ASSERT_TRUE(retest->reliability) << retest->reliability.reason();
  EXPECT_NEAR(retest->reliability->agreement->single.value, 0.29, 0.005);
  EXPECT_NEAR(retest->reliability->consistency->single.value, 0.71, 0.005);
  ASSERT_EQ(retest->shifts.size(), 3u);
  EXPECT_NEAR(retest->shifts[0].test->mean, 15.0 / 6.0 - 46.0 / 6.0, 1e-12);
}

TEST(Retest, ASessionMayBeAFactorToo) {
  MeasureTable table = MakeSessions();
  table.factors.push_back({"day", table.sessions, {}, ""});
  for (Observation& row : table.rows) row.levels.push_back(row.session);
  const Answer<Retest> retest = CalcRetest(table);
  ASSERT_TRUE(retest) << retest.reason();
  EXPECT_NEAR(retest->reliability->agreement->single.value, 0.29, 0.005);
}

TEST(Retest, LeavesOutWhoMissedASession) {
  MeasureTable table = MakeSessions();
  for (Observation& row : table.rows) {
    if (row.person == "P2" && row.session == "3" && row.levels[0] == "left") row.value = NAN;
  }
  const Answer<Retest> retest = CalcRetest(table);
  ASSERT_TRUE(retest) << retest.reason();
  EXPECT_EQ(retest->persons.size(), 5u);
  ASSERT_EQ(retest->left_out.size(), 1u);
  EXPECT_EQ(retest->left_out[0].reason, "no value in left, 3");
}

TEST(Retest, GivesReasons) {
  MeasureTable table = MakeSessions();
  table.sessions = {"1"};
  EXPECT_EQ(CalcRetest(table).reason(), "1 session; expected 2 or more");
  table = MakeSessions();
  table.rows[0].session.clear();
  ExpectHolds(CalcRetest(table).reason(), "is not a level of factor \"session");
}

}  // namespace

}  // namespace graspbench
