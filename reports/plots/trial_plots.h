#pragma once
/** @file
The course of one trial as curves over time: what every digit presses with, and all joints. */

#include <string>
#include <vector>

#include "core/hand/hand.h"
#include "core/trial/trial_trace.h"
#include "datasets/records/trial_record.h"
#include "reports/page/html.h"
#include "reports/page/models.h"

namespace graspbench {

/** Forces first, then the joints of each digit, then those that are no digit's. Dashed lines: the
phases. Times count from the start of placing.
@param name  of the trial, for the titles. Empty for a trial that could not begin. */
std::vector<Html> DrawTrialPlots(const Hand& hand, const TracedTrial& traced,
                                 const std::string& name);

/** The phases side by side over the time of the trial, with the time at which a failed trial began
to fail. Empty for a trial that could not begin. */
Html DrawPhaseStrip(const TracedTrial& traced, const std::string& name);

/** The curves below each other as one SVG file. @throws Error(kUnsupported) where there is nothing.
*/
std::string MakeTrialSvg(const Hand& hand, const TracedTrial& traced, const std::string& name);

/** When each link of the hand touched the object in one trial, as a strip chart.
Empty when nothing touched. @param name  of what is grasped, for the title. */
Html DrawContactStrip(const TrialRecord& record, const std::string& name,
                      const SessionModels& models);

}  // namespace graspbench
