#pragma once
/** @file
A profile: how somebody judges a grasp of the free hand, every value of it. One file each
(datasets/profiles, read by datasets/judged_grasps/profile_file.h), over these defaults.

A profile says which drives and surfaces the hand has, how the object is made, how the hand goes
through the stages of a grasp, what is done to the object then, and what it must stand. What a
profile does not say is as everywhere here: contact law, collision shapes, mass of the links. Not
modelled: tendons that pull two joints at once. */

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/enum_table.h"
#include "core/base/file_keys.h"
#include "core/base/pose.h"
#include "core/hand/closing_table.h"
#include "core/hand/hand.h"
#include "core/physics/contact.h"
#include "core/physics/sim_config.h"
#include "core/shape/grasp_object.h"

namespace graspbench {

/** What a profile takes from the hand itself or states. */
enum class OwnOrGiven { kOwn, kGiven };
inline constexpr NamedValue<OwnOrGiven> kOwnOrGiven[] = {{OwnOrGiven::kOwn, "own"},
                                                         {OwnOrGiven::kGiven, "given"}};

/** What holds where a stage asks a joint for more than its limits. */
enum class BeyondLimits { kRefuse, kClip, kIgnore };
inline constexpr NamedValue<BeyondLimits> kBeyondLimits[] = {{BeyondLimits::kRefuse, "refuse"},
                                                             {BeyondLimits::kClip, "clip"},
                                                             {BeyondLimits::kIgnore, "ignore"}};

/** Which of a grasp's stages the hand goes through. */
enum class StageChoice { kAll, kFirst, kGrasp };
inline constexpr NamedValue<StageChoice> kStageChoices[] = {
    {StageChoice::kAll, "all"}, {StageChoice::kFirst, "first"}, {StageChoice::kGrasp, "grasp"}};

/** What the joints are asked for after the last stage (CalcClosingCommand). */
enum class ClosingRule { kStated, kPress, kLimits };
inline constexpr NamedValue<ClosingRule> kClosingRules[] = {{ClosingRule::kStated, "stated"},
                                                            {ClosingRule::kPress, "press"},
                                                            {ClosingRule::kLimits, "limits"}};

/** What is done to the object once the hand has gone through its stages. */
enum class ProfileTest {
  kPushes,  ///< six, from the same instant each
  kFall,    ///< one, out of the palm along its normal
  kLift     ///< the hand rises, from a table
};
inline constexpr NamedValue<ProfileTest> kProfileTests[] = {
    {ProfileTest::kPushes, "pushes"}, {ProfileTest::kFall, "fall"}, {ProfileTest::kLift, "lift"}};

struct ProfileDrives {
  std::string law = "own";
  /** Of every joint that turns where the law is given; slides keep their own. */
  ///@{
  double stiffness = 5.0;     ///< [N m/rad]
  double damping = 0.05;      ///< [N m s/rad]
  double friction = 0.01;     ///< [N m]
  double armature = 0.0;      ///< [kg m^2]
  double torque_limit = 3.0;  ///< 0: the hand's own [N m]
  ///@}
  bool free_distal = false;  ///< joints that follow another have a drive of their own
  std::string beyond_limits = "clip";

  template <class V>
  void Visit(V&& v) {
    v("law", law, "own: the hand's drives; given: these four, of every joint that turns");
    v("stiffness_nm_per_rad", stiffness, {"of a given drive", 0, 1e4});
    v("damping_nms_per_rad", damping, {"of a given drive, with that of its joint", 0, 1e3});
    v("friction_nm", friction, {"of a given drive, sticking and sliding", 0, 10});
    v("armature_kg_m2", armature, {"of a given drive: its rotor, as the joint feels it", 0, 1});
    v("torque_limit_nm", torque_limit, {"of a given drive; 0: the hand's own", 0, 1e3});
    v("free_distal", free_distal,
      "joints that a finger's middle joint moves along have a drive of their own");
    v("beyond_limits", beyond_limits,
      "a stage asks for more than a joint's limits: refuse the grasp, clip the command, or ignore "
      "it (the stop pushes back)");
  }
};

struct ProfileSurfaces {
  std::string pads = "own";  ///< soft pads and torsion: those of the hand, or bare links with this:
  double torsion_radius = 0.0;                      ///< resists spin up to mu fn r [m]
  double relaxation_time = kContactRelaxationTime;  ///< of bare links [s]
  double friction = 0.5;  ///< of hand and object, of hand and hand, sliding too

  template <class V>
  void Visit(V&& v) {
    v("pads", pads, "own: the hand's soft pads; given: bare links with this torsion");
    v("torsion_radius_m", torsion_radius,
      {"resists spin up to friction times normal force times this; of given pads", 0, 0.1});
    v("relaxation_time_s", relaxation_time,
      {"damping of a contact over its stiffness; of given pads", 0.001, 1});
    v("friction", friction, {"of hand and object, and of the hand with itself", 0, 5});
  }
};

struct ProfileClosing {
  std::string stages = "all";  ///< grasp: that of this name, else the last
  std::string to = "stated";
  double press = 1.0;          ///< of joints, by the distance a point would move [rad/m]
  double press_reach = 0.001;  ///< of points that press: their distance from the object [m]
  /** Until two of digits and palm (or as its table says) touch it, the object is put back where it
  was after each step. */
  bool object_is_held = false;

