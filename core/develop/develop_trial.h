#pragma once
/** @file
What the development keeps of a simulated trial, and how it scores it, larger is better:

    success    1 + 0.3 x / (1 + x),  x = sigma / (m g + 0.2 N): how firmly it is held
               + 0.2 (digits that touched) / (all)
               + 0.6 when the palm touches in the end, of a grasp whose palm may
               + 0.15 of a pinch that holds by the sides of its digits
               - 0.3 when a digit touched before the hand closed
    else       0.3 (digits that touched) / (all) + 0.2 (height reached) / (height of the lift),
               0 of a numerical failure

so that a failure leads towards success, and among successes the firm ones win. */

#include <string>
#include <vector>

#include "core/base/text/record_fields.h"
#include "core/grasp/standard_grasp.h"
#include "core/shape/grasp_object.h"
#include "core/trial/trial_result.h"

namespace graspbench {

struct DevelopTrial {
  Outcome outcome = Outcome::kNotRun;
  double score = 0.0;

  template <class V>
  static void ListFields(V&& field) {
    field("outcome", &DevelopTrial::outcome);
    field("score", &DevelopTrial::score);
  }
};

DevelopTrial MakeDevelopTrial(const Grasp& grasp, const GraspObject& object,
                              const TrialResult& result);

double CalcMeanScore(const std::vector<DevelopTrial>& trials);  ///< 0 without trials
int CountSuccesses(const std::vector<DevelopTrial>& trials);

}  // namespace graspbench
