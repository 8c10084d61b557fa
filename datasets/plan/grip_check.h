#pragma once
/** @file
Checks before a session starts that its hands and objects suit its grip, and decides what its frozen
configuration records of the grip.

Before the grip was configurable, all trials used a firm grip: they closed to the target posture at
full speed once the hand had arrived. Frozen configurations and trial ids omit the keys of a firm
grip, so that old ones stay valid. A configuration without these keys means a firm grip, whatever
the defaults are. */

#include <string>
#include <vector>

#include "core/base/text/json.h"
#include "core/grasp/strategy.h"
#include "datasets/plan/session_config.h"
#include "datasets/plan/session_inputs.h"

namespace graspbench {

/** @throws Error(kRange) for a force above what a hand can exert in one of the session's grasps;
the message gives the bound (core/trial/grip/grip_statics.h). */
void CheckGripForces(const SessionConfig& config, const SessionInputs& inputs);
/** Checks forces under sensed touch. @throws Error(kRange) for a force that a digit's elements
cannot measure: not above the detection threshold of one element, or above the saturation of all
elements together. */
void CheckFeltForces(const SessionConfig& config, const SessionInputs& inputs);
/** Lists warnings about hands whose pads exert less than the setpoint in one of the session's
grasps, by estimate. Under sensed touch also about hands of which one element saturates below the
setpoint or does not detect the minimum setpoint. */
std::vector<std::string> ListGripWarnings(const SessionConfig& config, const SessionInputs& inputs);
/** @throws Error(kRange) for a margin with an object that has no friction. */
void CheckGripMargins(const SessionConfig& config, const SessionInputs& inputs);

/** Converts the strategy to JSON, without the keys that a firm grip omits or ignores. */
Json StrategyToJson(const StrategyConfig& strategy);

/** Whether a setting with this key can change a trial. "strategy.grip_margin" can only if the grip
is margin, "strategy.grip_force_n" if the grip is not firm; every other key can. */
bool CanMatter(const std::string& key, const StrategyConfig& strategy);

/** Returns "has no effect if strategy.grip is force; ...", for a setting that cannot matter. */
std::string DescribeUnusedGrip(const StrategyConfig& strategy);

/** @param assignment  "strategy.grip_margin=3".
@throws Error(kUsage) for one that cannot matter. */
void RefuseUnusedGrip(const std::string& assignment, const StrategyConfig& strategy);

/** Returns the strategy that the session's trials use. Where a controller closes the digits, it has
a firm grip, which regulates no force. */
StrategyConfig FindUsedStrategy(const SessionConfig& config);

/** Resets the force and margin of a firm grip, which its frozen configuration omits. */
void DropUnusedGrip(StrategyConfig& strategy);

/** Adds the omitted keys of a firm grip to "strategy" of these conditions, where there is one. */
void AddFirmGrip(Json& conditions);

}  // namespace graspbench
