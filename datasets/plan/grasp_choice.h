#pragma once
/** @file
Which grasps of a hand a session uses on an object, how the hand performs them there, and whether
any of them reaches it. Geometry answers this before the first trial
(core/grasp/predict_grasp.h). */

#include <memory>
#include <string>
#include <vector>

#include "core/grasp/predict_grasp.h"
#include "datasets/plan/session_config.h"
#include "datasets/plan/session_inputs.h"

namespace graspbench {

/** Name in configurations and plans for the grasp that the hand's camera chooses in the trial. */
inline constexpr const char* kBySight = "by-sight";

/** Whether the session's base needs the hand's camera, for positioning or to choose the grasp. */
bool NeedsCamera(const SessionConfig& config);
/** Whether the controller receives the images of the hand's camera or the object pose estimated
from them. */
bool ShowsCamera(const PolicyConfig& policy);

/** Whether the base or any condition chooses a grasp by sight. */
bool HasGraspBySight(const SessionConfig& config);

/** Returns the hand's grasp with this id that may be used on the object; null if there is none. */
const Grasp* FindGrasp(const SessionHand& hand, const GraspObject& object, const std::string& id);

/** Returns the grasp id for a name in the configuration: the id in the file if the name is a grasp
file, else the name itself. */
std::string ResolveGraspName(const SessionInputs& inputs, const std::string& name);

/** Returns the grasp as trials use it: fitted to the object (predict_grasp.h). The fit is computed
once for the session and shared by threads. A grasp made for the object, or named by the object as
best for this hand, stays unchanged. So does one that is clear of the object's bounding box, unless
its palm may touch. */
Grasp FindFitted(const SessionInputs& inputs, const SessionHand& hand, const Grasp& grasp,
                 const std::shared_ptr<const GraspObject>& object);

/** One grasp entry of the plan. */
struct GraspEntry {
  std::string id;
  std::vector<const Grasp*> grasps;  ///< one, or those from which the camera chooses
};

/** Returns the first of the hand's standard grasps of each type that an object's outline may
suggest (core/vision/locate_object.h). @throws Error(kUsage) when the hand lacks one of these
types. */
std::vector<const Grasp*> FindSightGrasps(const SessionHand& hand, const GraspObject& object);

/** Lists the grasps of the plan by the rules of MakePlan (session_plan.h). "predicted" is the grasp
that the object names for this hand. Otherwise candidates are ranked by these criteria in turn:

- predicted to reach and meet the object;
- held at least half of the shapes that its development had not seen (Grasp::held_share);
- how many of four conditions are met: clear of the object, forces that hold, every digit meets the
  object, the palm near it;
- how low it meets the object. */
std::vector<GraspEntry> ListGraspEntries(const SessionConfig& config, const SessionInputs& inputs,
                                         const SessionHand& hand,
                                         const std::shared_ptr<const GraspObject>& object);

/** All grasps of ListGraspEntries, each once. */
std::vector<const Grasp*> FindGrasps(const SessionConfig& config, const SessionInputs& inputs,
                                     const SessionHand& hand,
                                     const std::shared_ptr<const GraspObject>& object);

/** Lists warnings about the session's objects before it runs, each in the order hand, object:

- "allegro, carton: the grasp chosen by rehearsal, g3, held 1 of 4 imagined trials", for "best" and
  rehearsed grasps that held half or fewer;
- "allegro, carton: none of g1, g2 reaches it, so every trial will be unreachable; nearest is g2,
  whose pads stop 6.2 mm short", for each name in the configuration's list of grasps, with both
  widths where the object is too wide; a best grasp that the object names is not checked;
- objects that tip over when they are set down as their mesh lies (core/shape/resting_pose.h). */
std::vector<std::string> ListObjectWarnings(const SessionConfig& config,
                                            const SessionInputs& inputs);

}  // namespace graspbench
