#pragma once
/** @file
What all trials did before there was a choice: they closed to the target posture at full speed once
the hand had arrived. Frozen configurations and ids say nothing of it, so that they are what they
were; whatever the defaults are, what says nothing means that. */

#include <string>

#include "core/base/text/json.h"
#include "core/grasp/strategy.h"

namespace graspbench {

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

/** A firm grip with the values that its frozen configuration does not say. */
void DropUnusedGrip(StrategyConfig& strategy);

/** Adds to "strategy" of these conditions, where there is one, what it does not say. */
void AddFirmGrip(Json& conditions);

}  // namespace graspbench
