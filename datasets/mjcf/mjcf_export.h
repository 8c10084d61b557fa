#pragma once
/** @file
Trials as scenes for MuJoCo: a folder a trial with

    scene.xml     hand, object, table and drives (FormatMjcf)
    motion.csv    the commanded motion (RecordMotion)

Whoever opens scene.xml in MuJoCo starts from its key "start" and gives the actuators row after
row of motion.csv; tests/peer does so and compares. */

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
  /** Carries out the trial and writes its folder; files of these names are replaced.
  @throws Error(kIo). */
  void Export(const TrialSetup& setup, const std::filesystem::path& folder);

 private:
  std::map<std::string, std::vector<ConvexPart>> parts_;  // by the object's content hash
};

/** What the hand is asked for in the course of a trial, step by step: what another engine needs to
carry out the same trial.

The strategy listens to the fingers (when all have touched, when the grip is steady), so the motion
is that of our own run. A trial that is over early here, because the object was lost, is commanded
to its end as if nothing touched: whether it is lost elsewhere too is for the other engine to
find. */
struct MotionStep {
  Phase phase = Phase::kPlacing;
  WorldCommand command;                    ///< for the step's end
  Eigen::VectorXd q_arm = {}, u_arm = {};  ///< of a robot arm that carries the hand
};

struct CommandedMotion {
  WorldState start;
  double step = 0.0;              ///< [s]
  std::vector<MotionStep> steps;  ///< the first ends at `step`
};

/** Carries out the trial. @throws Error(kRange) when its start is not finite, Error(kUnsupported)
for a controller that turns the hand or scales its drives' stiffness. */
CommandedMotion RecordMotion(const TrialSetup& setup);

/** One row a step, the start first: time_s, phase, arm_x_m .. arm_z_m and arm_x_m_per_s .. of the
root's displacement from the start along the world's axes, `<joint>_rad` of every drive. With a robot
arm `arm/<joint>_rad` and `_rad_per_s` of its joints in place of the root's. */
std::string FormatMotionCsv(const Hand& hand, const CommandedMotion& motion);
/** Its data dictionary. */
Json MakeMotionSchema(const Hand& hand);

/* The scene of a trial in MuJoCo's format (MJCF), for MuJoCo 3.

    bodies      "hand/<link>" as in hand.urdf, masses and inertias given; "object" in frame O
    arm         slide joints arm/x, arm/y, arm/z along the world's axes with a position and a
                velocity actuator each, together at most the arm's force; arm/turn, a ball joint
                about H's origin with spring and damping. "carried" takes the hand's weight off them.
                A robot arm instead: bodies "arm" and "arm/<joint>" with the same two actuators for
                each joint, together at most its torque, and capsules that do not collide
    drives      a position actuator per drive with stiffness, damping and torque limit
    coupling    even and fixed: an equality of both joints. middle-first: the drive pulls on the sum
                of both joints, a tendon keeps distal <= middle, and of the equalities lock/<joint>
                exactly one holds its joint where it is; who steps the file says which
                (core/hand/hand.h), the file starts with the distal joints locked
    hand        capsules that collide, named "<digit or palm>/<link>/<n>"; in group 3, not
                colliding, the balls that graspbench puts on the same surface, for whoever wants the
                very same points of contact
    object      convex parts (datasets/mjcf/convex_parts.h); MuJoCo would take the hull of a whole
                mesh
    friction    elliptic cone of the static coefficient, pads with torsion; the dynamic one is told
                in <custom>, MuJoCo has no use for it. Links of the hand rub on each other as on
                the object
    key "start" where the trial begins: hand, drives, object

Not the same as in graspbench: the inertia of the hand along the commanded motion loads the arm
(some 0.1 mm), its moment has no limit (whoever steps the file ends there); hysteresis and friction
of
drives and yielding couplings (core/physics/imperfect_drive.h) are left out; contacts and stops are
MuJoCo's own springs, critically damped with a time constant of 5 ms, of soft pads too, whose patch
is that of 1 N; what a joint's stop gives way
is scaled to be alike.

The file's text. @param start  where the trial begins.   @param parts  of the setup's object. */
std::string FormatMjcf(const TrialSetup& setup, const WorldState& start,
                       const std::vector<ConvexPart>& parts);

}  // namespace graspbench
