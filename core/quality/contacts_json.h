#pragma once
/** @file
A set of contacts as a file:

    {"contacts": [
       {"p_m": [0.03, 0, 0], "n": [-1, 0, 0], "mu": 0.5, "torsion_m": 0.002, "t": [0, 1, 0]}, ...],
     "edges": 8, "torque_scale_m": 0.05, "reference_m": [0, 0, 0], "convention": "ferrari-canny"}

`n` points into the object. `torsion_m` is the largest moment about the normal per newton of normal
force (0 if missing). The optional `t` is the direction of the first cone edge. p_m, n and mu are
required; see QualityRequest for the other keys and their defaults. */

#include <string>
#include <string_view>

#include "core/quality/grasp_quality.h"

namespace graspbench {

/** Parses a set of contacts.
@param file  name of the text in messages.
@throws Error(kFormat) with all problems at once, contacts by their zero-based index. NaN and
Infinity, which some programs write although they are not valid JSON, are rejected with their
location. */
QualityRequest ParseQualityRequest(std::string_view text, const std::string& file);

}  // namespace graspbench
