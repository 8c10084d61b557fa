#pragma once
/** @file
Samples a trial's grasp for stability.h: every 25 ms in stabilisation, every 0.1 s in lift-off and
every 0.2 s in the hold, which costs a trial about a tenth of its time. */

#include <vector>

#include "core/grasp/strategy.h"
#include "core/physics/world.h"
#include "core/trial/measures/stability.h"
#include "core/trial/trial_setup.h"

namespace graspbench {

/** Largest distance of the object's surface from its centre of mass [m]. */
double CalcObjectRadius(const GraspObject& object);

/** Speed of the object against the hand, |v_WOcm - v_WH| + radius |w_WO| [m/s]: no point of it is
faster. A ball that spins on the spot moves, too. */
double CalcSlipSpeed(const WorldState& state, double object_radius);

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
