#pragma once
/** @file
Stability sigma: how firmly an object is held, larger is better; the fitness of the optimisation.

    sigma = mean over samples of  min(10, Q F / (m g)) exp(-v / (10 mm/s)) o

    Q   epsilon of the contacts in the convention "ferrari-canny" (quality_convention.h): eight
        edges, unit normal force, moments about the centre of mass divided by the object's radius;
        each cone with the friction of its contact's state, soft pads with torsion
    F   sum of the normal forces of the hand on the object [N];  m g the object's weight [N]
    v   speed of the object against the hand, |v_WOcm - v_WH| + radius |w_WO| [m/s]
    o   1 if the opposing digit and another digit or the palm touch the object, else 0

Proposed by graspbench (the thesis names a stability without a formula). */

#include <vector>

#include "core/base/json.h"
#include "core/base/units.h"
#include "core/grasp/wrench_space.h"

namespace graspbench {

/** A grasp at one instant. */
struct GraspInstant {
  double time_in_phase = 0.0;          ///< [s]
  std::vector<GraspContact> contacts;  ///< measured from the centre of mass, along the axes of O
  double normal_force = 0.0;           ///< F [N]
  double slip_speed = 0.0;             ///< v [m/s]
  bool is_opposed = false;             ///< o
};

/** Means over the samples of a part of a trial; NaN where there are none. */
struct StabilityPart {
  double sigma = kUnset;
  double quality = kUnset;       ///< Q
  double normal_force = kUnset;  ///< F [N]
  double slip_speed = kUnset;    ///< v [m/s]
  double opposition = kUnset;    ///< o, a share
  int num_samples = 0;
};

struct Stability {
  /** That of `stabilisation` if the object is in the hand at the end of the trial, else 0. */
  double sigma = kUnset;
  StabilityPart stabilisation;  ///< its last 0.5 s
  StabilityPart lift;
  StabilityPart hold;
};

/** @param weight  m g [N]  @param object_radius  largest distance of the surface from the centre of
mass [m]; both > 0. Cost: some 0.15 ms for a sample of ten contacts. */
StabilityPart CalcStabilityPart(const std::vector<GraspInstant>& samples, double weight,
                                double object_radius);

Json ToJson(const Stability& stability);
Stability StabilityFromJson(const Json& json);

}  // namespace graspbench
