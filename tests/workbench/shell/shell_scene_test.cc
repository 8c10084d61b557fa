#include "workbench/shell/shell_scene.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "datasets/plan/session_plan.h"
#include "workbench/shell/shell_cards.h"

namespace graspbench {
namespace {

bool Never() { return false; }

SceneChoice MakeChoice(const std::string& hand, const std::string& object,
                       std::optional<int> draw) {
  SceneChoice choice = SceneChoice::MakeDefault();
  choice.config.hands = {hand};
  choice.config.objects = {object};
  choice.draw = draw;
  return choice;
}

/** The record that a session of the same configuration would keep. */
Json RunInSession(const SceneChoice& choice) {
  SessionConfig config = choice.config;
  config.trials = *choice.draw + 1;
  const SessionInputs inputs = LoadSessionInputs(config);
  const TrialSetup setup = MakeTrialSetup(config, inputs, MakePlan(config, inputs).back());
  return ToJson(TrialRunner(setup.hand, setup.object).Run(setup));
}

TEST(ShellScene, ATrialIsThatOfASession) {
  for (const auto& [hand, object] : {std::pair("tum", "golf_ball"), std::pair("shadow", "can")}) {
    const SceneChoice choice = MakeChoice(hand, object, 3);
    ShellScene scene;
    scene.Choose(choice);
    while (scene.Advance()) {
    }
    EXPECT_EQ(ToJson(scene.course().End()), RunInSession(choice)) << hand;
  }
}

TEST(ShellScene, GoingBackAndForthChangesNothing) {
  ShellScene scene;
  scene.Choose(MakeChoice("tum", "golf_ball", 1));
  while (scene.Advance()) {
  }
  const Json result = ToJson(scene.course().End());
  const double end = scene.time();
  scene.GoTo(0.5 * end, Never);
  EXPECT_NEAR(scene.time(), 0.5 * end, 0.002);
  const WorldState middle = scene.course().world().state();
  scene.GoTo(0.123, Never);
  EXPECT_NEAR(scene.time(), 0.123, 0.002);
  scene.GoTo(0.5 * end, Never);
  EXPECT_EQ(scene.course().world().state().q, middle.q);
  EXPECT_EQ(scene.course().world().state().p_WOcm, middle.p_WOcm);
  scene.Reset();
  EXPECT_EQ(scene.time(), 0.0);
  scene.GoTo(1e6, Never);
  EXPECT_TRUE(scene.is_over());
  EXPECT_EQ(ToJson(scene.course().End()), result);
  scene.GoTo(0.5 * end, Never);
  scene.GoTo(scene.time(), Never);
  EXPECT_FALSE(scene.is_over());
  scene.GoTo(end, Never);  // the time at which it was over is its end
  EXPECT_TRUE(scene.is_over());
}

TEST(ShellScene, WhatCannotBeChosenLeavesTheScene) {
  ShellScene scene;
  scene.Choose(MakeChoice("tum", "golf_ball", 1));
  scene.GoTo(0.2, Never);
  const Eigen::VectorXd q = scene.course().world().state().q;
  EXPECT_THROW(scene.Choose(MakeChoice("tum", "no_such_object", 1)), Error);
  SceneChoice wrong = scene.choice();
  wrong.config.sim.step = -1.0;
  EXPECT_THROW(scene.Choose(wrong), Error);
  wrong = scene.choice();
  wrong.config.arm.model = "pa10";
  wrong.config.arm.mount = "up";
  EXPECT_THROW(scene.Choose(wrong), Error);
  EXPECT_EQ(scene.setup().object->id, "golf_ball");
  EXPECT_EQ(scene.course().world().state().q, q);
  EXPECT_TRUE(scene.Advance());
}

TEST(ShellScene, TheCardNamesTheArmAndItsBase) {
  SceneChoice choice = MakeChoice("tum", "golf_ball", std::nullopt);
  ShellScene scene;
  scene.Choose(choice);
  EXPECT_EQ(FormatScene(scene).find("arm  "), std::string::npos);
  choice.config.arm.model = "puma560";
  choice.config.arm.x = -0.6;
  scene.Choose(choice);
  EXPECT_NE(FormatScene(scene).find(
                "\narm      PUMA 560 (puma560), base at -0.600, 0.000, 0.000 m, turned by 0.0 "
                "deg\n"),
            std::string::npos)
      << FormatScene(scene);
}

TEST(ShellScene, EditsReachThePostureAndThePlace) {
  SceneChoice choice = MakeChoice("shadow", "can", std::nullopt);
  ShellScene scene;
  scene.Choose(choice);
  const Hand& hand = *scene.setup().hand;
  const int joint = hand.FindJoint("FFJ3");
  const Eigen::VectorXd before = scene.setup().grasp.q_target;
  choice.joints.push_back({true, "FFJ3", 0.5});
  choice.place = ObjectPlace{0.01, -0.02, 0.3};
  scene.Choose(choice);
  Eigen::VectorXd expected = before;
  expected[joint] = 0.5;
  EXPECT_EQ(scene.setup().grasp.q_target, expected);
  const Pose X_WO = scene.course().world().CalcObjectPose();
  EXPECT_NEAR(X_WO.translation().x(), 0.01, 1e-12);
  EXPECT_NEAR(X_WO.translation().y(), -0.02, 1e-12);
  EXPECT_NEAR(std::atan2(X_WO.linear()(1, 0), X_WO.linear()(0, 0)), 0.3, 1e-12);
}

}  // namespace
}  // namespace graspbench
