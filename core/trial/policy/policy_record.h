#pragma once
/** @file
What a controller did in a trial, in the trial's record. */

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "core/base/pose.h"
#include "core/base/text/record_fields.h"

namespace graspbench {

/** One row of an action as it was carried out, before limits cut it. */
struct PolicyRow {
  Eigen::VectorXd targets;               ///< of the driven joints
  bool begins = false;                   ///< it is the first of its answer
  std::optional<Pose> hand = {};         ///< X_WH; unset: not asked for
  Eigen::VectorXd stiffness = {};        ///< scale of the driven joints; empty: not asked for
  std::optional<std::string> hold = {};  ///< the regulator takes over with this grip
};
struct PolicyRows : std::vector<PolicyRow> {};
/** An object per row, without what is as in the row before. */
Json ToJson(const PolicyRows& rows);
/** @throws Json::exception or Error(kFormat). */
void ReadJson(const Json& json, PolicyRows& rows);

/** What the controller did in a trial: enough to repeat the trial without it. */
struct PolicyRecord {
  std::string object_pose;        ///< what it was told of it, of kPolicyObjectPoses
  std::optional<Pose> told_X_WO;  ///< unset: nothing, or the true one
  int num_questions = 0;
  int num_cut = 0;                   ///< targets beyond a joint's limits, which were cut to them
  std::optional<int> num_hand_cut;   ///< rows whose pose of the hand was cut; unset: it is placed
  bool said_done = false;            ///< else its time was over, or the trial
  std::optional<std::string> fault;  ///< what was wrong with its last answer
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
