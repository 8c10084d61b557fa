#pragma once
/** @file
A grasp whose closing schedule follows the contact times of a human study, as `graspbench new grasp
--timing` writes it. A digit's lag is the median, over the included trials, of its contact time
after the trial's first contact, minus the smallest such median of all digits. Only trials in which
all digits of the grasp touched are used.

With an object, the digits touch it with these lags (core/trial/digit_delays.h). Without an object,
a lag delays the onset of the digit's closing; if its path is longer or shorter than the others',
its contact lag differs. */

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/grasp/standard_grasp.h"
#include "datasets/analysis/schedules/schedule_comparison.h"

namespace graspbench {

/** Computes each digit's lag [s] from trials.csv and events.csv in a study's folder.
@param digits  of the grasp: "TH", "FF", ..
@throws Error(kNotFound) when there is no study; Error(kFormat) for damaged tables; Error(kUsage)
for digits without any contact in the study, when no included trial has contacts of all digits, and
for a lag so large that a digit would never close. */
std::map<std::string, double> ReadStudyLags(const std::filesystem::path& study,
                                            const std::vector<std::string>& digits);

struct TimedGraspOptions {
  std::string hand, grasp;
  std::filesystem::path study;  ///< empty: the hand's own closing schedule
  std::string object;           ///< id or folder; empty: no particular object
};
struct TimedGrasp {
  std::string file;     ///< content of the grasp file
  std::string summary;  ///< one line: how well it follows the study; empty without an object
};

/** Makes the grasp file of a standard grasp.
@throws Error(kNotFound) for the hand, the grasp or the object; Error(kUsage) for an object that not
all digits of the grasp touch; as ReadStudyLags. */
TimedGrasp MakeTimedGrasp(const TimedGraspOptions& options);

/** Reads people's first contacts from the tables of a folder written by graspbench study run.
Returns the included trials in the order of trials.csv: the object, the start of closure, and the
digits whose contact was found or that are known never to have touched.
@throws Error(kNotFound) when there is no study; Error(kFormat) for damaged tables. */
std::vector<TrialTouches> ReadStudyTouches(const std::filesystem::path& study);

}  // namespace graspbench
