#pragma once
/** @file
Plots of one trial over time: the force of every digit, and all joints. */

#include <string>
#include <vector>

#include "core/hand/hand.h"
#include "core/trial/trial_trace.h"
#include "datasets/records/trial_record.h"
#include "reports/page/html.h"
#include "reports/page/models.h"

namespace graspbench {

/** Draws the forces, then the joints of each digit, then joints outside the digits. Dashed lines
mark the phases. Time is measured from the start of placing. Returns nothing for a trial that could
not begin.
@param name  of the trial, for the titles. */
std::vector<Html> DrawTrialPlots(const Hand& hand, const TracedTrial& traced,
                                 const std::string& name);

/** Draws the phases over the time of the trial, with the time at which a failed trial began to
fail. Empty for a trial that could not begin. */
Html DrawPhaseStrip(const TracedTrial& traced, const std::string& name);

/** Makes one SVG file with all curves, one below the other. @throws Error(kUnsupported) without
curves. */
std::string MakeTrialSvg(const Hand& hand, const TracedTrial& traced, const std::string& name);

/** Draws, as a strip chart, when each link of the hand touched the object in one trial. Empty when
nothing touched. @param name  of the grasped object, for the title. */
Html DrawContactStrip(const TrialRecord& record, const std::string& name,
                      const SessionModels& models);

}  // namespace graspbench
