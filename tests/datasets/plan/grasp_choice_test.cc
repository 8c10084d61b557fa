#include "datasets/plan/grasp_choice.h"

#include <gtest/gtest.h>

#include "core/grasp/placement.h"
#include "core/hand/load_hand.h"
#include "core/shape/primitives.h"
#include "objects/catalogue.h"
#include "tests/datasets/session/fake_session.h"

namespace graspbench {
namespace {

std::shared_ptr<GraspObject> MakeBlock(const std::string& id, double width) {
  auto block = MakeFakeObject(id);
  block->size = Eigen::Vector3d(0.2, width, 0.04);
  block->mesh = MakeRoundedBox(block->size, 1e-5);
  block->grasp_order = {"g4", "g1"};
  return block;
}

/** A hand of a user's, whose fingers do not span 200 mm but 30. */
SessionInputs MakeInputsOf(const std::vector<std::shared_ptr<const GraspObject>>& objects) {
  auto hand = std::make_shared<Hand>(LoadHand("tum"));
  hand->id = "mine";
  SessionInputs inputs = MakeFakeInputs();
  inputs.hands = {{hand, LoadStandardGrasps(*hand)}};
  inputs.objects = objects;
  return inputs;
}

TEST(GraspChoice, WhatNoGraspReachesIsKnownBeforeTheSession) {
  const SessionInputs inputs = MakeInputsOf({MakeBlock("bar", 0.03), MakeBlock("slab", 0.2)});
  const std::vector<UnreachedObject> unreached = FindUnreached(SessionConfig(), inputs);
  ASSERT_EQ(unreached.size(), 1u);
  EXPECT_EQ(unreached[0].hand, "mine");
  EXPECT_EQ(unreached[0].object, "slab");
  EXPECT_EQ(unreached[0].tried, (std::vector<std::string>{"g4", "g1"}));
  EXPECT_EQ(DescribeUnreached({"mine", "slab", {"g4", "g1"}, "g1", 0.00625}),
            "mine, slab: none of g4, g1 reaches it, so every trial will be unreachable; nearest is "
            "g1, whose pads stop 6.2 mm short");
  EXPECT_EQ(DescribeUnreached({"mine", "slab", {"g1"}, "g1", 0.01}),
            "mine, slab: g1 does not reach it, so every trial will be unreachable; its pads stop "
            "10.0 mm short");
}

// The pads must pass the slab's top by 3 mm: their middle where they would meet it, by forward
// kinematics alone.
TEST(GraspChoice, TheMissIsThatOfThePads) {
  const SessionInputs inputs = MakeInputsOf({MakeBlock("slab", 0.2)});
  const UnreachedObject unreached = FindUnreached(SessionConfig(), inputs).at(0);
  const Hand& hand = *inputs.hands[0].hand;
  const auto slab = CompleteObject(inputs.objects[0]);
  double nearest = 1.0;
  for (const std::string& id : unreached.tried) {
    const Grasp& grasp = *FindGrasp(inputs.hands[0], *slab, id);
    const Placement placement = CalcPlacement(hand, grasp, *slab);
    EXPECT_FALSE(placement.reaches_object);
    const std::vector<Pose> X_HL =
        CalcLinkPoses(hand, CalcClosingPosture(hand, grasp, placement.closing_at_contact));
    double height = 0.0, num_fingers = static_cast<double>(grasp.digits.size()) - 1.0;
    for (const Digit& digit : hand.digits) {
      if (!std::count(grasp.digits.begin(), grasp.digits.end(), digit.id)) continue;
      const double z = (placement.X_WH * (X_HL[digit.distal_link] * digit.p_LPad)).z();
      height += 0.5 * (digit.is_thumb ? z : z / num_fingers);
    }
    const double miss = height - (slab->size.z() - 0.003);
    EXPECT_NEAR(CalcReachMiss(hand, grasp, *slab), miss, 1e-9) << id;
    nearest = std::min(nearest, miss);
  }
  EXPECT_NEAR(unreached.miss, nearest, 1e-9);
}

// The catalogue says which grasp of a shipped hand is best; that is believed.
TEST(GraspChoice, AnObjectThatNamesItsGraspIsNotAskedAbout) {
  auto slab = MakeBlock("slab", 0.2);
  slab->best_grasp["mine"] = "g1";
  EXPECT_TRUE(FindUnreached(SessionConfig(), MakeInputsOf({slab})).empty());
  SessionConfig config;
  config.grasps = {"g1"};
  EXPECT_EQ(FindUnreached(config, MakeInputsOf({slab})).size(), 1u);
}

// One that the pads reach but the open hand meets on its way: named with the room that it lacks.
TEST(GraspChoice, WhatNoGraspClearsIsKnownBeforeTheSession) {
  EXPECT_EQ(
      DescribeUnreached({"mine", "slab", {"g4", "g1"}, "g1", 0.0, 0.0031}),
      "mine, slab: none of g4, g1 is clear of it wherever a draw puts it, so digits may touch "
      "it before they close; nearest is g1, which lacks 3.1 mm beside the object");
  EXPECT_EQ(DescribeUnreached({"mine", "slab", {"g1"}, "g1", 0.0, 0.0031}),
            "mine, slab: g1 is not clear of it wherever a draw puts it, so digits may touch it "
            "before they close; it lacks 3.1 mm beside the object");
  EXPECT_EQ(DescribeUnreached({"mine", "slab", {"g1"}, "g1", 0.01, 0.0, 0.12, 0.1014}),
            "mine, slab: g1 does not reach it, so every trial will be unreachable; its pads stop "
            "10.0 mm short: it is 120.0 mm wide, and they open to 101.4 mm");
}

// A sheet below the pads: they close above it, and nothing is in their way.
TEST(GraspChoice, WhatNoGraspMeetsIsKnownBeforeTheSession) {
  auto sheet = MakeFakeObject("sheet");
  sheet->size = Eigen::Vector3d(0.05, 0.05, 0.0004);
  sheet->mesh = MakeRoundedBox(sheet->size, 1e-5);
  SessionConfig config;
  config.grasps = {"g1"};
  const std::vector<UnreachedObject> unreached = FindUnreached(config, MakeInputsOf({sheet}));
  ASSERT_EQ(unreached.size(), 1u);
  EXPECT_EQ(DescribeUnreached(unreached[0]),
            "mine, sheet: g1 does not meet it with its opposing digit and another when it closes");
}

// Each name is a promise: that another works does not help one that never does.
TEST(GraspChoice, EveryNamedGraspIsAskedAbout) {
  const SessionInputs inputs = MakeInputsOf({LoadObject("cup")});
  SessionConfig config;
  config.grasps = {"g5", "g4"};
  const std::vector<UnreachedObject> unreached = FindUnreached(config, inputs);
  ASSERT_EQ(unreached.size(), 1u);
  EXPECT_EQ(unreached[0].tried, std::vector<std::string>{"g4"});
  config.grasps = {"all"};
  EXPECT_TRUE(FindUnreached(config, inputs).empty());
}

// The grasp that comes first in the object's order is not taken where it is not clear of it.
TEST(GraspChoice, TheFirstThatIsClearIsBest) {
  auto beam = MakeBlock("beam", 0.06);
  beam->approach = Approach::kAbove;
  const SessionInputs inputs = MakeInputsOf({MakeBlock("bar", 0.03), beam});
  SessionConfig config;
  for (const auto& object : inputs.objects) {
    const auto complete = CompleteObject(object);
    const Grasp& best = *FindGrasps(config, inputs, inputs.hands[0], object).at(0);
    const Grasp fitted = FindFitted(inputs, inputs.hands[0], best, object);
    const GraspPrediction prediction = PredictGrasp(*inputs.hands[0].hand, fitted, *complete);
    EXPECT_TRUE(prediction.reaches() && prediction.is_clear()) << object->id;
  }
  // As it is, the pinch, which the blocks' order names first, does not clear 60 mm.
  const Grasp& pinch = *FindGrasp(inputs.hands[0], *beam, "g4");
  EXPECT_FALSE(
      PredictGrasp(*inputs.hands[0].hand, pinch, *CompleteObject(inputs.objects[1])).is_clear());
}

// A grasp whose development held next to nothing is taken only where no other can take the object.
TEST(GraspChoice, WhatDidNotHoldInDevelopmentComesLast) {
  const auto bar = MakeBlock("bar", 0.03);
  SessionInputs inputs = MakeInputsOf({bar});
  const auto best = [&] {
    return FindGrasps(SessionConfig(), inputs, inputs.hands[0], bar).at(0)->id;
  };
  ASSERT_EQ(best(), "g4");
  const auto set_share = [&](const std::string& id, double share) {
    for (Grasp& grasp : inputs.hands[0].grasps) {
      if (grasp.id == id) grasp.held_share = share;
    }
  };
  set_share("g4", 0.49);
  EXPECT_EQ(best(), "g1");
  set_share("g1", 0.1);
  EXPECT_EQ(best(), "g4") << "both alike";
  set_share("g4", 0.5);
  EXPECT_EQ(best(), "g4");
}

// A condition under which another grasp would be best compares the base's all the same.
TEST(GraspChoice, UnderAConditionTheBaseChooses) {
  const auto bar = MakeBlock("bar", 0.03);
  const SessionInputs base = MakeInputsOf({bar});
  SessionInputs changed = MakeInputsOf({MakeBlock("bar", 0.03)});
  for (Grasp& grasp : changed.hands[0].grasps) {
    if (grasp.id == "g4") grasp.held_share = 0.1;
  }
  const auto best = [&] {
    return FindGrasps(SessionConfig(), changed, changed.hands[0], changed.objects[0]);
  };
  ASSERT_EQ(best().at(0)->id, "g1");
  changed.base = std::make_shared<const SessionInputs>(base);
  ASSERT_EQ(best().at(0)->id, "g4");
  EXPECT_EQ(best().at(0)->held_share, 0.1) << "as the condition's hand does it";
  changed.hands[0].grasps.erase(changed.hands[0].grasps.begin() + 3);
  EXPECT_TRUE(best().empty()) << "it cannot do the base's";
}

// Nor is it taken for coming clear of an object, where another reaches it and is known to hold.
TEST(GraspChoice, HoldingInDevelopmentCountsMoreThanRoom) {
  GraspPrediction clear, tight, short_of_it;
  clear.room = 0.01;
  tight.room = -0.01;
  short_of_it.reach_miss = 0.001;
  Grasp holds, does_not, unchecked;
  holds.held_share = 0.9;
  does_not.held_share = 0.0;
  EXPECT_GT(RankGrasp(holds, tight), RankGrasp(does_not, clear));
  EXPECT_GT(RankGrasp(unchecked, tight), RankGrasp(does_not, clear)) << "nothing is known of it";
  EXPECT_GT(RankGrasp(holds, clear), RankGrasp(holds, tight));
  EXPECT_GT(RankGrasp(does_not, tight), RankGrasp(holds, short_of_it)) << "reach comes first";
  GraspPrediction meets = tight;
  meets.num_touching = 2;
  EXPECT_EQ(RankGrasp(does_not, meets).meets, RankGrasp(does_not, tight).meets)
      << "fingers alone do not hold it";
  meets.thumb_touches = true;
  EXPECT_GT(RankGrasp(does_not, meets), RankGrasp(holds, clear))
      << "what closes above the object cannot hold it";
}

// Of grasps that are alike otherwise the one that meets the object lower: pushed above its centre of
// mass, it tips.
TEST(GraspChoice, LowContactsWin) {
  GraspPrediction low, high;
  low.contact_height = -0.01;
  high.contact_height = 0.005;
  EXPECT_GT(RankGrasp(Grasp(), low), RankGrasp(Grasp(), high));
  high.num_touching = high.num_digits = 3;
  low.num_digits = 3;
  EXPECT_GT(RankGrasp(Grasp(), high), RankGrasp(Grasp(), low)) << "a digit that misses counts more";
}

TEST(GraspChoice, WhatTheObjectNamesStaysAsItIs) {
  auto slab = MakeBlock("slab", 0.2);
  slab->best_grasp["mine"] = "g1";
  const SessionInputs inputs = MakeInputsOf({slab});
  const Grasp& g1 = *FindGrasp(inputs.hands[0], *slab, "g1");
  EXPECT_EQ(FindFitted(inputs, inputs.hands[0], g1, inputs.objects[0]).q_pre, g1.q_pre);
}

TEST(GraspChoice, AnObjectThatTipsOverIsNamed) {
  auto bar = MakeBlock("bar", 0.03);
  bar->turned_to_rest = RadFromDeg(80.0);
  const auto warnings = ListObjectWarnings(SessionConfig(), MakeInputsOf({bar}));
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0],
            "bar tips over by 80 deg when it is set down as its mesh lies; it is grasped as it "
            "rests");
}

}  // namespace
}  // namespace graspbench
