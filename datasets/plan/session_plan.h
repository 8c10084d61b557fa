#pragma once
/** @file
The plan of a session: one line per trial, a pure function of the configuration and of the content
of hands and objects. */

#include <optional>
#include <string>
#include <vector>

#include "core/base/random.h"
#include "core/base/text/json.h"
#include "core/base/text/record_fields.h"
#include "core/trial/trial_runner.h"
#include "datasets/plan/session_config.h"
#include "datasets/plan/session_inputs.h"

namespace graspbench {

struct PlannedTrial {
  /** Hash of everything that matters for the result, and of nothing else: 16 hexadecimal digits.
  Adding a hand or an object to a session leaves the other trials' ids as they are. */
  std::string id;
  std::string hand;
  std::string object;
  std::string grasp;
  int trial = 0;  ///< zero-based number within the cell
  /** Name of one of the session's conditions; none: as the session is configured. */
  std::optional<std::string> condition = {};

  template <class V>
  static void ListFields(V&& field) {
    using P = PlannedTrial;
    field("trial_id", &P::id, FieldColumn{"", "hash of everything that matters for the result"});
    field("hand", &P::hand, FieldColumn{"", "id of the hand"});
    field("object", &P::object, FieldColumn{"", "id of the object"});
    field("grasp", &P::grasp,
          FieldColumn{"",
                      "id of the standard grasp, g1 to g5, or of an optimised one; by-sight: the "
                      "camera chose it"});
    field("trial", &P::trial,
          FieldColumn{"", "number of the trial within its hand, object and grasp, from 0"});
    field("condition", &P::condition);
  }
};
bool operator==(const PlannedTrial& a, const PlannedTrial& b);

/** "tum, golf_ball, g1, number 3", for a person. */
std::string DescribeTrial(const PlannedTrial& planned);

/** The same without the condition: what the trials of one draw share. */
std::string NameDraw(PlannedTrial planned);

/** Hands and objects have names of their own, and the hands the camera and the skin that the
configuration asks for. @throws Error(kUsage) that names the first offender. */
void CheckInputs(const SessionConfig& config, const SessionInputs& inputs);

/** Cells in the order hand, object, grasp. Under several conditions: hand, object, settings, grasp,
trial, condition, so that a world serves as many trials in a row as it can and the same trial with
several delays is undelayed once; what a condition's backend cannot move has no trial there. With
the grasps

- "best": the object's best grasp for that hand; where it names none (a user's hand) the one that
  was rehearsed (rehearsed_types.h). Conditions use the one that the base chooses, so that every
  draw has a pair; how the hand does it on the object (FindFitted) each finds with its own settings,
  as a session of its own would;
- "predicted": the same, but where the object names none, or one that the hand cannot do, of the
  object's grasp_order that of the highest rank by prediction, the first of equal ones
  (grasp_choice.h); else the hand's first;
- "all": all that the hand can do;
- ids and grasp files, "best" and "predicted" among them: those that the hand can do on the object;
- "by-sight", which may be among ids: what the hand's camera chooses in the trial
  (core/trial/trial_runner.h).

@throws Error(kRange) for a bad configuration; Error(kUsage) for two hands or objects of one name,
for a hand that cannot choose by sight or when nothing is left to do; Error(kNotFound) for a grasp
that none of the hands can do. */
std::vector<PlannedTrial> MakePlan(const SessionConfig& config, const SessionInputs& inputs);

/** The draws of a trial: object pose from (seed, object, trial) only, so that every hand and grasp
meets the same poses; joint errors from (seed, hand, object, trial), uniform within the hand's
accuracy for every joint with a drive of its own. */
TrialDraw MakeTrialDraw(const SessionConfig& config, const Hand& hand, const GraspObject& object,
                        int trial);

/** The object's part of it, which needs no hand: joint_error is empty. */
TrialDraw MakeObjectDraw(const SessionConfig& config, const std::string& object, int trial);

/** How differently two draws put the object: the shift, and the turn as the way of a point at
`radius` from its centre [m]. */
double CalcDrawDistance(const TrialDraw& a, const TrialDraw& b, double radius);

/** Three numbers of `pose` (x, y, yaw), then one of `error` for every joint with a drive. */
TrialDraw DrawVariation(const VariationConfig& variation, const Hand& hand, RandomStream pose,
                        RandomStream error);

/** Every field that decides a grasp's result. */
Json ToJson(const Grasp& grasp);

/** Everything TrialRunner needs for a trial of MakePlan(config, inputs). */
TrialSetup MakeTrialSetup(const SessionConfig& config, const SessionInputs& inputs,
                          const PlannedTrial& planned);

}  // namespace graspbench
