#pragma once
/** @file
First contacts of people, from the tables of a study's folder as graspbench study run writes it. */

#include <filesystem>
#include <vector>

#include "datasets/analysis/schedules/touch_lags.h"

namespace graspbench {

/** Of the trials that count, in the order of trials.csv: the object, the start of closure, and the
digits whose contact is found, or of which it is known that they never touched.
@throws Error(kNotFound) when there is no study; Error(kFormat) for damaged tables. */
std::vector<TrialTouches> ReadStudyTouches(const std::filesystem::path& study);

}  // namespace graspbench
