#pragma once
/** @file
A grasp that closes as people do: the closing schedule of a study's contact times, as `graspbench
new grasp --timing` writes it. A digit's delay is the median over the trials that count, of how long
after the trial's first contact it touched, less that of the digit with the least. Only trials count
in which all digits of the grasp touched. */

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/grasp/standard_grasp.h"

namespace graspbench {

/** Of a study's folder, its trials.csv and events.csv.
@param digits  of the grasp: "TH", "FF", ..
@throws Error(kNotFound) when there is no study; Error(kFormat) for damaged tables; Error(kUsage) for
digits that the study has no contact of, a study without a trial that counts and in which all
touched, and a lag with which a digit would stay open for good. */
std::map<std::string, ClosingSchedule> ReadStudyTiming(const std::filesystem::path& study,
                                                       const std::vector<std::string>& digits);

/** The grasp file of a standard grasp. @param study  empty: it closes as the hand does.
@throws Error(kNotFound) for the hand or the grasp; as ReadStudyTiming. */
std::string MakeTimedGrasp(const std::string& hand, const std::string& grasp,
                           const std::filesystem::path& study);

}  // namespace graspbench
