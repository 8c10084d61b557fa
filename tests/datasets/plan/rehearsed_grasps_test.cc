#include "datasets/plan/rehearsed_grasps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "core/arm/load_arm.h"
#include "core/arm/mounted_arm.h"
#include "core/base/files/files.h"
#include "core/base/units.h"
#include "core/hand/load_hand.h"
#include "core/trial/trial_runner.h"
#include "datasets/plan/grasp_choice.h"
#include "datasets/plan/scene_names.h"
#include "datasets/plan/session_inputs.h"
#include "datasets/plan/session_plan.h"
#include "objects/catalogue.h"
#include "tests/datasets/find_error.h"
#include "tests/datasets/session/fake_session.h"

namespace graspbench {
namespace {

RehearsalTask MakeTask(const std::string& object, RehearsalConfig config = {5, 2}) {
  const auto hand = std::make_shared<const Hand>(LoadHand("tum"));
  return MakeRehearsalTask(SessionConfig(), config, hand, LoadStandardGrasps(*hand),
                           LoadObject(object));
}

TEST(RehearsedGrasps, NamesAreReadInEveryForm) {
  EXPECT_TRUE(*ParseRehearsed("rehearsed") == RehearsalConfig());
  EXPECT_TRUE((*ParseRehearsed("rehearsed:80,8") == RehearsalConfig{80, 8}));
  EXPECT_TRUE((*ParseRehearsed("rehearsed-80-8") == RehearsalConfig{80, 8}));
  for (const char* other : {"g1", "best", "rehearsed-mine", "rehearsed-0-4", "rehearsedly"}) {
    EXPECT_FALSE(ParseRehearsed(other)) << other;
  }
  for (const char* wrong : {"rehearsed:", "rehearsed:80", "rehearsed:0,4", "rehearsed:80,101",
                            "rehearsed:a,b", "rehearsed:-1,4"}) {
    EXPECT_TRUE(Throws([&] { ParseRehearsed(wrong); }, ErrorKind::kUsage,
                       "expected rehearsed:N,k with N candidates from 1 to 1000"))
        << wrong;
  }
  const std::vector<std::string> parted = {"g1", "rehearsed:80", "8", "rehearsed:40,4", "best"};
  const std::vector<std::string> joined = {"g1", "rehearsed-80-8", "rehearsed", "best"};
  EXPECT_EQ(JoinRehearsed(parted), joined);
  EXPECT_EQ(FindGraspId("rehearsed:80,8"), "rehearsed-80-8");
  EXPECT_EQ(FindGraspId("rehearsed:80,8,g1"), "rehearsed:80,8,g1") << "parted later";
}

TEST(RehearsedGrasps, ConditionsAskForThemToo) {
  SessionConfig config;
  config.grasps = {"rehearsed", "g1"};
  config.conditions = {{"a", {"grasp=rehearsed-5-4"}}, {"b", {"grasp=rehearsed"}}};
  EXPECT_EQ(ListRehearsals(config).size(), 2u);
}

// Of the first thousand draws of a session none is one of rehearsal, under any of some seeds.
TEST(RehearsedGrasps, NoDrawOfRehearsalIsOneOfASession) {
  const RehearsalTask task = MakeTask("can");
  std::set<double> imagined;
  for (int draw = 0; draw < 100; ++draw) {
    imagined.insert(MakeRehearsalSetup(task, task.object, task.grasps[0], {draw}).draw.offset_x);
  }
  EXPECT_EQ(imagined.size(), 100u);
  SessionConfig config;
  for (config.seed = 0; config.seed < 5; ++config.seed) {
    for (int trial = 0; trial < 200; ++trial) {
      const TrialDraw draw = MakeTrialDraw(config, *task.hand, *task.object, trial);
      EXPECT_EQ(imagined.count(draw.offset_x), 0u) << config.seed << ", " << trial;
    }
  }
}

TEST(RehearsedGrasps, TheGripIsAskedForInShares) {
  const RehearsalTask task = MakeTask("can");
  const StrategyConfig whole = MakePeopleGrip();
  const TrialSetup half = MakeRehearsalSetup(task, task.object, task.grasps[0], {0, 0.5});
  EXPECT_EQ(half.strategy.grip_force, 0.5 * whole.grip_force);
  EXPECT_EQ(half.strategy.grip_margin, 1.0 + 0.5 * (whole.grip_margin - 1.0));
  EXPECT_EQ(MakeRehearsalSetup(task, task.object, task.grasps[0], {0}).strategy.grip_margin,
            whole.grip_margin);
}

TEST(RehearsedGrasps, TheHashFollowsWhatDecides) {
  const RehearsalTask task = MakeTask("golf_ball");
  std::set<std::string> hashes = {CalcRehearsalHash(task)};
  EXPECT_EQ(hashes.count(CalcRehearsalHash(MakeTask("golf_ball"))), 1u);
  RehearsalTask other = task;
  other.config.num_draws = 3;
  hashes.insert(CalcRehearsalHash(other));
  other = task;
  other.conditions.strategy.grip_margin = 3.0;
  hashes.insert(CalcRehearsalHash(other));
  other = task;
  other.grasps.pop_back();
  hashes.insert(CalcRehearsalHash(other));
  hashes.insert(CalcRehearsalHash(MakeTask("can")));
  other = task;
  other.conditions.model.friction_scale = 0.5;
  hashes.insert(CalcRehearsalHash(other));
  EXPECT_EQ(hashes.size(), 6u);
}

// What a session takes is what is kept in its folder, to the bit; nothing is rehearsed for it again.
TEST(RehearsedGrasps, ASessionKeepsTheGraspsThatItWasMadeWith) {
  SessionConfig config;
  config.hands = {"tum"};
  config.objects = {"golf_ball"};
  config.grasps = {"rehearsed-5-2"};
  config.trials = 1;
  const SessionInputs inputs = LoadSessionInputs(config);
  const std::vector<PlannedTrial> plan = MakePlan(config, inputs);
  ASSERT_EQ(plan.size(), 1u);
  EXPECT_EQ(plan[0].grasp, "rehearsed-5-2");
  const TemporaryFolder folder;
  CopyRehearsed(inputs, folder.path());
  const std::filesystem::path copy =
      folder.path() / "inputs" / "grasps" / "rehearsed-5-2" / "tum" / "golf_ball.yaml";
  ASSERT_TRUE(std::filesystem::exists(copy));
  const SessionInputs again = LoadSessionInputs(config, FieldUse::kLater, folder.path());
  EXPECT_TRUE(MakePlan(config, again) == plan);
  // A change of the copy is a change of the session, so it is the copy that is taken.
  std::string text = ReadFile(copy);
  const size_t at = text.find("position_m: [");
  ASSERT_NE(at, text.npos);
  text.replace(at, text.find(']', at) - at, "position_m: [0.1, 0.2, 0.3");
  WriteFile(copy, text);
  EXPECT_FALSE(MakePlan(config, LoadSessionInputs(config, FieldUse::kLater, folder.path())) ==
               plan);
}

// In physics: the choice of a golf ball's grasp proves itself, and holds its first draw when it is
// simulated by itself.
TEST(RehearsedGrasps, TheChoiceHoldsItsDrawsInPhysics) {
  const RehearsalTask task = MakeTask("golf_ball");
  const Rehearsal rehearsal = FindRehearsal(task);
  ASSERT_GE(rehearsal.choice().CountHeld(), kNumProofDraws - 1);
  const auto kept = FindKeptRehearsal(task);
  ASSERT_TRUE(kept);
  EXPECT_EQ(FormatJson(RecordToJson(*kept)), FormatJson(RecordToJson(rehearsal)));
  const Grasp grasp =
      CandidateMaker(*task.hand, task.grasps, *task.object).Make(rehearsal.choice().candidate);
  const TrialSetup setup = MakeRehearsalSetup(task, task.object, grasp, {0});
  EXPECT_TRUE(IsSuccess(TrialRunner(setup.hand, setup.object).Run(setup).outcome));
}

// By the rule joint S2 would be 0.6 deg beyond its limit. A ball may be taken from any side.
TEST(RehearsedGrasps, WithAnArmTheHandIsTurnedToWhereTheArmReaches) {
  const auto hand = std::make_shared<const Hand>(LoadHand("shadow"));
  std::vector<Grasp> grasps = LoadStandardGrasps(*hand);
  grasps.erase(
      std::remove_if(grasps.begin(), grasps.end(), [](const Grasp& g) { return g.id != "g1"; }),
      grasps.end());
  RehearsalTask task =
      MakeRehearsalTask(SessionConfig(), {12, 2}, hand, grasps, LoadObject("golf_ball"));
  ArmConfig config;
  config.x = -0.7;
  task.arm = std::make_shared<const MountedArm>(
      MountArm(config, std::make_shared<const Arm>(LoadArm("pa10")), *hand));
  const Rehearsal rehearsal = FindRehearsal(task);
  EXPECT_EQ(rehearsal.tried.front().outcomes, std::vector<Outcome>{Outcome::kArmOutOfReach});
  EXPECT_NE(rehearsal.tried.front().reason.find("joint 2 (S2) would be"), std::string::npos);
  EXPECT_GE(rehearsal.choice().FindRun(), 2) << Describe(rehearsal.choice().candidate);
  EXPECT_GT(std::abs(rehearsal.choice().candidate.place.yaw), RadFromDeg(20.0));
}

TEST(RehearsedGrasps, AHandWithoutGraspsSaysSo) {
  RehearsalTask task = MakeTask("golf_ball");
  task.grasps.clear();
  EXPECT_TRUE(Throws([&] { FindRehearsal(task); }, ErrorKind::kUsage,
                     "has no standard grasp to rehearse on \"golf_ball\""));
}

}  // namespace
}  // namespace graspbench
