#pragma once
/** @file
The judge of grasps: the external load that a held object resists.

From the end of the hold, with gravity as it is, the object is pulled at its centre of mass along
the six half axes of the palm's frame, and twisted about them, each time again, with a load that
grows as

    L(t) = m g (exp(t / tau) - 1),   tau = 0.3 s,

slowly for weak grasps and within seconds for strong ones. The grasp is broken when the object has
moved by 20 mm or turned by 30 degrees in the palm's frame, or the hand has let go of it. The
breaking load is the largest part of the load that the hand balanced until then, over 20 ms:

    resisted = mean(L) - (P(t) - P(t - 20 ms)) / 20 ms,

P the object's momentum along the load. So the inertia of the object, which delays its flight while
the load grows on, does not count for the hand. Moments are grown as L times the object's radius.
The range ends at 100 N (100 N times the radius): a grasp that stands that is recorded unbroken. */

#include <string>
#include <vector>

#include "core/physics/world.h"
#include "core/quality/wrench_space.h"
#include "core/trial/grip/grip_regulator.h"
#include "core/trial/judge/judgement.h"
#include "core/trial/trial_setup.h"

namespace graspbench {

/** A held object after its trial: the hand goes on with its last command, or regulates its grip on,
while loads are put on the object or gravity is turned. Copies start from the same instant, so one
grasp stands many tests. */
class HeldObject {
 public:
  /** @param world  at the end of the hold; cloned   @param command  the last one.
  @param sensors  of a hand that goes by them. */
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

  double CalcMoved() const;   ///< of the centre of mass in the palm's frame since the start [m]
  double CalcTurned() const;  ///< in the palm's frame since the start, 0..pi [rad]
  double CalcSpeed() const;   ///< of the centre of mass against the hand's root [m/s]
  /** Slower than 10 um/s for 0.1 s, turning included: it stays where it is. */
  bool IsAtRest() const { return time_ - last_motion_ > kRestTime; }
  /** The hand has not touched it for 50 ms. */
  bool IsFree() const;
  bool converged() const { return converged_; }  ///< all steps up to now

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

/** The smallest of the breaking forces along the six half axes of the palm's frame [N]: the
breaking_force of JudgeGrasp for a third of its cost, since a pull ends as soon as the hand has
balanced more of it than of the weakest before. */
double FindWeakestForce(const HeldObject& held);

/** All tests of a grasp: breaking loads, epsilons of every convention, verdicts.
@param contacts  those of the moment, positions from the centre of mass, axes of O. */
Judgement JudgeGrasp(const HeldObject& held, const std::vector<GraspContact>& contacts);

/** A published rule of success. Each rule starts from the same instant, the end of the
hold, and keeps its source's loads, times and thresholds; objects keep their own mass and friction,
where some sources set others.

A rule that turns the hand, or that presses on the object in free space, is carried out by turning
gravity in the palm's frame: at the sources' slow speeds the object feels the same. GRASPA's turns
are taken about the palm's x axis. NIST gives a force, no threshold: that one is graspbench's, and
so is the direction, straight down.

Sources: Roethling 2007; DexGraspBench (Chen, Ke, Wang 2025); GRASPA 1.0 (Bottarel et al., RA-L
2020); MultiGripperGrasp (Casas Murrilo et al. 2024); NIST SP 1227 draft (Falco et al. 2018); loads
and thresholds as read in the tools' own code where there is code. */
struct VerdictRule {
  const char* id;
  const char* name;   ///< for tables
  const char* score;  ///< what the score is, with its unit
  const char* rule;   ///< one sentence
  Verdict (*judge)(const HeldObject& held);
};

const std::vector<VerdictRule>& ListVerdictRules();

/** Of a trial whose object was lost by the end of the hold: no load, every rule failed. */
Judgement MakeEmptyHandJudgement();

}  // namespace graspbench
