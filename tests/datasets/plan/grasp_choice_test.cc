#include "datasets/plan/grasp_choice.h"

#include <gtest/gtest.h>

#include "core/base/text/text.h"
#include "core/base/units.h"
#include "core/grasp/placement.h"
#include "core/hand/load_hand.h"
#include "core/shape/primitives.h"
#include "objects/catalogue.h"
#include "tests/datasets/find_error.h"
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

/** What is said of the objects before a session of these grasps, a line each. */
std::string Warn(const SessionInputs& inputs, const std::vector<std::string>& grasps = {"best"}) {
  SessionConfig config;
  config.grasps = grasps;
  std::string text;
  for (const std::string& warning : ListObjectWarnings(config, inputs)) text += warning + "\n";
  return text;
}

TEST(GraspChoice, WhatNoGraspReachesIsKnownBeforeTheSession) {
  const std::string text = Warn(MakeInputsOf({MakeBlock("bar", 0.03), MakeBlock("slab", 0.2)}));
  EXPECT_EQ(text.find("bar"), text.npos) << text;
  EXPECT_TRUE(Has(text,
                  "mine, slab: none of g4, g1 reaches it, so every trial will be "
                  "unreachable; nearest is g4, whose pads stop "));
  EXPECT_TRUE(Has(text, " mm short: it is 200.0 mm wide, and they open to "));
}

// The pads must pass the slab's top by 3 mm: their middle where they would meet it, by forward
// kinematics alone.
TEST(GraspChoice, TheMissIsThatOfThePads) {
  const SessionInputs inputs = MakeInputsOf({MakeBlock("slab", 0.2)});
  const Hand& hand = *inputs.hands[0].hand;
  const auto slab = CompleteObject(inputs.objects[0]);
  double nearest = 1.0;
  for (const char* id : {"g4", "g1"}) {
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
    EXPECT_NEAR(CalcReachMiss(hand, grasp, *slab, placement), miss, 1e-9) << id;
    nearest = std::min(nearest, miss);
  }
  EXPECT_TRUE(Has(Warn(inputs), "stop " + FormatFixed(MmFromM(nearest), 1) + " mm short"));
}

// The catalogue says which grasp of a shipped hand is best; that is believed.
TEST(GraspChoice, AnObjectThatNamesItsGraspIsNotAskedAbout) {
  auto slab = MakeBlock("slab", 0.2);
  slab->best_grasp["mine"] = "g1";
  EXPECT_EQ(Warn(MakeInputsOf({slab})), "");
  EXPECT_TRUE(Has(Warn(MakeInputsOf({slab}), {"g1"}), "mine, slab: g1 does not reach it"));
}

// Each name is a promise: that another works does not help one that never does.
TEST(GraspChoice, EveryNamedGraspIsAskedAbout) {
  const SessionInputs inputs = MakeInputsOf({MakeBlock("slab", 0.2), MakeBlock("bar", 0.03)});
  const std::string text = Warn(inputs, {"g4", "g1"});
  EXPECT_TRUE(Has(text, "mine, slab: g4 does not reach it"));
  EXPECT_TRUE(Has(text, "mine, slab: g1 does not reach it"));
  EXPECT_EQ(text.find("bar"), text.npos) << text;
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

// Trials outweigh geometry; a condition compares the base's type.
TEST(GraspChoice, BestIsTheTypeByRehearsal) {
  const auto bar = MakeBlock("bar", 0.03);
  SessionInputs inputs = MakeInputsOf({bar});
  SessionConfig config;
  const auto find = [&](const char* name, const SessionInputs& from) {
    config.grasps = {name};
    return FindGrasps(config, from, from.hands[0], bar).at(0)->id;
  };
  const std::string predicted = find("predicted", inputs), other = predicted == "g1" ? "g4" : "g1";
  EXPECT_EQ(find("best", inputs), predicted) << "nothing was rehearsed";
  inputs.types[{"mine", "bar"}] = {"mine", "bar", other, 2, 4, ""};
  EXPECT_EQ(find("best", inputs), other);
  EXPECT_EQ(find("predicted", inputs), predicted);
  EXPECT_EQ(Warn(inputs), "mine, bar: the grasp chosen by rehearsal, " + other +
                              ", held 2 of 4 imagined trials\n");
  SessionInputs changed = MakeInputsOf({bar});
  changed.base = std::make_shared<const SessionInputs>(inputs);
  EXPECT_EQ(find("best", changed), other);
  inputs.types[{"mine", "bar"}].held = 3;
  EXPECT_EQ(Warn(inputs), "");
}

// A grasp whose development held next to nothing is taken only where no other can take the object.
TEST(GraspChoice, WhatDidNotHoldInDevelopmentComesLast) {
  const auto bar = MakeBlock("bar", 0.03);
  SessionInputs inputs = MakeInputsOf({bar});
  const auto best = [&] {
    return FindGrasps(SessionConfig(), inputs, inputs.hands[0], bar).at(0)->id;
  };
  const std::string first = best();
  const auto set_share = [&](const auto& is_meant, double share) {
    for (Grasp& grasp : inputs.hands[0].grasps) {
      if (is_meant(grasp.id)) grasp.held_share = share;
    }
  };
  const auto is_first = [&](const std::string& id) { return id == first; };
  set_share(is_first, 0.49);
  EXPECT_NE(best(), first);
  set_share([&](const std::string& id) { return id != first; }, 0.1);
  EXPECT_EQ(best(), first) << "all alike";
  set_share(is_first, 0.5);
  EXPECT_EQ(best(), first);
}

// A condition under which another grasp would be best compares the base's all the same.
TEST(GraspChoice, UnderAConditionTheBaseChooses) {
  const auto bar = MakeBlock("bar", 0.03);
  const SessionInputs base = MakeInputsOf({bar});
  SessionInputs changed = MakeInputsOf({MakeBlock("bar", 0.03)});
  const auto best = [&] {
    return FindGrasps(SessionConfig(), changed, changed.hands[0], changed.objects[0]);
  };
  std::vector<Grasp>& grasps = changed.hands[0].grasps;
  const std::string first = best().at(0)->id;
  const auto found = std::find_if(grasps.begin(), grasps.end(),
                                  [&](const Grasp& grasp) { return grasp.id == first; });
  found->held_share = 0.1;
  ASSERT_NE(best().at(0)->id, first);
  changed.base = std::make_shared<const SessionInputs>(base);
  ASSERT_EQ(best().at(0)->id, first);
  EXPECT_EQ(best().at(0)->held_share, 0.1) << "as the condition's hand does it";
  grasps.erase(found);
  EXPECT_TRUE(best().empty()) << "it cannot do the base's";
}

TEST(GraspChoice, AnObjectThatTipsOverIsNamed) {
  auto bar = MakeBlock("bar", 0.03);
  bar->turned_to_rest = RadFromDeg(80.0);
  EXPECT_EQ(Warn(MakeInputsOf({bar})),
            "bar tips over by 80 deg when it is placed in the orientation of its mesh; it is "
            "grasped in its resting pose\n");
}

}  // namespace
}  // namespace graspbench
