#include "datasets/plan/model_config.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/config.h"
#include "core/base/files/files.h"
#include "datasets/plan/frozen_folder.h"
#include "datasets/plan/session_plan.h"
#include "tests/datasets/session/fake_session.h"

namespace graspbench {
namespace {

SessionInputs LoadWith(const std::vector<std::string>& settings) {
  SessionConfig config;
  config.hands = {"shadow"};
  config.objects = {"can"};
  for (const std::string& setting : settings) ApplySetting(setting, config);
  return LoadSessionInputs(config);
}

TEST(ModelConfig, EachFactorChangesItsNumbersAlone) {
  const SessionInputs plain = LoadWith({});
  const SessionInputs scaled =
      LoadWith({"model.mass_scale=2", "model.friction_scale=0.5", "model.pad_torsion_scale=3",
                "model.pad_stiffness_scale=5", "model.drive_torque_scale=0.25",
                "model.joint_error_scale=4", "model.coupling_rule=even"});
  const GraspObject &can = *plain.objects[0], &other = *scaled.objects[0];
  EXPECT_EQ(other.mass_properties.mass, 2.0 * can.mass_properties.mass);
  EXPECT_EQ(other.mass_properties.I_OOcm, 2.0 * can.mass_properties.I_OOcm);
  EXPECT_EQ(other.mass_properties.p_OOcm, can.mass_properties.p_OOcm);
  EXPECT_EQ(other.surface.friction_static, 0.5 * can.surface.friction_static);
  EXPECT_EQ(other.surface.friction_dynamic, 0.5 * can.surface.friction_dynamic);
  const Hand &hand = *plain.hands[0].hand, &changed = *scaled.hands[0].hand;
  EXPECT_EQ(changed.coupling, CouplingRule::kEven);
  EXPECT_EQ(changed.joint_accuracy, 4.0 * hand.joint_accuracy);
  int num_pads = 0;
  for (size_t i = 0; i < hand.links.size(); ++i) {
    const SoftPad &before = hand.links[i].surface.pad, &after = changed.links[i].surface.pad;
    EXPECT_EQ(changed.links[i].mass, hand.links[i].mass);
    EXPECT_EQ(after.youngs_modulus, 5.0 * before.youngs_modulus);
    EXPECT_EQ(after.depth, before.depth);
    EXPECT_EQ(after.torsion_scale, 3.0);
    if (before.youngs_modulus > 0.0) ++num_pads;
  }
  EXPECT_EQ(num_pads, 17);
  for (size_t i = 0; i < hand.joints.size(); ++i) {
    EXPECT_EQ(changed.joints[i].drive.torque_limit, 0.25 * hand.joints[i].drive.torque_limit);
    EXPECT_EQ(changed.joints[i].drive.stiffness, hand.joints[i].drive.stiffness);
  }
  EXPECT_EQ(LoadWith({"model.coupling_rule=own"}).hands[0].hand->coupling, hand.coupling);
}

// A trial of other masses is another trial, but meets the same pose and the same joint errors.
TEST(ModelConfig, ChangesIdsAndNoDraws) {
  SessionConfig config, changed;
  ApplySetting("model.mass_scale=2", changed);
  const SessionInputs inputs = MakeFakeInputs();
  const std::vector<PlannedTrial> plan = MakePlan(config, inputs),
                                  other = MakePlan(changed, inputs);
  ASSERT_EQ(plan.size(), other.size());
  for (size_t i = 0; i < plan.size(); ++i) {
    EXPECT_NE(plan[i].id, other[i].id);
    const TrialDraw a = MakeTrialSetup(config, inputs, plan[i]).draw;
    const TrialDraw b = MakeTrialSetup(changed, inputs, other[i]).draw;
    EXPECT_EQ(a.offset_x, b.offset_x);
    EXPECT_EQ(a.offset_yaw, b.offset_yaw);
    EXPECT_EQ(a.joint_error, b.joint_error);
  }
}

}  // namespace
}  // namespace graspbench
