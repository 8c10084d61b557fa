#pragma once
/** @file
When a trial may take longer steps: while the object hangs in the hand and nothing happens to its
contacts, one step as long as several gives the same motion. The same links have touched at the same
number of points for kSteadyTime, none has slid, and the object has moved no faster against the hand
than kSteadySlip. At the first slip, new contact or loss steps have the settings' length again.

Limits: what happens within a long step is felt at its end, at most kLongestStep late. The engine's
bars of accuracy are those of its short steps; that verdicts are those of short steps is measured
(workbench/manual/validation/physics.yaml). All limits are proposed by graspbench. */

#include <vector>

#include "core/physics/world.h"

namespace graspbench {

inline constexpr double kSteadyTime = 0.05;   ///< [s]
inline constexpr double kSteadySlip = 0.005;  ///< [m/s]
inline constexpr double kLongestStep = 0.01;  ///< [s]

/** Follows the hand's contacts with the object; a value. */
class SteadyContacts {
 public:
  /** After every step. @param duration  of that step [s]   @param slip_speed  CalcSlipSpeed. */
  void Observe(const std::vector<HandContact>& contacts, double table_force, double slip_speed,
               double duration);
  bool are_steady() const { return steady_time_ >= kSteadyTime - 1e-9; }

 private:
  std::vector<int> links_;    // by contact, of the last step
  double steady_time_ = 0.0;  // [s]
};

/** How many steps of the settings' length one may take together. */
int CalcSteadySteps(const SimConfig& config);

}  // namespace graspbench
