#include "human_study/study/design/study_plan.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/human_study/faults.h"

namespace graspbench {
namespace {

class StudyPlanTest : public FolderTest {
 protected:
  /** Two trials a person and size; person p differs by p hundredths between the sizes. */
  void WritePilot(int num_persons, int num_trials = 2) const {
    std::string text = "person,trial,size,size_number,group,measure,value\n";
    for (int person = 0; person < num_persons; ++person) {
      for (int size = 0; size < 2; ++size) {
        for (int trial = 0; trial < num_trials; ++trial) {
          const double value = 0.1 + 0.01 * person * size + (trial == 0 ? -0.005 : 0.005);
          text += "P" + std::to_string(person) + ",1," + (size == 0 ? "30,0.03" : "100,0.1") + "," +
                  (person % 2 == 0 ? "old" : "young") + ",grasp_forming_time_s," +
                  std::to_string(value) + "\n";
        }
      }
    }
    MakeFolder(folder_ / "tidy");
    Write("tidy/tidy.csv", text);
  }
  Pilot Load(const PilotQuestion& question = {}) const { return LoadPilot(folder_, question); }
};

TEST_F(StudyPlanTest, APilotsVariancesAreThoseOfTheAnova) {
  WritePilot(5);
  const Pilot pilot = Load();
  EXPECT_EQ(pilot.factor, "size");
  EXPECT_EQ(pilot.level_a, "30");  // by number, not by letter
  EXPECT_EQ(pilot.level_b, "100");
  EXPECT_FALSE(pilot.is_between);
  EXPECT_EQ(pilot.num_persons, 5);
  EXPECT_NEAR(pilot.difference, 0.02, 1e-9);
  // Pairs 0.01 apart: s^2 = 0.01^2 / 2, with a degree of freedom for each of ten cells.
  EXPECT_NEAR(pilot.trial_variance, 5e-5, 1e-12);
  EXPECT_EQ(pilot.trial_df, 10.0);
  // Differences 0 to 0.04: variance 0.00025, of which trials explain (1/2 + 1/2) 5e-5.
  const PowerDesign design = pilot.MakeDesign(0.01);
  EXPECT_NEAR(design.person_sd, std::sqrt(2.5e-4 - 5e-5), 1e-9);
  EXPECT_NEAR(design.trial_sd, std::sqrt(5e-5), 1e-9);
}

TEST_F(StudyPlanTest, AColumnThatIsTheSameInAPersonIsAGroup) {
  WritePilot(6);
  PilotQuestion question;
  question.factor = "group";
  const Pilot pilot = Load(question);
  EXPECT_TRUE(pilot.is_between);
  EXPECT_EQ(pilot.num_persons, 6);
  EXPECT_EQ(pilot.observed_df, 4.0);
}

TEST_F(StudyPlanTest, ThePlanReachesThePowerAndSaysHowSureThePilotIs) {
  WritePilot(5);
  PlanRequest request;
  request.difference = 0.02;
  request.pilot = Load();
  request.trials = {1, 10};
  const StudyPlan plan = MakeStudyPlan(request);
  ASSERT_EQ(plan.rows.size(), 2u);
  EXPECT_GE(*plan.rows[0].num_persons, *plan.rows[1].num_persons);
  for (const PlanRow& row : plan.rows) {
    EXPECT_GT(row.power.interval.high, 0.8);
    ASSERT_TRUE(row.over_pilot);
    EXPECT_LT(row.over_pilot->low, row.power.power);
    EXPECT_GT(row.over_pilot->high, row.power.power);
    // Five persons leave much open.
    EXPECT_LT(row.over_pilot->low, 0.6);
  }
}

TEST_F(StudyPlanTest, RefusesNonsense) {
  struct Case {
    void (*change)(PlanRequest&);
    const char* says;
  };
  const Case cases[] = {
      {[](PlanRequest& r) { r.difference = 0.0; }, "--difference is 0;"},
      {[](PlanRequest& r) { r.difference = NAN; }, "--difference is"},
      {[](PlanRequest& r) { r.difference = 10.0; }, "10 ms is 0.01"},
      {[](PlanRequest& r) { r.stated.trial_sd = -1.0; }, "expected 0 or more"},
      {[](PlanRequest& r) { r.stated = {}; }, "without any spread"},
      {[](PlanRequest& r) { r.wanted = 1.0; }, "--power is 1;"},
      {[](PlanRequest& r) { r.trials = {0}; }, "--trials has 0;"},
      {[](PlanRequest& r) { r.num_persons = 1; }, "--persons is 1;"},
      {[](PlanRequest& r) { r.measure = "gft"; }, "measure \"gft\" is not known"},
      {[](PlanRequest&) {}, ""},
  };
  for (const Case& c : cases) {
    PlanRequest request;
    request.difference = 0.01;
    request.stated.trial_sd = 0.02;
    request.stated.person_sd = 0.01;
    c.change(request);
    const std::string fault = FaultOf([&] { MakeStudyPlan(request); });
    ExpectHolds(fault, c.says);
    EXPECT_EQ(fault.empty(), *c.says == '\0') << fault;
  }
}

TEST_F(StudyPlanTest, APilotThatDoesNotFitIsTold) {
  const auto fault = [&](const PilotQuestion& question = {}) {
    return FaultOf([&] { Load(question); });
  };
  ExpectHolds(fault(), "is no result of graspbench study run");
  WritePilot(5);
  PilotQuestion question;
  question.factor = "sise";
  ExpectHolds(fault(question), "no factor \"sise\"; did you mean \"size\"?");
  question = {};
  question.levels = {"30", "31"};
  ExpectHolds(fault(question), "size has no level \"31\"");
  question = {};
  question.measure = "grasp_opening";
  ExpectHolds(fault(question), "no measure \"grasp_opening\"");
  WritePilot(1);
  EXPECT_EQ(fault(), "the pilot: 1 person has trials at both levels of size; expected 2 or more");
  WritePilot(4, 1);
  ExpectHolds(fault(), "nobody has two trials in a condition");
}

}  // namespace
}  // namespace graspbench
