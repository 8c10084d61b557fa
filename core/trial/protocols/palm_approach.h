#pragma once
/** @file
How a hand whose grasp seeks the palm comes to its object: the placing ends kPalmStandOff short of
where the palm would meet the object at its nominal place, and the hand goes on along the approach,
slowly, until the arm bears kPalmTouchForce beside the hand itself, or it has gone kPalmSearchLength.
There it presses with that force by the spring of the arm, settles, and then the digits close.

A palm has no sensor elements. The touch is felt by how far the arm yields at the hand's base, which
is that force over the arm's stiffness (SimConfig). What weighs little slides before that force is
reached: it is pushed until the search ends. Stand-off: the object's variation (5 mm) and 3 mm. All
values are proposed by graspbench. */

#include <algorithm>

namespace graspbench {

inline constexpr double kPalmTouchForce = 1.0;      ///< [N]
inline constexpr double kPalmStandOff = 0.008;      ///< [m]
inline constexpr double kPalmSearchLength = 0.016;  ///< [m]
inline constexpr double kPalmSearchSpeed = 0.005;   ///< [m/s]
inline constexpr double kPalmSettleTime = 0.1;      ///< from the touch to the closure [s]
inline constexpr double kPalmSearchRamp = 0.1;      ///< until it has that speed [s]

/** A value; it is saved and restored with the trial. */
class PalmApproach {
 public:
  /** @param seeks  otherwise it has ended before it begins, at offset 0. */
  explicit PalmApproach(bool seeks) : has_ended_(!seeks), offset_(seeks ? -kPalmStandOff : 0.0) {}

  bool has_ended() const { return has_ended_; }
  bool has_touched() const { return has_touched_; }
  double offset() const { return offset_; }  ///< beyond the placement along the approach [m]
  double speed() const { return speed_; }    ///< of the hand's command [m/s]

  /** One step. @param arm_force  that the arm bears beside the hand [N].
  @param arm_stiffness  SimConfig's [N/m]. */
  void Advance(double step, double arm_force, double arm_stiffness) {
    if (has_ended_) return;
    if (has_touched_) {
      settled_ += step;
      has_ended_ = settled_ >= kPalmSettleTime;
      return;
    }
    has_touched_ = arm_force >= kPalmTouchForce && speed_ >= kPalmSearchSpeed;
    has_ended_ = !has_touched_ && offset_ >= kPalmSearchLength - kPalmStandOff;
    if (has_touched_) offset_ += kPalmTouchForce / arm_stiffness;
    if (has_touched_ || has_ended_) {
      speed_ = 0.0;
      return;
    }
    speed_ = std::min(kPalmSearchSpeed, speed_ + kPalmSearchSpeed * step / kPalmSearchRamp);
    offset_ += speed_ * step;
  }

 private:
  bool has_ended_;
  bool has_touched_ = false;
  double offset_;
  double speed_ = 0.0;
  double settled_ = 0.0;  // since the touch [s]
};

}  // namespace graspbench
