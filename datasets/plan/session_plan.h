#pragma once
/** @file
The plan of a session: one entry per trial, a pure function of the configuration and of the content
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
  /** Hash of everything that affects the result, and of nothing else: 16 hexadecimal digits. Adding
  a hand or an object to a session leaves the other trials' ids as they are. */
  std::string id;
  std::string hand;
  std::string object;
  std::string grasp;
  int trial = 0;  ///< zero-based number within its hand, object and grasp
  /** Name of one of the session's conditions; none: the base. */
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

/** Describes a trial for display: "tum, golf_ball, g1, number 3". */
std::string DescribeTrial(const PlannedTrial& planned);

/** As DescribeTrial(), without the condition: the same for all trials of one draw. */
std::string NameDraw(PlannedTrial planned);

/** Checks that the names of hands and objects are unique and that hands have the camera and the
skin that the configuration requires. @throws Error(kUsage) that names the first offender. */
void CheckInputs(const SessionConfig& config, const SessionInputs& inputs);

/** Makes the plan in the order hand, object, grasp, trial. With several conditions the order is
hand, object, settings, grasp, trial, condition. So consecutive trials share a world where possible,
and the undelayed trial is simulated once for several delays. Hands and objects that a condition's
backend cannot move have no trial under it. The grasps may be

- "best": the object's best grasp for that hand, or the rehearsed one (rehearsed_types.h) where the
  object names none, as for a user's hand. Conditions use the grasp that the base chooses, so that
  every draw has a pair. Each condition fits it to the object (FindFitted) with its own settings, as
  a separate session would;
- "predicted": the object's best grasp for that hand. Where it names none, or one that the hand
  cannot perform, the grasp of highest predicted rank in the object's grasp_order, the first of
  equal ones (grasp_choice.h); else the hand's first;
- "all": all grasps of the hand;
- ids and grasp files, "best" and "predicted" among them: those that the hand can perform on the
  object;
- "by-sight", which may be among ids: the grasp that the hand's camera chooses in the trial
  (core/trial/trial_runner.h).

@throws Error(kRange) for an invalid configuration; Error(kUsage) for two hands or objects of the
same name, for a hand that cannot choose by sight or for an empty plan; Error(kNotFound) for a grasp
that none of the hands can perform. */
std::vector<PlannedTrial> MakePlan(const SessionConfig& config, const SessionInputs& inputs);

/** Draws a trial's variation. The object pose depends only on (seed, object, trial), so that every
hand and grasp meets the same poses. Joint errors depend on (seed, hand, object, trial) and are
uniform within the hand's accuracy for every joint with its own drive. */
TrialDraw MakeTrialDraw(const SessionConfig& config, const Hand& hand, const GraspObject& object,
                        int trial);

/** Draws only the object pose of MakeTrialDraw, which needs no hand: joint_error is empty. */
TrialDraw MakeObjectDraw(const SessionConfig& config, const std::string& object, int trial);

/** Distance between the object poses of two draws [m]: the shift, with the rotation counted as the
displacement of a point at `radius` from the object's centre. */
double CalcDrawDistance(const TrialDraw& a, const TrialDraw& b, double radius);

/** Takes three numbers from `pose` (x, y, yaw) and one from `error` for every joint with a
drive. */
TrialDraw DrawVariation(const VariationConfig& variation, const Hand& hand, RandomStream pose,
                        RandomStream error);

/** Writes every field that affects a grasp's result. */
Json ToJson(const Grasp& grasp);

/** Collects everything that TrialRunner needs for a trial of MakePlan(config, inputs). */
TrialSetup MakeTrialSetup(const SessionConfig& config, const SessionInputs& inputs,
                          const PlannedTrial& planned);

}  // namespace graspbench
