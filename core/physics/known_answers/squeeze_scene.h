#pragma once
/** @file
An object squeezed by fingers of known force that its weight then pulls on: the scene of thresholds
of friction, of torsion and of pads. */

#include <functional>

#include "core/physics/known_answers/small_scenes.h"

namespace graspbench {

struct Squeeze {
  int num_fingers = 2;
  double force = 5.0;  ///< of each finger [N]
  double mass = 0.1;
  double mu = 0.5;
  double torsion_radius = 0.0;
  SoftPad pad;              ///< of the fingers
  double off_centre = 0.0;  ///< of the fingers along y from the object's centre [m]
  double step = 0.002;
};

/** Squeezed without weight for 0.3 s, then the weight comes slowly. */
class SqueezeScene {
 public:
  /** @param half_width  of the object between the fingers. */
  SqueezeScene(const Squeeze& squeeze, GraspObject object, double half_width);

  SmallWorld& world() { return world_; }
  double CalcFall() const;  ///< [m]
  double CalcTilt() const;  ///< of the object's y axis from the horizontal [rad]

 private:
  SmallWorld world_;
};

/** The value between `low` and `high` at which `holds` changes, to one part in 500 of `high`; NaN:
it does not. */
double FindThreshold(double low, double high, const std::function<bool(double)>& holds);

}  // namespace graspbench
