#pragma once
/** @file
How far a hand moves an object while it grasps it, from the postures that a record keeps:

    before lift   the object's motion in the world from the start of closure to lift-off, or to the
                  end of a trial that ends earlier
    in the hand   the change of its pose in H from the start of closure to the end of the trial: how
                  far it is from where the plan has it in the hand

A shift is that of O, the centre of the object's bounding box; a turn is the angle about any axis. A
round object's turn means little. */

#include <optional>

#include "core/base/units.h"
#include "core/grasp/strategy.h"
#include "core/trial/trial_result.h"

namespace graspbench {

struct Disturbance {
  Displacement before_lift;
  Displacement in_hand;
};

/** All NaN for a trial that did not come to closure, or whose record came without its postures. */
Disturbance CalcDisturbance(const TrialResult& result);

/** In the world, from the start of closure to the last digit's touch or to where the strategy waits
no longer for it; told of every step of a trial. */
class ClosingMeter {
 public:
  void Observe(Phase phase, const Pose& X_WO);
  /** NaN without closure. */
  Displacement Calc() const;

 private:
  std::optional<Pose> start_;
  Pose last_ = Pose::Identity();
  bool has_ended_ = false;
};

}  // namespace graspbench
