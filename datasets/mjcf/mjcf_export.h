#pragma once
/** @file
Exports trials as scenes for MuJoCo. The folder of a trial has

    scene.xml     hand, object, table and drives (FormatMjcf)
    motion.csv    the commanded motion (RecordMotion)

A simulation in MuJoCo starts from the key "start" of scene.xml and sets the actuators row by row
from motion.csv. tests/peer does so and compares the results. */

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/base/text/json.h"
#include "core/grasp/strategy.h"
#include "core/physics/world.h"
#include "core/trial/trial_setup.h"
#include "datasets/mjcf/convex_parts.h"

namespace graspbench {

class MjcfExporter {
 public:
  /** Simulates the trial and writes its folder, replacing files of these names.
  @throws Error(kIo). */
  void Export(const TrialSetup& setup, const std::filesystem::path& folder);

 private:
  std::map<std::string, std::vector<ConvexPart>> parts_;  // by the object's content hash
};

/** Commands to the hand in one step of a trial, as another engine needs them to repeat the trial.

The strategy responds to contacts (all digits have touched, the grip is steady), so the motion is
that of graspbench's own simulation. A trial that ends early here, because the object was lost, is
commanded to its end as if nothing touched; the other engine determines whether it loses the object
too. */
struct MotionStep {
  Phase phase = Phase::kPlacing;
  WorldCommand command;                    ///< for the end of the step
  Eigen::VectorXd q_arm = {}, u_arm = {};  ///< of the robot arm that carries the hand
};

struct CommandedMotion {
  WorldState start;
  double step = 0.0;              ///< [s]
  std::vector<MotionStep> steps;  ///< the first ends at `step`
};

/** Simulates the trial and records its commands. @throws Error(kRange) when its start is not
finite; Error(kUnsupported) for a controller that rotates the hand or scales the drives'
stiffness. */
CommandedMotion RecordMotion(const TrialSetup& setup);

/** Writes one row per step, the start first: time_s, phase, arm_x_m .. arm_z_m and arm_x_m_per_s ..
for the root's displacement from the start along the world's axes, and `<joint>_rad` of every drive.
With a robot arm, `arm/<joint>_rad` and `arm/<joint>_rad_per_s` of its joints replace the root's
columns. */
std::string FormatMotionCsv(const Hand& hand, const CommandedMotion& motion);
/** Returns the data dictionary of motion.csv. */
Json MakeMotionSchema(const Hand& hand);

/* The scene of a trial in MuJoCo's format (MJCF), for MuJoCo 3.

    bodies      "hand/<link>" as in hand.urdf, with explicit mass and inertia; "object" in frame O
    arm         slide joints arm/x, arm/y, arm/z along the world's axes, each with a position and a
                velocity actuator, limited together to the arm's force; arm/turn, a ball joint
                about H's origin with spring and damping. "carried" compensates the hand's weight.
                With a robot arm instead: bodies "arm" and "arm/<joint>" with the same two actuators
                per joint, limited together to its torque, and capsules that do not collide
    drives      a position actuator per drive with stiffness, damping and torque limit
    coupling    even and fixed: an equality of both joints. middle-first: the drive acts on the sum
                of both joints, a tendon keeps distal <= middle, and exactly one of the equalities
                lock/<joint> holds its joint in place. The stepping program selects it
                (core/hand/hand.h); initially the distal joints are locked
    hand        colliding capsules named "<digit or palm>/<link>/<n>"; in group 3, not colliding,
                the balls that graspbench uses for the same surface, for programs that need
                identical contact points
    object      convex parts (datasets/mjcf/convex_parts.h), since MuJoCo would use the hull of a
                whole mesh
    friction    elliptic cone with the static coefficient, pads with torsion; the dynamic
                coefficient, which MuJoCo cannot use, is in <custom>. Friction between links of the
                hand is the same as with the object
    key "start" the trial's start: hand, drives, object

Differences from graspbench: the inertia of the hand along the commanded motion loads the arm (some
0.1 mm), and the arm's moment has no limit (the stepping program must stop there). Hysteresis and
friction of drives and compliant couplings (core/physics/imperfect_drive.h) are left out. Contacts
and stops are MuJoCo's own springs, critically damped with a time constant of 5 ms, also for soft
pads, whose contact patch is that of 1 N. The compliance of joint stops is scaled to match.

Formats the file. @param start  the trial's start. @param parts  of the setup's object. */
std::string FormatMjcf(const TrialSetup& setup, const WorldState& start,
                       const std::vector<ConvexPart>& parts);

}  // namespace graspbench
