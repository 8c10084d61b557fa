#include "datasets/plan/trial_id.h"

#include "core/arm/mounted_arm.h"
#include "core/base/config.h"
#include "core/base/hash.h"
#include "core/hand/tactile.h"
#include "core/physics/sim_config.h"
#include "core/trial/trial_setup.h"
#include "datasets/plan/grasp_choice.h"
#include "datasets/plan/grip_check.h"

namespace graspbench {
namespace {

/** The keys that ids hash, frozen: a key that the configuration no longer has stays here with the
default that it had, and one that is new does not come here. */
constexpr char kHashedKeys[] = R"({
  "variation": {
    "offset_m": 0.005, "yaw_rad": 0.08726646259971647},
  "strategy": {
    "placing_time_s": 0.8, "closure_time_s": 1.0, "closure_patience_s": 0.3,
    "stabilisation_min_time_s": 0.5, "stabilisation_max_time_s": 2.0, "lift_time_s": 1.0,
    "hold_time_s": 2.0, "closure_lead_s": 0.0, "grip": "margin", "grip_force_n": 0.7,
    "grip_margin": 2.0, "touch_speed": 0.25, "drive_law": "hold"},
  "sim": {
    "step_s": 0.002, "steady_step_factor": 5, "gravity_m_per_s2": 9.80665,
    "contact_stiffness_n_per_m": 100000.0, "tangential_stiffness_n_per_m": 100000.0,
    "table_friction_static": 0.4, "table_friction_dynamic": 0.35,
    "table_rolling_resistance_m": 0.0001, "hand_friction_static": 0.5,
    "hand_friction_dynamic": 0.4, "arm_stiffness_n_per_m": 20000.0,
    "arm_angular_stiffness_nm_per_rad": 2000.0, "arm_damping_time_s": 0.02,
    "arm_force_limit_n": 98.0, "arm_moment_limit_nm": 20.0, "multibody": "arrays"},
  "model": {
    "mass_scale": 1.0, "friction_scale": 1.0, "pad_torsion_scale": 1.0,
    "pad_stiffness_scale": 1.0, "drive_torque_scale": 1.0, "joint_error_scale": 1.0,
    "coupling_rule": "own"},
  "camera": {
    "look_height_m": 0.4, "noise_grey_levels": 3.0, "blur_px": 0.7, "exposure": 1.0,
    "shadows": false, "table_colour": "#b4509b"},
  "sensors": {
    "patch_radius_m": 0.004, "force_scale_n": 2.0, "saturation_n": 10.0, "hysteresis": 0.05,
    "noise": 0.001, "threshold": 0.006, "rate_hz": 500.0},
  "imperfections": {
    "hysteresis_rad": 0.0, "stick_slip": 0.0, "stiffness_scale": 1.0,
    "coupling_compliance_rad_per_nm": 0.0},
  "policy": {
    "command": "", "period_s": 0.02, "execute_steps": 1, "time_s": 5.0, "object_pose": "believed",
    "latency_s": 0.0, "latency_jitter_s": 0.0, "dropout": 0.0, "joint_noise_rad": 0.0,
    "force_noise_n": 0.0}
})";

/** @param values  of a part of the configuration: what is left out of it is not hashed.
@return its frozen keys, of those that were removed the default, and of later ones those that differ
from their default: neither a removed nor a new key changes the id of any other trial. */
Json TakeHashed(const char* part, const Json& values, const Json& defaults) {
  static const Json frozen = Json::parse(kHashedKeys);
  Json hashed = Json::object();
  for (const auto& [key, fallback] : frozen.at(part).items()) {
    if (values.contains(key)) {
      hashed[key] = values.at(key);
    } else if (!defaults.at(part).contains(key)) {
      hashed[key] = fallback;
    }
  }
  for (const auto& [key, value] : values.items()) {
    if (!frozen.at(part).contains(key) && value != defaults.at(part).at(key)) hashed[key] = value;
  }
  return hashed;
}

Json ToJson(const HandCamera& camera) {
  return {{"link", camera.link},     {"X_LK", JsonPose(camera.X_LK)},       {"width", camera.width},
          {"height", camera.height}, {"focal_length", camera.focal_length}, {"k1", camera.k1},
          {"k2", camera.k2}};
}

}  // namespace

std::string CalcTrialId(const SessionConfig& config, const Hand& hand, const GraspObject& object,
                        const Json& grasp, int trial, const MountedArm* arm) {
  static const Json defaults = ConfigToJson(SessionConfig());
  Json content = {
      {"physics", kPhysicsVersion},
      {"hand", {hand.id, hand.content_hash}},
      {"object", {object.id, object.content_hash}},
      {"grasp", grasp},
      {"variation", TakeHashed("variation", ConfigToJson(config.variation), defaults)},
      {"strategy", TakeHashed("strategy", StrategyToJson(FindUsedStrategy(config)), defaults)},
      {"sim", TakeHashed("sim", ConfigToJson(config.sim), defaults)},
      {"model", TakeHashed("model", ConfigToJson(config.model), defaults)},
      {"seed", config.seed},
      {"trial", trial}};
  // Only what differs from the default, so that the ids of all other trials stay as they were.
  if (config.positioning != SessionConfig().positioning) {
    content["positioning"] = config.positioning;
  }
  if (config.positioning == RowOf(kPositionings, Positioning::kCamera).name || grasp.is_array() ||
      ShowsCamera(config.policy)) {
    content["camera"] = TakeHashed("camera", ConfigToJson(config.camera), defaults);
    content["mount"] = ToJson(*hand.camera);
  }
  if (arm) content["arm"] = DescribeArm(*arm);
  if (config.touch != SessionConfig().touch) {
    content["touch"] = config.touch;
    content["sensors"] = TakeHashed("sensors", ConfigToJson(config.sensors), defaults);
    content["skin"] = hand.skin->content_hash;
  }
  if (!config.policy.command.empty()) {
    Json policy = ConfigToJson(config.policy);
    policy.erase("timeout_s");  // of real time: it changes no result
    content["policy"] = TakeHashed("policy", policy, defaults);
  }
  if (config.draws != SessionConfig().draws) content["draws"] = config.draws;
  if (!(config.imperfections == SessionConfig().imperfections)) {
    content["imperfections"] =
        TakeHashed("imperfections", ConfigToJson(config.imperfections), defaults);
  }
  return CalcHashHex(FormatJson(content));
}

}  // namespace graspbench
