#pragma once
/** @file
Which grasps of a hand a session tries on an object, and whether any of them can reach it: known by
geometry before the first trial (core/grasp/placement.h). */

#include <memory>
#include <string>
#include <vector>

#include "datasets/plan/session_config.h"
#include "datasets/plan/session_inputs.h"

namespace graspbench {

/** The hand's grasp of this id that may be used on the object; null: none. */
const Grasp* FindGrasp(const SessionHand& hand, const GraspObject& object, const std::string& id);

/** The id that a name in the configuration stands for: that of the grasp of a file, or itself. */
std::string ResolveGraspName(const SessionInputs& inputs, const std::string& name);

/** As MakePlan says (session_plan.h). */
std::vector<const Grasp*> FindGrasps(const SessionConfig& config, const SessionInputs& inputs,
                                     const SessionHand& hand,
                                     const std::shared_ptr<const GraspObject>& object);

/** An object that none of the session's grasps of a hand reaches. */
struct UnreachedObject {
  std::string hand, object;
  std::vector<std::string> tried;  ///< ids of grasps, the object's order for "best"
  std::string nearest;             ///< of these
  double miss = 0.0;               ///< by which its pads stop short [m]
};

/** In the order hand, object. What an object names as its best grasp for a hand is believed. */
std::vector<UnreachedObject> FindUnreached(const SessionConfig& config,
                                           const SessionInputs& inputs);

/** "allegro, carton: none of g1, g2 reaches it, so every trial will be unreachable; nearest is g2,
whose pads stop 6.2 mm short". */
std::string DescribeUnreached(const UnreachedObject& unreached);

}  // namespace graspbench