  template <class V>
  void Visit(V&& v) {
    v("stages", stages,
      "those of the grasp that the hand goes through: all; first, to close from the open hand; "
      "grasp, to begin at it");
    v("to", to,
      "what the joints are asked for after the last stage: stated, as it says; press, beyond it "
      "where a link touches; limits, closed as far as they go");
    v("press_rad_per_m", press,
      {"of press: so much of each joint by how far it moves a touching point into the object", 0,
       100});
    v("press_reach_m", press_reach,
      {"of press: the points that touch are nearer to the surface than this", 0, 0.05});
    v("object_is_held", object_is_held,
      "until two of digits and palm touch it, or as many links as MultiGripperGrasp's table of the "
      "gripper says, the object is put back after each step; where that never comes, the grasp "
      "fails");
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
    v("about", about, "one line for lists");
    v("source", source, "where the values come from");
    v("drives", drives);
    v("surfaces", surfaces);
    v("closing", closing);
    v("object_mass_kg", mass, {"0: by the density", 0, 100});
    v("object_density_kg_per_m3", density,
      {"of the mesh's volume, where the mass is 0", kAboveZero, 3e4});
    v("stage_time_s", stage_time, {"from one stage of the grasp to the next", 0.001, 60});
    v("stage_updates", stage_updates,
      {"the commands change so often in a stage; 0: in every step", 0, 10000});
    v("test", test,
      "pushes: six, along the axes of the file's world; fall: one, out of the palm along its "
      "normal, or along the axis of MultiGripperGrasp's table of the gripper; lift: from a table "
      "at the world's z = 0");
    v("acceleration_m_per_s2", acceleration,
      {"times the object's mass: the push, or the weight of a lift from the start", 0, 1000});
    v("test_time_s", test_time, {"of each push, or of the lift", 0.01, 60});
    v("check_interval_s", check_interval,
      {"between looks at how far the object has moved", 0.001, 60});
    v("lift_height_m", lift_height, {"of a lift", 0, 1});
    v("max_start_penetration_m", max_start_penetration,
      {"of hand and object at the first stage", 0, 0.1});
    v("max_shift_m", max_shift, {"of the object from where it began", kAboveZero, 10});
    v("max_turn_deg", max_turn_deg, {"of the object from how it began", kAboveZero, 360});
    v("must_touch", must_touch, "in the last look the hand touches the object");
    v("finds_breaking_load", finds_breaking_load,
      "of pushes: also the largest that the grasp stands along all six axes, to 5 %");
    v("sim", sim);
  }
};

/** What the hand is asked for at one stage of a grasp. */
struct ScriptedStage {
  std::string name;  ///< "pregrasp", "grasp", "squeeze"
  Pose X_OH = Pose::Identity();
  Eigen::VectorXd q;  ///< (num_joints), followers too [rad], [m]
};

/** Hand and object as a profile has them, and the stages of a grasp that the hand goes through. */
struct ProfiledScene {
  std::shared_ptr<const Hand> hand;
  std::shared_ptr<const GraspObject> object;
  Pose X_WO = Pose::Identity();
  std::vector<ScriptedStage> stages;
  /** In place of the hand's closing joints, of its palm's normal in a fall, and of the two parts
  that must touch a held object. */
  std::optional<ClosingTable> table;
  int num_beyond_limits = 0;  ///< joints that a stage asks for more than their limits
  std::string refusal;        ///< why the profile takes no such grasp; empty: it does
};

/** The hand with the profile's drives and surfaces. @param is_asked  by joint: the stages say where
it is; what they do not name is held as stiffly as the arm holds the hand. */
std::shared_ptr<const Hand> MakeProfiledHand(const Hand& hand, const FreeSpaceProfile& profile,
                                             const std::vector<bool>& is_asked);

/** The object with the profile's mass and friction; its inertia is scaled with the mass. */
std::shared_ptr<const GraspObject> MakeProfiledObject(const GraspObject& object,
                                                      const FreeSpaceProfile& profile);

/** @param hand, object  of MakeProfiledHand and MakeProfiledObject. @pre a stage at least. */
ProfiledScene MakeProfiledScene(std::shared_ptr<const Hand> hand,
                                std::shared_ptr<const GraspObject> object, const Pose& X_WO,
                                std::vector<ScriptedStage> stages, const FreeSpaceProfile& profile);

/** How a hand closes beyond the posture that a file states, as the sources of grasps of one stage
do: their posture touches the object, and what presses is a command beyond it.

What the joints are asked for after the last stage, by the profile's rule:

  stated  what that stage states
  press   q + c sum J^T (-n), over the links whose point nearest to the object lies less than the
          reach from its surface: J its Jacobian (3, joints), n the outward normal there. The step
          along the gradient of DexGraspNet (Wang et al. 2023, scripts/validate_grasps.py):
          c = 2 x 0.001 m x 500 rad/m^2 = 1 rad/m
  limits  every joint that bends a digit at the end at which it is closed (core/hand/closing.h),
          others as stated (Casas et al. 2024); by the scene's table where it has one

@returns (num_joints) [rad], [m]. */
Eigen::VectorXd CalcClosingCommand(const ProfiledScene& scene, const FreeSpaceProfile& profile);

}  // namespace graspbench
