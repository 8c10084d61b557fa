#pragma once
/** @file
What a trial is called in the end. */

#include <string>
#include <vector>

namespace graspbench {

enum class Outcome {
  kNotRun,
  kSuccess,
  kNoContact,            ///< not all grasping digits ever touched
  kPushedAway,           ///< the object left the fingers' reach before or during closure
  kKnockedOver,          ///< it tipped over
  kLostWhileClosing,     ///< touched, but contact was lost again before lift-off
  kSlippedInLiftOff,     ///< it did not come along
  kDroppedWhileHolding,  ///< lifted, then lost, touching the table or still slipping at the end
  kNumericalFailure,     ///< the simulation gave up; `reason` says why
};
const char* NameOf(Outcome outcome);  ///< "success", "no contact", ...
/** All outcomes but kNotRun, in the order above. */
const std::vector<Outcome>& ListOutcomes();
Outcome OutcomeFromName(const std::string& name);

}  // namespace graspbench
