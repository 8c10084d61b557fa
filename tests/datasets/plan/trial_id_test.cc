#include "datasets/plan/trial_id.h"

#include <gtest/gtest.h>

#include "core/arm/mounted_arm.h"
#include "core/base/config.h"
#include "core/hand/tactile.h"
#include "datasets/plan/session_config.h"

namespace graspbench {
namespace {

/** Of a hand with camera and skin, so that every part of the configuration can be hashed. */
std::string CalcIdOf(const SessionConfig& config) {
  Hand hand;
  hand.links.emplace_back();
  hand.id = "hand";
  hand.content_hash = "0a";
  hand.camera = HandCamera();
  auto skin = std::make_shared<TactileSkin>();
  skin->content_hash = "0b";
  hand.skin = skin;
  GraspObject object;
  object.id = "object";
  object.content_hash = "0c";
  if (!HasArm(config.arm)) return CalcTrialId(config, hand, object, "g1", 3);
  const MountedArm mounted = MountArm(config.arm, std::make_shared<const Arm>(), hand);
  return CalcTrialId(config, hand, object, "g1", 3, &mounted);
}

// Ids of 2026: whatever key is added to the configuration or removed from it, they stay. The physics
// version is hashed, too: a new one gives new ids here and nowhere else.
TEST(TrialId, KnownConfigurationsKeepTheirIds) {
  SessionConfig all;
  for (const char* setting :
       {"positioning=camera", "camera.noise_grey_levels=2", "touch=sensed", "sensors.noise=0.002",
        "imperfections.stick_slip=0.1", "model.mass_scale=2", "sim.step_s=0.001", "seed=7"}) {
    ApplySetting(setting, all);
  }
  EXPECT_EQ(CalcIdOf(SessionConfig()), "f95e532d0edfa377");
  EXPECT_EQ(CalcIdOf(LoadPreset("firm")), "74d07aa1906986c7");
  EXPECT_EQ(CalcIdOf(all), "bb38a6dbb1b2057b");
}

TEST(TrialId, EverySettingOfATrialChangesIt) {
  SessionConfig of_strategy;
  for (const char* setting :
       {"positioning=camera", "touch=sensed", "imperfections.stick_slip=0.1", "arm.model=pa10"})
    ApplySetting(setting, of_strategy);
  SessionConfig of_policy = of_strategy;  // which uses no grip
  ApplySetting("policy.command=x", of_policy);
  for (const FileKey& key : DescribeConfig(of_strategy)) {
    if (key.key.find('.') == key.key.npos || key.type != KeyType::kNumber) continue;
    const SessionConfig& base = key.key.rfind("policy.", 0) == 0 ? of_policy : of_strategy;
    SessionConfig changed = base;
    const bool is_whole = key.key == "sim.steady_step_factor" ||
                          key.key == "policy.execute_steps" || key.key == "policy.picture_px";
    ApplySetting(key.key + "=" + (is_whole ? "3" : "0.123"), changed);
    const bool is_of_real_time = key.key == "policy.timeout_s";
    EXPECT_EQ(CalcIdOf(changed) == CalcIdOf(base), is_of_real_time) << key.key;
  }
}

}  // namespace
}  // namespace graspbench
