#pragma once
/** @file
The part of a trial's record that describes its controller. */

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "core/base/pose.h"
#include "core/base/text/record_fields.h"

namespace graspbench {

/** One row of an action as executed, before it was limited. */
struct PolicyRow {
  Eigen::VectorXd targets;               ///< of the driven joints
  bool begins = false;                   ///< first row of its answer
  std::optional<Pose> hand = {};         ///< X_WH; unset: not commanded
  Eigen::VectorXd stiffness = {};        ///< scales of the driven joints; empty: not commanded
  std::optional<std::string> hold = {};  ///< grip with which the regulator takes over
};
struct PolicyRows : std::vector<PolicyRow> {};
/** One object per row, without values that equal those of the row before. */
Json ToJson(const PolicyRows& rows);
/** @throws Json::exception or Error(kFormat). */
void ReadJson(const Json& json, PolicyRows& rows);

/** The controller's actions in a trial: enough to repeat the trial without it. */
struct PolicyRecord {
  std::string object_pose;        ///< object pose given to it, one of kPolicyObjectPoses
  std::optional<Pose> told_X_WO;  ///< unset: none, or the true pose
  int num_questions = 0;
  int num_cut = 0;                   ///< targets beyond a joint's limits, clamped to them
  std::optional<int> num_hand_cut;   ///< rows whose hand pose was limited; unset: not commanded
  bool said_done = false;            ///< else control ended by its time limit or with the trial
  std::optional<std::string> fault;  ///< error in its last answer
  PolicyRows rows;

  template <class V>
  static void ListFields(V&& field) {
    using R = PolicyRecord;
    field("object_pose", &R::object_pose);
    field("told_X_WO", &R::told_X_WO);
    field("num_questions", &R::num_questions);
    field("num_cut", &R::num_cut);
    field("num_hand_cut", &R::num_hand_cut);
    field("said_done", &R::said_done);
    field("fault", &R::fault);
    field("rows", &R::rows);
  }
};

}  // namespace graspbench
