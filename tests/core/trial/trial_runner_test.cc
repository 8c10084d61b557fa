#include "core/trial/trial_runner.h"

#include <gtest/gtest.h>

#include <utility>

#include "core/base/error.h"
#include "core/shape/primitives.h"
#include "objects/catalogue.h"
#include "tests/core/trial/trial_setups.h"

namespace graspbench {
namespace {

/** With g1, g2 and g3 to choose from; the last is at hand, so that a trial that does not choose
would do g3. */
TrialSetup MakeTrial(std::shared_ptr<const GraspObject> object) {
  TrialSetup setup = MakeSetup("tum", "g3", std::move(object));
  const std::vector<Grasp> grasps = LoadStandardGrasps(*setup.hand);
  setup.sight_grasps = {grasps[0], grasps[1], grasps[2]};
  return setup;
}

// By the method's words: a can is large and round, a golf ball in between, a board marker thin. What
// happens is what the chosen grasp does where it is given.
TEST(GraspBySight, TheTrialIsThatOfTheGraspThatIsSeen) {
  const std::pair<const char*, const char*> wanted[] = {
      {"can", "g3"}, {"golf_ball", "g1"}, {"board_marker", "g2"}};
  for (const auto& [object, id] : wanted) {
    TrialSetup setup = MakeTrial(LoadObject(object));
    setup.draw.offset_x = 0.003;
    setup.draw.offset_yaw = 0.05;
    const TrialResult seen = RunSetup(setup);
    ASSERT_TRUE(seen.sight_grasp) << object << ": " << seen.reason;
    EXPECT_EQ(*seen.sight_grasp, id) << object;
    Json by_sight = ToJson(seen);
    ExpectSurvivesItsRecord(seen);
    by_sight.erase("sight_grasp");
    for (const Grasp& grasp : std::exchange(setup.sight_grasps, {})) {
      if (grasp.id == id) setup.grasp = grasp;
    }
    EXPECT_EQ(ToJson(RunSetup(setup)), by_sight) << object;
  }
}

// One of the held-out things (tests/core/vision/held_out_things.h): it is "between", and taken for
// roundish.
TEST(GraspBySight, ABarOfSoapIsTakenForRoundish) {
  auto soap = std::make_shared<GraspObject>(*LoadObject("can", FieldUse::kLater));
  soap->id = "soap";
  soap->size = Eigen::Vector3d(0.090, 0.055, 0.030);
  soap->mesh = MakeRoundedBox(soap->size, 0.001);
  const TrialSetup chosen = ChooseGraspBySight(MakeTrial(CompleteObject(soap)));
  EXPECT_EQ(chosen.grasp.id, "g3");
  ASSERT_TRUE(chosen.sight);
  EXPECT_EQ(chosen.sight->grasp, "g3");
  EXPECT_TRUE(chosen.sight_grasps.empty());
}

TEST(GraspBySight, WhatIsNotSeenIsAResultWithItsReason) {
  TrialSetup setup = MakeTrial(LoadObject("remote_control"));
  setup.draw.offset_x = 0.2;
  const TrialResult result = RunSetup(setup);
  EXPECT_EQ(result.outcome, Outcome::kNotSeen);
  EXPECT_EQ(result.reason, "what is seen reaches over the picture's edge");
  EXPECT_EQ(result.sight_grasp, "not seen");
  EXPECT_EQ(result.num_steps, 0);
  ExpectSurvivesItsRecord(result);
}

TEST(GraspBySight, AHandWithoutACameraCannotChoose) {
  TrialSetup setup = MakeTrial(LoadObject("golf_ball"));
  auto blind = std::make_shared<Hand>(*setup.hand);
  blind->camera.reset();
  setup.hand = blind;
  EXPECT_THROW(ChooseGraspBySight(setup), Error);
  EXPECT_EQ(RunSetup(setup).outcome, Outcome::kNumericalFailure);
}

// A runner keeps the last undelayed trial; that of a given grasp is not that of one by sight.
TEST(GraspBySight, ALateDigitIsThatOfTheChosenGrasp) {
  TrialSetup setup = MakeTrial(LoadObject("can"));
  setup.keeps_closing = true;
  setup.grasp = setup.sight_grasps.front();
  TrialSetup given = setup;
  given.sight_grasps.clear();  // g1
  TrialSetup late = setup;
  late.late = LateDigit::kLast;
  late.delay = 0.1;
  const TrialResult alone = RunSetup(late);
  EXPECT_EQ(alone.sight_grasp, "g3");
  TrialRunner runner(setup.hand, setup.object);
  runner.Run(given);
  EXPECT_EQ(ToJson(runner.Run(late)), ToJson(alone));
  runner.Run(setup);
  EXPECT_EQ(ToJson(runner.Run(late)), ToJson(alone));
}

}  // namespace
}  // namespace graspbench
