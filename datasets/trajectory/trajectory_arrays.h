#pragma once
/** @file
A trajectory as arrays of numbers, the same in every form that holds arrays (HDF5, NumPy). */

#include <string>
#include <vector>

#include "datasets/trajectory/trajectory_form.h"

namespace graspbench {

/** Row after row; column names carry the unit. */
struct TrajectoryArray {
  std::string name;
  std::vector<std::string> columns;
  std::vector<double> values;
};

/** `states` and `actions` have a row an instant. `contacts` has a row a contact: `instant` is a row
of the states, `link` an index into the names of the links. A hand with tactile elements has `taxels`
[N], a row an instant, and `taxel_elements`, a row an element in the frame of its link: `digit` is an
index into the names of the digits, -1 for the palm. */
std::vector<TrajectoryArray> MakeTrajectoryArrays(const TrialTrajectory& trajectory);

/** The events as a JSON array. */
std::string FormatTrajectoryEvents(const TrialTrajectory& trajectory);

}  // namespace graspbench
