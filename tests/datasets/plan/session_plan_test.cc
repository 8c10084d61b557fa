#include "datasets/plan/session_plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <set>

#include "core/arm/mounted_arm.h"
#include "core/base/error.h"
#include "core/grasp/placement.h"
#include "core/grasp/predict_grasp.h"
#include "core/hand/load_hand.h"
#include "core/hand/tactile.h"
#include "core/shape/primitives.h"
#include "datasets/plan/conditions.h"
#include "tests/datasets/find_error.h"
#include "tests/datasets/session/fake_session.h"

namespace graspbench {
namespace {

std::vector<std::string> ListCells(const std::vector<PlannedTrial>& plan) {
  std::vector<std::string> cells;
  for (const PlannedTrial& planned : plan) {
    if (planned.trial == 0)
      cells.push_back(planned.hand + " " + planned.object + " " + planned.grasp);
  }
  return cells;
}

std::set<std::string> ListIds(const std::vector<PlannedTrial>& plan) {
  std::set<std::string> ids;
  for (const PlannedTrial& planned : plan) ids.insert(planned.id);
  return ids;
}

std::vector<PlannedTrial> MakePlanOf(const std::vector<std::string>& grasps) {
  SessionConfig config;
  config.grasps = grasps;
  return MakePlan(config, MakeFakeInputs());
}

std::pair<ErrorKind, std::string> FindPlanError(const SessionConfig& config,
                                                const SessionInputs& inputs) {
  try {
    MakePlan(config, inputs);
  } catch (const Error& e) {
    return {e.kind(), e.what()};
  }
  ADD_FAILURE() << "no error was thrown";
  return {ErrorKind::kUnsupported, ""};
}

TEST(SessionPlan, OnlyATrialThatLooksDependsOnTheCamera) {
  SessionInputs inputs = MakeFakeInputs();
  for (SessionHand& hand : inputs.hands) {
    auto with_camera = std::make_shared<Hand>(*hand.hand);
    with_camera->camera = HandCamera();
    with_camera->camera->link = 0;
    hand.hand = with_camera;
  }
  SessionConfig config;
  const std::set<std::string> nominal = ListIds(MakePlan(config, MakeFakeInputs()));
  EXPECT_EQ(ListIds(MakePlan(config, inputs)), nominal);
  config.positioning = "true";
  const std::set<std::string> exact = ListIds(MakePlan(config, inputs));
  EXPECT_NE(exact, nominal);
  config.positioning = "camera";
  config.camera.noise = 1.0;
  const std::set<std::string> looking = ListIds(MakePlan(config, inputs));
  EXPECT_NE(looking, exact);
  config.camera.noise = 2.0;
  EXPECT_NE(ListIds(MakePlan(config, inputs)), looking);
}

SessionInputs MakeLookingInputs() {
  SessionInputs inputs = MakeFakeInputs();
  inputs.hands.erase(inputs.hands.begin());  // tum has no g3
  auto with_camera = std::make_shared<Hand>(*inputs.hands[0].hand);
  with_camera->camera = HandCamera();
  with_camera->camera->link = 0;
  inputs.hands[0].hand = with_camera;
  for (Grasp& grasp : inputs.hands[0].grasps) grasp.type = FindGraspTaxon(grasp.id).type;
  return inputs;
}

TEST(SessionPlan, BySightIsOneConditionAndLeavesTheOthersIds) {
  const SessionInputs inputs = MakeLookingInputs();
  SessionConfig config;
  config.objects = {"mug"};
  config.trials = 1;
  config.grasps = {"g2"};
  const std::set<std::string> given = ListIds(MakePlan(config, inputs));
  config.grasps = {"by-sight", "g2"};
  const std::vector<PlannedTrial> plan = MakePlan(config, inputs);
  EXPECT_EQ(ListCells(plan),
            (std::vector<std::string>{"shadow mug by-sight", "shadow mug g2",
                                      "shadow pencil by-sight", "shadow pencil g2"}));
  config.grasps = {"by-sight"};
  const std::set<std::string> looking = ListIds(MakePlan(config, inputs));
  const std::set<std::string> both = ListIds(plan);
  EXPECT_EQ(both.size(), given.size() + looking.size());
  for (const std::string& id : looking) EXPECT_TRUE(both.count(id)) << id;
  const TrialSetup setup = MakeTrialSetup(config, inputs, plan.front());
  ASSERT_EQ(setup.sight_grasps.size(), 3u);
  EXPECT_EQ(setup.sight_grasps[0].id, "g1");
  EXPECT_EQ(setup.sight_grasps[1].id, "g2");
  EXPECT_EQ(setup.sight_grasps[2].id, "g3");
  EXPECT_EQ(setup.grasp.id, "g1");
  EXPECT_TRUE(MakeTrialSetup(config, inputs, plan[1]).sight_grasps.empty());

  // What decides on the choice decides on the id.
  config.camera.noise = 1.0;
  for (const std::string& id : ListIds(MakePlan(config, inputs))) EXPECT_FALSE(looking.count(id));
  config.camera = {};
  SessionInputs other = inputs;
  other.hands[0].grasps[2].tilt += 0.1;
  for (const std::string& id : ListIds(MakePlan(config, other))) EXPECT_FALSE(looking.count(id));
  other.hands[0].grasps[2] = inputs.hands[0].grasps[2];
  other.hands[0].grasps[3].tilt += 0.1;  // a pinch is never suggested
  EXPECT_EQ(ListIds(MakePlan(config, other)), looking);
}

TEST(SessionPlan, BySightNeedsACameraAndAGraspOfEachType) {
  SessionConfig config;
  config.grasps = {"by-sight"};
  EXPECT_EQ(FindPlanError(config, MakeFakeInputs()).second,
            "the hand \"tum\" has no camera to choose its grasp by sight; name a grasp, or add a "
            "camera to its hand.yaml (graspbench help hand.yaml)");
  SessionInputs inputs = MakeLookingInputs();
  std::vector<Grasp>& grasps = inputs.hands[0].grasps;
  grasps.erase(grasps.begin());
  EXPECT_EQ(MakeTrialSetup(config, inputs, MakePlan(config, inputs)[0]).sight_grasps[0].id, "g5");
  grasps.erase(std::remove_if(
                   grasps.begin(), grasps.end(),
                   [](const Grasp& grasp) { return grasp.type == GraspType::kAllFingerPrecision; }),
               grasps.end());
  EXPECT_EQ(FindPlanError(config, inputs).second,
            "the hand \"shadow\" has no grasp g1 (all finger precision) or g5 (three finger "
            "special) or g6 (encompassing precision), which --grasp by-sight may choose; add it to "
            "its hand.yaml (graspbench help "
            "hand.yaml), or name a grasp");
  config.grasps = {"by_sight"};
  EXPECT_EQ(FindPlanError(config, MakeLookingInputs()).second,
            "none of the session's hands has a grasp \"by_sight\"; did you mean \"by-sight\"? "
            "Known: g1, g2, g3, g4, g5, by-sight, rehearsed");
  SessionInputs named = MakeLookingInputs();
  named.hands[0].grasps[4].id = "by-sight";
  config.grasps = {"all"};
  EXPECT_EQ(
      FindPlanError(config, named).second,
      "the grasp \"by-sight\" cannot be used: its name asks for a choice by the camera; rename "
      "it");
}

// Likewise: who does not go by sensed touch has the ids of before, whatever the hand could feel.
TEST(SessionPlan, IdsDependOnTheSensorsOfThoseWhoFeel) {
  SessionInputs inputs = MakeFakeInputs();
  const std::set<std::string> exact = ListIds(MakePlan(SessionConfig(), inputs));
  for (SessionHand& hand : inputs.hands) {
    auto feeling = std::make_shared<Hand>(*hand.hand);
    auto skin = std::make_shared<TactileSkin>();
    skin->content_hash = "a";
    feeling->skin = skin;
    hand.hand = feeling;
  }
  SessionConfig config;
  EXPECT_EQ(ListIds(MakePlan(config, inputs)), exact);
  config.touch = "sensed";
  const std::set<std::string> sensed = ListIds(MakePlan(config, inputs));
  EXPECT_NE(sensed, exact);
  config.sensors.noise = 0.0005;
  EXPECT_NE(ListIds(MakePlan(config, inputs)), sensed);

  const auto [kind, text] = FindPlanError(config, MakeFakeInputs());
  EXPECT_EQ(kind, ErrorKind::kUsage);
  EXPECT_EQ(text,
            "the hand \"tum\" has no tactile elements; use touch: exact, or add a tactile.yaml "
            "(graspbench help tactile.yaml)");
}

TEST(SessionPlan, BestTakesTheObjectsWishThenItsOrderThenWhatThereIs) {
  // shadow has no entry at the pencil: the first of g1, g3, g2, ...
  EXPECT_EQ(ListCells(MakePlanOf({"best"})),
            (std::vector<std::string>{"tum mug g2", "tum pencil g2", "shadow mug g3",
                                      "shadow pencil g1"}));
  SessionInputs inputs = MakeFakeInputs();
  inputs.hands = {MakeFakeHand("tum", 1, 0.0, {"g5", "g3"}),
                  MakeFakeHand("mine", 1, 0.0, {"pinch"})};
  EXPECT_EQ(ListCells(MakePlan(SessionConfig(), inputs)),
            (std::vector<std::string>{"tum mug g3", "tum pencil g3", "mine mug pinch",
                                      "mine pencil pinch"}));
}

TEST(SessionPlan, AGraspOfOneObjectIsTriedOnThatObjectBesideTheBestOne) {
  SessionInputs inputs = MakeFakeInputs();
  Grasp optimised = inputs.hands[0].grasps[0];
  optimised.id = "new-target";
  optimised.object = "pencil";
  inputs.hands[0].grasps.push_back(optimised);
  inputs.grasp_files["some/where.yaml"] = "new-target";
  SessionConfig config;
  config.grasps = {"best", "some/where.yaml"};
  EXPECT_EQ(ListCells(MakePlan(config, inputs)),
            (std::vector<std::string>{"tum mug g2", "tum pencil g2", "tum pencil new-target",
                                      "shadow mug g3", "shadow pencil g1"}));
  config.grasps = {"some/where.yaml"};
  EXPECT_EQ(ListCells(MakePlan(config, inputs)),
            (std::vector<std::string>{"tum pencil new-target"}));

  inputs.hands[0].grasps.push_back(optimised);
  EXPECT_EQ(FindPlanError(config, inputs),
            std::make_pair(
                ErrorKind::kUsage,
                std::string("two grasp files of the session define a grasp \"new-target\" of the "
                            "hand \"tum\" for \"pencil\"; leave one out or change its id")));
  inputs.hands[0].grasps.pop_back();
  inputs.objects.pop_back();  // the pencil
  EXPECT_EQ(FindPlanError(config, inputs),
            std::make_pair(ErrorKind::kUsage,
                           std::string("the session has no trial: none of its grasps is for its "
                                       "hands and objects")));
}

TEST(SessionPlan, AllAndIdsGiveWhatTheHandCanDo) {
  EXPECT_EQ(MakePlanOf({"all"}).size(), 10u * 2u * (2u + 5u));
  EXPECT_EQ(ListCells(MakePlanOf({"g3", "g1"})),
            (std::vector<std::string>{"tum mug g1", "tum pencil g1", "shadow mug g3",
                                      "shadow mug g1", "shadow pencil g3", "shadow pencil g1"}));
}

TEST(SessionPlan, IdsAreSixteenDigitsAndDiffer) {
  const auto plan = MakePlanOf({"all"});
  EXPECT_EQ(ListIds(plan).size(), plan.size());
  for (const PlannedTrial& planned : plan) {
    EXPECT_EQ(planned.id.size(), 16u);
    EXPECT_EQ(planned.id.find_first_not_of("0123456789abcdef"), std::string::npos);
  }
}

TEST(SessionPlan, OtherHandsObjectsGraspsAndMoreTrialsLeaveTheIdsAlone) {
  const auto ids = ListIds(MakePlanOf({"best"}));
  SessionConfig config;
  config.trials = 20;
  config.grasps = {"all"};
  config.hands = {"any", "names"};
  SessionInputs inputs = MakeFakeInputs();
  inputs.hands.insert(inputs.hands.begin(), MakeFakeHand("another", 4, 0.1, {"g1"}));
  inputs.objects.insert(inputs.objects.begin(), MakeFakeObject("brick"));
  const auto more = ListIds(MakePlan(config, inputs));
  EXPECT_TRUE(std::includes(more.begin(), more.end(), ids.begin(), ids.end()));
}

TEST(SessionPlan, EverythingThatMattersChangesTheIds) {
  SessionInputs plain = MakeFakeInputs();
  const std::set<std::string> ids = ListIds(MakePlan(SessionConfig(), plain));
  const auto expect_others = [&](const std::string& what, const SessionConfig& config,
                                 const SessionInputs& inputs) {
    for (const std::string& id : ListIds(MakePlan(config, inputs))) {
      EXPECT_EQ(ids.count(id), 0u) << what;
    }
  };
  for (const char* setting : {"seed=2", "variation.offset_m=0.004", "variation.yaw_rad=0",
                              "sim.step_s=0.001", "strategy.lift_time_s=1.5"}) {
    SessionConfig config;
    ApplySetting(setting, config);
    expect_others(setting, config, plain);
  }
  const std::pair<const char*, std::function<void(Grasp&)>> changes[] = {
      {"q_pre", [](Grasp& grasp) { grasp.q_pre[0] += 1e-15; }},
      {"q_target", [](Grasp& grasp) { grasp.q_target[0] += 1e-9; }},
      {"alpha", [](Grasp& grasp) { grasp.alpha = 0.1; }},
      {"tilt", [](Grasp& grasp) { grasp.tilt = 0.1; }},
      {"approach_distance", [](Grasp& grasp) { grasp.approach_distance = 0.2; }},
      {"digits", [](Grasp& grasp) { grasp.digits = {"TH"}; }},
      {"palm_may_touch", [](Grasp& grasp) { grasp.palm_may_touch = true; }},
      {"type", [](Grasp& grasp) { grasp.type = GraspType::kPower; }},
      {"seeks_palm", [](Grasp& grasp) { grasp.seeks_palm = true; }},
      {"palm_gap", [](Grasp& grasp) { grasp.palm_gap = 0.001; }},
      {"approach", [](Grasp& grasp) { grasp.approach = Approach::kSide; }},
      {"placement", [](Grasp& grasp) { grasp.placement = Placement(); }},
  };
  for (const auto& [what, change] : changes) {
    SessionInputs inputs = MakeFakeInputs();  // without what was fitted before
    for (SessionHand& hand : inputs.hands) {
      for (Grasp& grasp : hand.grasps) change(grasp);
    }
    expect_others(what, SessionConfig(), inputs);
  }
  SessionInputs other_hands = plain, other_objects = plain;
  for (SessionHand& hand : other_hands.hands) {
    auto changed = std::make_shared<Hand>(*hand.hand);
    changed->content_hash += "+";
    hand.hand = changed;
  }
  expect_others("hands", SessionConfig(), other_hands);
  for (auto& object : other_objects.objects) {
    auto changed = std::make_shared<GraspObject>(*object);
    changed->content_hash += "+";
    object = changed;
  }
  expect_others("objects", SessionConfig(), other_objects);
}

TEST(SessionPlan, TellsWhatCannotBePlanned) {
  const SessionInputs fake = MakeFakeInputs();
  SessionConfig unknown, in_condition, looking, empty;
  unknown.grasps = {"g1", "g7"};
  EXPECT_EQ(FindPlanError(unknown, fake),
            std::pair(ErrorKind::kNotFound,
                      std::string("none of the session's hands has a grasp \"g7\"; did you mean "
                                  "\"g1\"? Known: g1, g2, g3, g4, g5, by-sight, rehearsed")));
  in_condition.conditions = {{"other", {"grasp=g7"}}};
  SessionInputs inputs = fake;
  inputs.conditions["other"] = ApplyCondition(in_condition.conditions.front(), in_condition);
  inputs.conditions["other"].inputs = std::make_shared<const SessionInputs>(fake);
  EXPECT_TRUE(Has(FindPlanError(in_condition, inputs).second,
                  "none of the session's hands has a grasp \"g7\""));
  looking.positioning = "camera";
  EXPECT_EQ(FindPlanError(looking, fake).second,
            "the hand \"tum\" has no camera to position it; choose another positioning, or add a "
            "camera to its hand.yaml (graspbench help hand.yaml)");
  empty.trials = 0;
  EXPECT_EQ(FindPlanError(empty, fake).first, ErrorKind::kRange);
  inputs = fake;
  inputs.hands.push_back(inputs.hands[0]);
  EXPECT_EQ(FindPlanError(SessionConfig(), inputs),
            std::pair(ErrorKind::kUsage, std::string("two hands of the session are called \"tum\"; "
                                                     "leave one out or rename its folder")));
  inputs = fake;
  inputs.objects.push_back(MakeFakeObject("mug"));
  EXPECT_TRUE(Has(FindPlanError(SessionConfig(), inputs).second, "two objects of the session"));
  inputs = fake;
  inputs.hands = {MakeFakeHand("fist", 1, 0.0, {})};
  EXPECT_EQ(FindPlanError(SessionConfig(), inputs).second,
            "none of the session's hands has a grasp; graspbench hand develop finds grasps");
}

// A course is part of the trial; neither a controller nor an arm follows it.
TEST(SessionPlan, AGraspWithACourseIsAnotherTrialWithoutControllerAndArm) {
  const SessionInputs fake = MakeFakeInputs();
  SessionInputs inputs = fake;
  for (SessionHand& hand : inputs.hands) {
    for (Grasp& grasp : hand.grasps) grasp.course.p_HAway = {{0.0, 0.0, -0.01}, {0.0, 0.0, 0.0}};
  }
  const std::set<std::string> still = ListIds(MakePlan(SessionConfig(), fake));
  for (const std::string& id : ListIds(MakePlan(SessionConfig(), inputs))) {
    EXPECT_EQ(still.count(id), 0u);
  }
  SessionConfig controlled;
  controlled.policy.command = "x";
  const std::string text = FindPlanError(controlled, inputs).second;
  EXPECT_TRUE(Has(text, "follows a recorded course, which a controller does not")) << text;
  inputs.hands.front().arm = std::make_shared<MountedArm>();
  EXPECT_TRUE(Has(FindPlanError(SessionConfig(), inputs).second, "which no robot arm can follow"));
}

// As a level of a sweep, too: the base knows its contacts, the condition is to feel them.
TEST(SessionPlan, RefusesAHandThatFeelsNothingUnderEveryCondition) {
  SessionConfig config;
  config.hands = {"tum-original"};
  config.objects = {"can"};
  config.grasps = {"g1"};
  config.conditions = {{"touch=sensed", {"touch=sensed"}}};
  const SessionInputs inputs = LoadSessionInputs(config);
  EXPECT_TRUE(Has(FindError([&] { MakePlan(config, inputs); }),
                  "\"tum-original\" has no tactile elements"));
}

TEST(TrialDraw, EveryHandMeetsTheSamePoses) {
  const SessionInputs inputs = MakeFakeInputs();
  const SessionConfig config;
  for (int trial = 0; trial < 10; ++trial) {
    const TrialDraw a = MakeTrialDraw(config, *inputs.hands[0].hand, *inputs.objects[0], trial);
    const TrialDraw b = MakeTrialDraw(config, *inputs.hands[1].hand, *inputs.objects[0], trial);
    EXPECT_EQ(a.offset_x, b.offset_x);
    EXPECT_EQ(a.offset_y, b.offset_y);
    EXPECT_EQ(a.offset_yaw, b.offset_yaw);
    const TrialDraw c = MakeTrialDraw(config, *inputs.hands[0].hand, *inputs.objects[1], trial);
    EXPECT_NE(a.offset_x, c.offset_x);
  }
}

TEST(TrialDraw, FillsItsRangesEvenly) {
  const SessionInputs inputs = MakeFakeInputs();
  const SessionConfig config;
  const Hand& hand = *inputs.hands[0].hand;
  constexpr int kNumDraws = 4000;
  Eigen::Array4d mean = Eigen::Array4d::Zero(), square = Eigen::Array4d::Zero();
  for (int trial = 0; trial < kNumDraws; ++trial) {
    const TrialDraw draw = MakeTrialDraw(config, hand, *inputs.objects[0], trial);
    ASSERT_EQ(draw.joint_error.size(), 2);
    EXPECT_EQ(draw.joint_error[1], 0.0);  // coupled: no drive of its own
    const Eigen::Array4d value(
        draw.offset_x / config.variation.offset, draw.offset_y / config.variation.offset,
        draw.offset_yaw / config.variation.yaw, draw.joint_error[0] / hand.joint_accuracy);
    EXPECT_TRUE((value.abs() <= 1.0).all());
    mean += value / kNumDraws;
    square += value.square() / kNumDraws;
  }
  // Uniform on [-1, 1]: mean 0, mean square 1/3; four standard errors.
  EXPECT_TRUE((mean.abs() < 4.0 * std::sqrt(1.0 / 3.0 / kNumDraws)).all()) << mean.transpose();
  EXPECT_TRUE(((square - 1.0 / 3.0).abs() < 4.0 * std::sqrt(4.0 / 45.0 / kNumDraws)).all());
}

// A turn of 0.1 rad moves a point at 30 mm by 3 mm; at right angles to a shift of 4 mm that is 5 mm.
TEST(TrialDraw, DistanceHoldsShiftAndTurn) {
  TrialDraw a, b;
  b.offset_y = -0.004;
  b.offset_yaw = 0.1;
  EXPECT_NEAR(CalcDrawDistance(a, b, 0.03), 0.005, 1e-15);
  EXPECT_EQ(CalcDrawDistance(a, b, 0.03), CalcDrawDistance(b, a, 0.03));
  EXPECT_EQ(CalcDrawDistance(b, b, 0.03), 0.0);
}

}  // namespace
}  // namespace graspbench
