#pragma once
/** @file
A session's trials again with other steps, other contact stiffnesses, friction that is off by a
thousandth and another backend; what they make of its numbers says
datasets/analysis/conditions/numerics_summary.h. */

#include <string>
#include <vector>

#include "core/base/text/json.h"
#include "datasets/analysis/conditions/numerics_summary.h"
#include "workbench/experiments/session_experiment.h"

namespace graspbench {

/** A quarter, half and double of the step, half and double contact stiffness (normal and
tangential), friction 0.1 % lower and higher, so that flips of the step stand beside those of a draw
that nobody can know, and Simbody's compliant contact ("compliant") where it has a geometry for hand
and object; what is out of a session's range is left out. */
std::vector<Condition> ListNumericsVariants(const SessionConfig& config);

/** Its folder, in which RunExperiment runs it. @throws as PrepareExperiment. */
PreparedSession PrepareNumerics(const ExperimentRequest& request);
/** One row per comparison; missing = empty. */
std::string FormatNumericsCsv(const std::vector<NumericsComparison>& comparisons);

/** {variants: [..], flips: [..]}. */
Json MakeNumericsJson(const std::vector<NumericsSummary>& summaries,
                      const std::vector<NumericsComparison>& comparisons);

}  // namespace graspbench
