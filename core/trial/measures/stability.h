#pragma once
/** @file
Stability sigma: how firmly an object is held, larger is better; the fitness of the optimisation.

    sigma = mean over the hold of  min over d of s(d)      [N]

with d the six half axes of the palm's frame and s(d) the largest pull along d that the contacts,
with the forces they exert at that instant, stand on top of the object's weight (holding_force.h).
So sigma is a force: the pull that would take the object out of the hand, by its contacts' forces
beforehand. 0 when the object is lost.

The formula that was proposed first is kept beside it as `sigma_proposed`,

    mean of  min(10, Q F / (m g)) exp(-v / (10 mm/s)) o

    Q   epsilon of the contacts in the convention "ferrari-canny" (grasp_quality.h): eight
        edges, unit normal force, moments about the centre of mass divided by the object's radius;
        each cone with the friction of its contact's state, soft pads with torsion
    F   sum of the normal forces of the hand on the object [N];  m g the object's weight [N]
    v   speed of the object against the hand, |v_WOcm - v_WH| + radius |w_WO| [m/s]
    o   1 if the opposing digit and another digit or the palm touch the object, else 0

because it ranks grasps worse by the force that really breaks them: see the README of this folder.
Both are proposals of graspbench (the thesis names a stability without a formula). */

#include <vector>

#include "core/base/text/json.h"
#include "core/base/text/record_fields.h"
#include "core/base/units.h"
#include "core/grasp/strategy.h"
#include "core/physics/world.h"
#include "core/quality/holding_force.h"
#include "core/trial/trial_setup.h"

namespace graspbench {

/** A grasp at one instant. */
struct GraspInstant {
  LoadedGrasp grasp;  ///< in the axes of O
  Eigen::Matrix3d R_OPalm = Eigen::Matrix3d::Identity();
  double slip_speed = 0.0;  ///< v [m/s]
  bool is_opposed = false;  ///< o
};

/** Means over the samples of a part of a trial; NaN where there are none. */
struct StabilityPart {
  double sigma = kUnset;  ///< [N]
  double sigma_proposed = kUnset;
  double quality = kUnset;       ///< Q
  double normal_force = kUnset;  ///< F [N]
  double slip_speed = kUnset;    ///< v [m/s]
  double opposition = kUnset;    ///< o, a share
  int num_samples = 0;

  template <class V>
  static void ListFields(V&& field) {
    field("sigma_n", &StabilityPart::sigma);
    field("sigma_proposed", &StabilityPart::sigma_proposed);
    field("quality", &StabilityPart::quality);
    field("normal_force_n", &StabilityPart::normal_force);
    field("slip_speed_m_per_s", &StabilityPart::slip_speed);
    field("opposition", &StabilityPart::opposition);
    field("num_samples", &StabilityPart::num_samples);
  }
};

struct Stability {
  /** That of `hold` if the object is in the hand at the end of the trial, else 0 [N]. */
  double sigma = kUnset;
  double sigma_proposed = kUnset;  ///< that of `stabilisation`, under the same condition
  StabilityPart stabilisation;     ///< its last 0.5 s
  StabilityPart lift;
  StabilityPart hold;

  template <class V>
  static void ListFields(V&& field) {
    field("sigma_n", &Stability::sigma);
    field("sigma_proposed", &Stability::sigma_proposed);
    field("stabilisation", &Stability::stabilisation);
    field("lift", &Stability::lift);
    field("hold", &Stability::hold);
  }
};

/** Cost: some 0.3 ms for a sample of ten contacts. */
StabilityPart CalcStabilityPart(const std::vector<GraspInstant>& samples);

/** Largest distance of the object's surface from its centre of mass [m]. */
double CalcObjectRadius(const GraspObject& object);

/** Speed of the object against the hand, |v_WOcm - v_WH| + radius |w_WO| [m/s]: no point of it is
faster. A ball that spins on the spot moves, too. */
double CalcSlipSpeed(const WorldState& state, double object_radius);

/** A contact of the physics as core/quality takes it: from the object's centre of mass, in the axes
of O. @param mu  of its state, or the dynamic one. */
GraspContact MakeGraspContact(const HandContact& contact, const WorldState& state, double mu);

/** Q of contacts from the centre of mass; 0 of fewer than two. @param radius  of the object [m] */
double CalcContactQuality(const std::vector<GraspContact>& contacts, double radius);

/** Samples a trial's grasp: every 25 ms in stabilisation, every 0.1 s in lift-off and every 0.2 s in
the hold, which costs a trial about a tenth of its time. */
class StabilityMeter {
 public:
  explicit StabilityMeter(const TrialSetup& setup);

  /** To be called after each step. @param num_steps  of the settings' length that it took */
  void Observe(const World& world, Phase phase, double time_in_phase, int num_steps);

  /** The grasp now. */
  GraspInstant MakeInstant(const World& world) const;

  /** The parts; what holds for the whole trial stays unset. */
  Stability Calc() const;

 private:
  const Hand* hand_;
  int opposing_digit_;
  double step_, object_radius_;
  std::vector<GraspInstant> stabilisation_, lift_, hold_;
};

}  // namespace graspbench
