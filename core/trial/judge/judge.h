#pragma once
/** @file
The judge of grasps: the external load that a held object resists.

At the end of the hold, under unchanged gravity, the object is pulled at its centre of mass along
the six half axes of the palm's frame, and twisted about them. Each test starts from the same
instant, with a load that grows as

    L(t) = m g (exp(t / tau) - 1),   tau = 0.3 s,

slowly for weak grasps, yet reaching strong ones within seconds. The grasp is broken when the object
has moved by 20 mm or turned by 30 degrees in the palm's frame, or the hand has let go of it. The
breaking load is the largest load that the hand balanced until then, averaged over 20 ms:

    resisted = mean(L) - (P(t) - P(t - 20 ms)) / 20 ms,

where P is the object's momentum along the load. The inertia of the object, which delays its escape
while the load grows, is thus not attributed to the hand. Moments grow as L times the object's
radius. The range ends at 100 N (100 N times the radius); a grasp that resists this load is recorded
as unbroken. */

#include <string>
#include <vector>

#include "core/physics/world.h"
#include "core/quality/wrench_space.h"
#include "core/trial/grip/grip_regulator.h"
#include "core/trial/judge/judgement.h"
#include "core/trial/trial_setup.h"

namespace graspbench {

/** A held object after its trial. The hand keeps its last command, or continues to regulate its
grip, while loads are applied to the object or gravity is rotated. Copies start from the same
instant, so that one grasp can undergo many tests. */
class HeldObject {
 public:
  /** @param world  at the end of the hold; cloned.   @param command  the last one.
  @param sensors  if the hand uses sensed touch. */
  HeldObject(const World& world, const WorldCommand& command, const TrialSetup& setup,
             const GripRegulator& grip, const std::optional<TouchSensors>& sensors = {});

  /** Advances by one step of the physics. */
  void Step();

  World& world() { return *world_; }
  const World& world() const { return *world_; }
  const GraspObject& object() const { return *object_; }
  double step() const { return step_; }  ///< [s]
  double time() const { return time_; }  ///< since the start [s]
  double mass() const { return mass_; }
  double radius() const { return radius_; }  ///< largest distance of the surface from Ocm [m]
  /** Axes of the palm at the start, in W. */
  Eigen::Matrix3d R_WPalm() const { return R_WPalm_; }

  double CalcMoved() const;   ///< displacement of Ocm in the palm's frame since the start [m]
  double CalcTurned() const;  ///< rotation in the palm's frame since the start, 0..pi [rad]
  double CalcSpeed() const;   ///< of the centre of mass relative to the hand's root [m/s]
  /** Whether it was slower than 10 um/s for 0.1 s, including rotation, so that it stays in
  place. */
  bool IsAtRest() const { return time_ - last_motion_ > kRestTime; }
  /** Whether the hand has not touched it for 50 ms. */
  bool IsFree() const;
  bool converged() const { return converged_; }  ///< in all steps so far

 private:
  static constexpr double kRestTime = 0.1;  // [s]

  Pose CalcObjectInPalm() const;
  void Regulate();

  WorldCopy world_;
  WorldCommand command_;
  GripRegulator grip_;
  std::optional<TouchSensors> sensors_;
  std::vector<HandContact> contacts_;
  const Hand* hand_;
  const GraspObject* object_;
  double step_, mass_, radius_;
  double time_ = 0.0, last_touch_ = 0.0, last_motion_ = 0.0;
  bool converged_ = true;
  Eigen::Matrix3d R_WPalm_;
  Pose X_PalmStart_;  // of Ocm
};

/** @param direction_W  unit vector. */
BreakingLoad FindBreakingForce(const HeldObject& held, const Eigen::Vector3d& direction_W);

/** Smallest breaking force along the six half axes of the palm's frame [N]. It equals
breaking_force of JudgeGrasp for a third of its cost, since a pull ends as soon as the hand has
balanced more of it than of the weakest before. */
double FindWeakestForce(const HeldObject& held);

/** Runs all tests of a grasp: breaking loads, epsilons of every convention, verdicts.
@param contacts  current contacts, positions from the centre of mass, in the axes of O. */
Judgement JudgeGrasp(const HeldObject& held, const std::vector<GraspContact>& contacts);

/** A published success criterion. Each rule starts at the end of the hold and keeps its source's
loads, times and thresholds. Objects keep their own mass and friction, where some sources set
others.

Rules that rotate the hand, or that press on the object in free space, are implemented by rotating
gravity in the palm's frame. At the slow speeds of the sources this is equivalent for the object.
GRASPA's rotations are about the palm's x axis. NIST gives a force but no threshold. The threshold
and the direction, straight down, are graspbench's.

Sources: Roethling 2007; DexGraspBench (Chen, Ke, Wang 2025); GRASPA 1.0 (Bottarel et al., RA-L
2020); MultiGripperGrasp (Casas Murrilo et al. 2024); NIST SP 1227 draft (Falco et al. 2018). Loads
and thresholds follow the tools' own code where available. */
struct VerdictRule {
  const char* id;
  const char* name;   ///< for tables
  const char* score;  ///< meaning of the score, with its unit
  const char* rule;   ///< one sentence
  Verdict (*judge)(const HeldObject& held);
};

const std::vector<VerdictRule>& ListVerdictRules();

/** Judgement of a trial whose object was lost by the end of the hold: no load, every rule
failed. */
Judgement MakeEmptyHandJudgement();

}  // namespace graspbench
