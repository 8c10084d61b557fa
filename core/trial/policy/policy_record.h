#pragma once
/** @file
What a controller did in a trial, in the trial's record. */

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "core/base/text/record_fields.h"

namespace graspbench {

/** One row of an action as it was carried out, before limits cut it. */
struct PolicyRow {
  Eigen::VectorXd targets;  ///< of the driven joints
  bool begins = false;      ///< it is the first of its answer

  template <class V>
  static void ListFields(V&& field) {
    field("targets_rad", &PolicyRow::targets);
    field("begins", &PolicyRow::begins);
  }
};

/** What the controller did in a trial: enough to repeat the trial without it. */
struct PolicyRecord {
  std::string object_pose;  ///< what it was told of it
  int num_questions = 0;
  int num_cut = 0;                   ///< targets beyond a joint's limits, which were cut to them
  bool said_done = false;            ///< else its time was over, or the trial
  std::optional<std::string> fault;  ///< what was wrong with its last answer
  std::vector<PolicyRow> rows;

  template <class V>
  static void ListFields(V&& field) {
    using R = PolicyRecord;
    field("object_pose", &R::object_pose);
    field("num_questions", &R::num_questions);
    field("num_cut", &R::num_cut);
    field("said_done", &R::said_done);
    field("fault", &R::fault);
    field("rows", &R::rows);
  }
};

}  // namespace graspbench
