#pragma once
/** @file
A grasp that closes as people do: the closing schedule of a study's contact times, as `graspbench
new grasp --timing` writes it. A digit's lag is the median over the included trials, of how long
after the trial's first contact it touched, less that of the digit with the least. Only trials count
in which all digits of the grasp touched.

With an object, the digits touch it with these lags (core/trial/digit_delays.h). Without, a lag is a
digit's delay: it begins to close so much later, and where its way is longer or shorter than the
others' it touches at another time. */

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/grasp/standard_grasp.h"
#include "datasets/analysis/schedules/schedule_comparison.h"

namespace graspbench {

/** Of a study's folder, its trials.csv and events.csv: each digit's lag [s].
@param digits  of the grasp: "TH", "FF", ..
@throws Error(kNotFound) when there is no study; Error(kFormat) for damaged tables; Error(kUsage)
for digits that the study has no contact of, a study without an included trial and in which all
touched, and a lag with which a digit would stay open for good. */
std::map<std::string, double> ReadStudyLags(const std::filesystem::path& study,
                                            const std::vector<std::string>& digits);

struct TimedGraspOptions {
  std::string hand, grasp;
  std::filesystem::path study;  ///< empty: it closes as the hand does
  std::string object;           ///< id or folder; empty: on none in particular
};
struct TimedGrasp {
  std::string file;     ///< content of the grasp file
  std::string summary;  ///< how well it follows the study, a line; empty without an object
};

/** The grasp file of a standard grasp.
@throws Error(kNotFound) for the hand, the grasp or the object; Error(kUsage) for an object on which
the grasp's digits do not all touch; as ReadStudyLags. */
TimedGrasp MakeTimedGrasp(const TimedGraspOptions& options);

/** First contacts of people, from the tables of a study's folder as graspbench study run writes it:
of the included trials, in the order of trials.csv: the object, the start of closure, and the
digits whose contact is found, or of which it is known that they never touched.
@throws Error(kNotFound) when there is no study; Error(kFormat) for damaged tables. */
std::vector<TrialTouches> ReadStudyTouches(const std::filesystem::path& study);

}  // namespace graspbench
