#pragma once
/** @file
A profile: how somebody judges a grasp of the free hand, every value of it. One file each
(datasets/profiles, read by datasets/judged_grasps/profile_file.h), over these defaults.

A profile says which drives and surfaces the hand has, how the object is made, how the hand goes
through the stages of a grasp, what is done to the object then, and what it must stand. What a
profile does not say is as everywhere here: contact law, collision shapes, mass of the links. Not
modelled: armature of the drives, tendons that pull two joints at once. */

#include <string>

#include "core/base/enum_table.h"
#include "core/physics/sim_config.h"

namespace graspbench {

/** What a profile takes from the hand itself or states. */
enum class OwnOrGiven { kOwn, kGiven };
struct OwnOrGivenRow {
  OwnOrGiven value;
  const char* name;
};
inline constexpr OwnOrGivenRow kOwnOrGiven[] = {{OwnOrGiven::kOwn, "own"},
                                                {OwnOrGiven::kGiven, "given"}};

/** What holds where a stage asks a joint for more than its limits. */
enum class BeyondLimits { kRefuse, kClip, kIgnore };
struct BeyondLimitsRow {
  BeyondLimits value;
  const char* name;
};
inline constexpr BeyondLimitsRow kBeyondLimits[] = {{BeyondLimits::kRefuse, "refuse"},
                                                    {BeyondLimits::kClip, "clip"},
                                                    {BeyondLimits::kIgnore, "ignore"}};

/** Which of a grasp's stages the hand goes through. */
enum class StageChoice { kAll, kFirst, kGrasp };
struct StageChoiceRow {
  StageChoice value;
  const char* name;
};
inline constexpr StageChoiceRow kStageChoices[] = {
    {StageChoice::kAll, "all"}, {StageChoice::kFirst, "first"}, {StageChoice::kGrasp, "grasp"}};

/** What the joints are asked for after the last stage (closing_stage.h). */
enum class ClosingRule { kStated, kPress, kLimits };
struct ClosingRuleRow {
  ClosingRule value;
  const char* name;
};
inline constexpr ClosingRuleRow kClosingRules[] = {{ClosingRule::kStated, "stated"},
                                                   {ClosingRule::kPress, "press"},
                                                   {ClosingRule::kLimits, "limits"}};

/** What is done to the object once the hand has gone through its stages. */
enum class ProfileTest {
  kPushes,  ///< six, from the same instant each
  kFall,    ///< one, out of the palm along its normal
  kLift     ///< the hand rises, from a table
};
struct ProfileTestRow {
  ProfileTest value;
  const char* name;
};
inline constexpr ProfileTestRow kProfileTests[] = {
    {ProfileTest::kPushes, "pushes"}, {ProfileTest::kFall, "fall"}, {ProfileTest::kLift, "lift"}};

struct ProfileDrives {
  std::string law = "own";
  /** Of every joint that turns where the law is given; slides keep their own. */
  ///@{
  double stiffness = 5.0;     ///< [N m/rad]
  double damping = 0.05;      ///< [N m s/rad]
  double friction = 0.01;     ///< [N m]
  double torque_limit = 3.0;  ///< 0: the hand's own [N m]
  ///@}
  bool free_distal = false;  ///< joints that follow another have a drive of their own
  std::string beyond_limits = "clip";

  template <class V>
  void Visit(V&& v) {
    v("law", law);
    v("stiffness_nm_per_rad", stiffness);
    v("damping_nms_per_rad", damping);
    v("friction_nm", friction);
    v("torque_limit_nm", torque_limit);
    v("free_distal", free_distal);
    v("beyond_limits", beyond_limits);
  }
};

struct ProfileSurfaces {
  std::string pads = "own";  ///< soft pads and torsion: those of the hand, or bare links with this:
  double torsion_radius = 0.0;  ///< resists spin up to mu fn r [m]
  double friction = 0.5;        ///< of hand and object, of hand and hand, sliding too

  template <class V>
  void Visit(V&& v) {
    v("pads", pads);
    v("torsion_radius_m", torsion_radius);
    v("friction", friction);
  }
};

struct ProfileClosing {
  std::string stages = "all";  ///< grasp: that of this name, else the last
  std::string to = "stated";
  double press = 1.0;          ///< of joints, by the distance a point would move [rad/m]
  double press_reach = 0.001;  ///< of points that press: their distance from the object [m]
  /** Until two of digits and palm touch it, the object is put back where it was after each step. */
  bool object_is_held = false;

  template <class V>
  void Visit(V&& v) {
    v("stages", stages);
    v("to", to);
    v("press_rad_per_m", press);
    v("press_reach_m", press_reach);
    v("object_is_held", object_is_held);
  }
};

/** Nothing falls by itself: a push or a lift says what acts on the object. */
inline SimConfig MakeFreeSpaceSim() {
  SimConfig sim;
  sim.gravity = 0.0;
  return sim;
}

struct FreeSpaceProfile {
  std::string name;  ///< of its file; no key
  std::string about, source;
  ProfileDrives drives;
  ProfileSurfaces surfaces;
  ProfileClosing closing;
  double mass = 0.1;        ///< of the object [kg]; 0: by its density
  double density = 500.0;   ///< [kg/m^3]
  double stage_time = 0.4;  ///< from one stage to the next [s]
  int stage_updates = 0;    ///< the commands of a stage change so often; 0: in every step
  std::string test = "pushes";
  double acceleration = kStandardGravity;  ///< times the mass: the push, or the weight in a lift
  double test_time = 2.0;                  ///< of a push, or of the lift [s]
  double check_interval = 0.2;             ///< between looks at how far it has moved [s]
  double lift_height = 0.1;                ///< [m]
  double max_start_penetration = 0.01;     ///< of hand and object at the first stage [m]
  double max_shift = 0.05;                 ///< of the object [m]
  double max_turn_deg = 15.0;
  bool must_touch = false;           ///< in the last look the hand touches the object
  bool finds_breaking_load = false;  ///< of pushes (free_space.h)
  SimConfig sim = MakeFreeSpaceSim();

  template <class V>
  void Visit(V&& v) {
    v("about", about);
    v("source", source);
    v("drives", drives);
    v("surfaces", surfaces);
    v("closing", closing);
    v("object_mass_kg", mass);
    v("object_density_kg_per_m3", density);
    v("stage_time_s", stage_time);
    v("stage_updates", stage_updates);
    v("test", test);
    v("acceleration_m_per_s2", acceleration);
    v("test_time_s", test_time);
    v("check_interval_s", check_interval);
    v("lift_height_m", lift_height);
    v("max_start_penetration_m", max_start_penetration);
    v("max_shift_m", max_shift);
    v("max_turn_deg", max_turn_deg);
    v("must_touch", must_touch);
    v("finds_breaking_load", finds_breaking_load);
    v("sim", sim);
  }
};

}  // namespace graspbench
