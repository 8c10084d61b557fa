#pragma once
/** @file
What a session's hands and objects must have for its grip, asked before it starts; and what its
frozen configuration says of it.

What all trials did before there was a choice is a firm grip: they closed to the target posture at
full speed once the hand had arrived. Frozen configurations and ids say nothing of it, so that they
are what they were; whatever the defaults are, what says nothing means that. */

#include <string>
#include <vector>

#include "core/base/text/json.h"
#include "core/grasp/strategy.h"
#include "datasets/plan/session_config.h"
#include "datasets/plan/session_inputs.h"

namespace graspbench {

/** @throws Error(kRange) for a force above the bound of a hand in one of the session's grasps, with
the largest possible (core/trial/grip/grip_statics.h). */
void CheckGripForces(const SessionConfig& config, const SessionInputs& inputs);
/** By sensed touch. @throws Error(kRange) for a force that a digit's elements do not feel: below the
detection threshold of one, or above what all of the digit together can feel. */
void CheckFeltForces(const SessionConfig& config, const SessionInputs& inputs);
/** Of hands whose pads give less than is asked in one of the session's grasps, by estimate; whose
elements feel one by one less than is asked, or nothing of the least that a margin asks. */
std::vector<std::string> ListGripWarnings(const SessionConfig& config, const SessionInputs& inputs);
/** @throws Error(kRange) for a margin with an object that has no friction. */
void CheckGripMargins(const SessionConfig& config, const SessionInputs& inputs);

/** Without what a firm grip does not say or does not look at. */
Json StrategyToJson(const StrategyConfig& strategy);

/** Whether a setting of this key can change a trial: "strategy.grip_margin" only with a grip of
margin, "strategy.grip_force_n" not with a firm one; every other key. */
bool CanMatter(const std::string& key, const StrategyConfig& strategy);

/** "has no use where strategy.grip is force; ...", of a setting that cannot matter. */
std::string DescribeUnusedGrip(const StrategyConfig& strategy);

/** @param assignment  "strategy.grip_margin=3".
@throws Error(kUsage) for one that cannot matter. */
void RefuseUnusedGrip(const std::string& assignment, const StrategyConfig& strategy);

/** That of the session's trials: where a controller closes the digits, a firm grip, which regulates
nothing. */
StrategyConfig FindUsedStrategy(const SessionConfig& config);

/** A firm grip with the values that its frozen configuration does not say. */
void DropUnusedGrip(StrategyConfig& strategy);

/** Adds to "strategy" of these conditions, where there is one, what it does not say. */
void AddFirmGrip(Json& conditions);

}  // namespace graspbench
