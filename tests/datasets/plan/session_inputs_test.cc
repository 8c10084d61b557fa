#include "datasets/plan/session_inputs.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "datasets/plan/session_plan.h"

namespace graspbench {
namespace {

TEST(SessionInputs, LoadsWhatTheConfigurationNamesInItsOrder) {
  SessionConfig config;
  config.hands = {"tum-original", "shadow"};
  config.objects = {"tennis_ball", "adhesive_tape"};
  const SessionInputs inputs = LoadSessionInputs(config);
  ASSERT_EQ(inputs.hands.size(), 2u);
  EXPECT_EQ(inputs.hands[0].hand->id, "tum-original");
  EXPECT_EQ(inputs.hands[1].hand->id, "shadow");
  ASSERT_EQ(inputs.objects.size(), 2u);
  EXPECT_EQ(inputs.objects[0]->id, "tennis_ball");
  EXPECT_EQ(inputs.objects[1]->id, "adhesive_tape");
  // The hand in its first form can do one grasp only, whatever the object would like best.
  const auto plan = MakePlan(config, inputs);
  ASSERT_EQ(plan.size(), 40u);
  EXPECT_EQ(plan[0].grasp, "g1");
  EXPECT_EQ(plan[20].grasp, "g3");
}

TEST(SessionInputs, TheSessionsApproachComesBeforeAllOthers) {
  SessionConfig config;
  config.hands = {"tum"};
  config.objects = {"golf_ball"};
  for (const char* name : {"automatic", "side", "above"}) {
    config.approach = name;
    const SessionInputs inputs = LoadSessionInputs(config, FieldUse::kLater);
    EXPECT_EQ(RowOf(kApproaches, inputs.objects[0]->approach).name, std::string(name));
    for (const Grasp& grasp : inputs.hands[0].grasps) {
      EXPECT_EQ(RowOf(kApproaches, grasp.approach).name, std::string(name));
    }
  }
}

TEST(SessionInputs, SuggestsNames) {
  SessionConfig config;
  config.hands = {"shadwo"};
  try {
    LoadSessionInputs(config);
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::kNotFound);
    EXPECT_NE(std::string(e.what()).find("did you mean \"shadow\"?"), std::string::npos)
        << e.what();
  }
}

}  // namespace
}  // namespace graspbench
