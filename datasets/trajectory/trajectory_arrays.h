#pragma once
/** @file
A trajectory as arrays of numbers, common to all forms with arrays (HDF5, NumPy). */

#include <string>
#include <vector>

#include "datasets/trajectory/trajectory_form.h"

namespace graspbench {

/** An array with named columns, stored row by row; column names contain the unit. */
struct TrajectoryArray {
  std::string name;
  std::vector<std::string> columns;
  std::vector<double> values;
};

/** Makes the arrays. `states` and `actions` have one row per instant. `contacts` has one row per
contact: `instant` is the row in `states`, `link` an index into the names of the links. A hand with
tactile elements has `taxels` [N], one row per instant, and `taxel_elements`, one row per element in
the frame of its link: `digit` is an index into the names of the digits, -1 for the palm. */
std::vector<TrajectoryArray> MakeTrajectoryArrays(const TrialTrajectory& trajectory);

/** Formats the events as a JSON array. */
std::string FormatTrajectoryEvents(const TrialTrajectory& trajectory);

}  // namespace graspbench
