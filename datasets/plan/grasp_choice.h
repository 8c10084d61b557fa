#pragma once
/** @file
Which grasps of a hand a session tries on an object, how the hand does them there, and whether any
of them reaches it: known by geometry before the first trial (core/grasp/predict_grasp.h). */

#include <memory>
#include <string>
#include <vector>

#include "core/grasp/predict_grasp.h"
#include "datasets/plan/session_config.h"
#include "datasets/plan/session_inputs.h"

namespace graspbench {

/** In a configuration and a plan: the hand's camera chooses the grasp in the trial. */
inline constexpr const char* kBySight = "by-sight";

/** Whether the hand looks in the trials, conditions left aside: to be positioned or to choose. */
bool NeedsCamera(const SessionConfig& config);
/** A controller gets the pictures of the hand's camera, or the object's pose that it finds. */
bool ShowsCamera(const PolicyConfig& policy);

/** Whether a grasp is chosen by sight in any trial, conditions included. */
bool HasGraspBySight(const SessionConfig& config);

/** The hand's grasp of this id that may be used on the object; null: none. */
const Grasp* FindGrasp(const SessionHand& hand, const GraspObject& object, const std::string& id);

/** The id that a name in the configuration stands for: that of the grasp of a file, or itself. */
std::string ResolveGraspName(const SessionInputs& inputs, const std::string& name);

/** The grasp as the trial takes it: fitted to the object (predict_grasp.h), which is found once for
the session and shared by threads. What was made for the object, or is what the object names as best
for this hand, stays as it is; so does what is clear of its bounding box, unless its palm may touch.
*/
Grasp FindFitted(const SessionInputs& inputs, const SessionHand& hand, const Grasp& grasp,
                 const std::shared_ptr<const GraspObject>& object);

/** What stands in the plan as one grasp. */
struct GraspEntry {
  std::string id;
  std::vector<const Grasp*> grasps;  ///< one, or those of which the camera chooses
};

/** Of the hand's standard grasps the first of each type that the outline of an object may suggest
(core/vision/locate_object.h). @throws Error(kUsage) when the hand has none of one type. */
std::vector<const Grasp*> FindSightGrasps(const SessionHand& hand, const GraspObject& object);

/** As MakePlan says (session_plan.h). "predicted" is what the object names for this hand, else of
those that reach and meet it by prediction one that held half of the shapes that its development had
not met (Grasp::held_share), else any; then the one that keeps most of four conditions (clear of it,
forces that hold, every digit meets it, the palm near), and of those alike the one that meets it
lowest. */
std::vector<GraspEntry> ListGraspEntries(const SessionConfig& config, const SessionInputs& inputs,
                                         const SessionHand& hand,
                                         const std::shared_ptr<const GraspObject>& object);

/** All grasps of the entries, each once. */
std::vector<const Grasp*> FindGrasps(const SessionConfig& config, const SessionInputs& inputs,
                                     const SessionHand& hand,
                                     const std::shared_ptr<const GraspObject>& object);

/** What is to be said of the session's objects before it, each in the order hand, object:

- "allegro, carton: the grasp that rehearsal chose, g3, held 1 of 4 imagined trials", of "best"
  grasps that held half or less;
- "allegro, carton: none of g1, g2 reaches it, so every trial will be unreachable; nearest is g2,
  whose pads stop 6.2 mm short", with the widths where the object is too wide, of each name of a
  grasp; what an object names as its best grasp is believed;
- objects that tip over when they are set down as their mesh lies (core/shape/resting_pose.h). */
std::vector<std::string> ListObjectWarnings(const SessionConfig& config,
                                            const SessionInputs& inputs);

}  // namespace graspbench
