#pragma once
/** @file
Success by how far an object lay from where it should, for each way of positioning the hand: the
session's own and those that graspbench sensitivity tried on the same draws. */

#include <string>
#include <vector>

#include "datasets/analysis/session_summary.h"
#include "datasets/session/sensitivity_store.h"

namespace graspbench {

/** One hand's trials under one positioning whose object lay so far from where it should. */
struct OffsetClass {
  std::string hand;
  std::string positioning;       ///< "camera"
  double low = 0.0, high = 0.0;  ///< [m]; high is outside, but of the last class
  Tally tally;
};

/** From 0 to the corner of the square of draws in four classes of equal width, for hands in the
order of the records, the session's positioning first. Empty without offsets. */
std::vector<OffsetClass> ListOffsetClasses(const Session& session, const SensitivityData& varied);

}  // namespace graspbench
