#pragma once
/** @file
Stability sigma: how firmly an object is held; larger is better. It is the fitness of optimisation.

    sigma = mean over the hold of  min over d of s(d)      [N]

where d are the six half axes of the palm's frame. The value s(d) is the largest pull along d, in
addition to the object's weight, that the contacts resist with their normal forces at that instant
(holding_force.h). Sigma is thus a force: the pull that would take the object out of the hand,
predicted from the contact forces before the pull. It is 0 if the object is lost.

The originally proposed formula is kept as `sigma_proposed`,

    mean of  min(10, Q F / (m g)) exp(-v / (10 mm/s)) o

    Q   epsilon of the contacts in the convention "ferrari-canny" (grasp_quality.h): eight
        edges, unit normal force, moments about the centre of mass divided by the object's radius;
        each cone with the friction of its contact's state, soft pads with torsion
    F   sum of the hand's normal forces on the object [N];  m g the object's weight [N]
    v   speed of the object relative to the hand, |v_WOcm - v_WH| + radius |w_WO| [m/s]
    o   1 if the opposing digit and another digit or the palm touch the object, else 0

It was replaced because it predicts the measured breaking force less well: see the README of this
folder. Both are proposals of graspbench (the thesis names a stability without a formula). */

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

/** Means over the samples of one phase of a trial; NaN without samples. */
struct StabilityPart {
  double sigma = kUnset;  ///< [N]
  double sigma_proposed = kUnset;
  double quality = kUnset;       ///< Q
  double normal_force = kUnset;  ///< F [N]
  double slip_speed = kUnset;    ///< v [m/s]
  double opposition = kUnset;    ///< mean of o
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
  /** Sigma of `hold` if the object is in the hand at the end of the trial, else 0 [N]. */
  double sigma = kUnset;
  double sigma_proposed = kUnset;  ///< that of `stabilisation`, under the same condition
  StabilityPart stabilisation;     ///< last 0.5 s of the phase
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

/** Cost: about 0.3 ms per sample of ten contacts. */
StabilityPart CalcStabilityPart(const std::vector<GraspInstant>& samples);

/** Largest distance of the object's surface from its centre of mass [m]. */
double CalcObjectRadius(const GraspObject& object);

/** Upper bound of the speed of the object's points relative to the hand,
|v_WOcm - v_WH| + radius |w_WO| [m/s]. It includes spinning on the spot. */
double CalcSlipSpeed(const WorldState& state, double object_radius);

/** Converts a contact of the physics to core/quality: position from the object's centre of mass, in
the axes of O. @param mu  friction of its state, or the dynamic friction. */
GraspContact MakeGraspContact(const HandContact& contact, const WorldState& state, double mu);

/** Q of contacts given from the centre of mass; 0 for fewer than two. @param radius  of the object
[m] */
double CalcContactQuality(const std::vector<GraspContact>& contacts, double radius);

/** Samples a trial's grasp: every 25 ms in stabilisation, every 0.1 s in lift-off and every 0.2 s
in the hold. This takes about a tenth of a trial's time. */
class StabilityMeter {
 public:
  explicit StabilityMeter(const TrialSetup& setup);

  /** Call after each step. @param num_steps  length of the step in steps of the settings */
  void Observe(const World& world, Phase phase, double time_in_phase, int num_steps);

  /** Samples the current grasp. */
  GraspInstant MakeInstant(const World& world) const;

  /** Returns the phases; values for the whole trial stay unset. */
  Stability Calc() const;

 private:
  const Hand* hand_;
  int opposing_digit_;
  double step_, object_radius_;
  std::vector<GraspInstant> stabilisation_, lift_, hold_;
};

}  // namespace graspbench
