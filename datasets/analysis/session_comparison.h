#pragma once
/** @file
Two sessions trial by trial. Two trials are a pair when object and number are the same and the object
stood in the very same place; hands and grasps must be the same, too, unless each session has only
one hand, or one grasp of it on that object: then these are what is compared. */

#include <string>
#include <vector>

#include "datasets/analysis/conditions/sensitivity_summary.h"

namespace graspbench {

struct TrialPair {
  const TrialRecord* before = nullptr;
  const TrialRecord* after = nullptr;

  bool is_won() const { return !IsSuccess(before->result.outcome) && is_success_after(); }
  bool is_lost() const { return IsSuccess(before->result.outcome) && !is_success_after(); }

 private:
  bool is_success_after() const { return IsSuccess(after->result.outcome); }
};

struct SessionComparison {
  std::vector<TrialPair> pairs;  ///< in the order of the first session's plan
  int num_only_before = 0;       ///< finished trials that are in no pair
  int num_only_after = 0;
  std::vector<SettingChange> changes;  ///< of all pairs of a hand; `hand` is the first's
  std::vector<std::string> settings;   ///< "sim.step_s: 0.002 and 0.001"
};

/** The records must outlive what is found.
@throws Error(kUsage) when there is no pair, saying why. */
SessionComparison CompareSessions(const Session& before, const Session& after);

}  // namespace graspbench
