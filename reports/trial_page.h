#pragma once
/** @file
One trial as one page: what was grasped and how, how it ended and why, pictures, times, contacts. */

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/hand/hand.h"
#include "core/shape/grasp_object.h"
#include "core/trial/trial_trace.h"
#include "datasets/session/trial_record.h"

namespace graspbench {

struct TrialPageData {
  std::shared_ptr<const Hand> hand;
  std::shared_ptr<const GraspObject> object;
  TrialRecord record;                      ///< its plan names hand, object, grasp and the draw
  std::optional<TracedTrial> traced = {};  ///< unset: nobody can carry it out again
  /** A heading and plain text in columns, shown as it is. */
  std::vector<std::pair<std::string, std::string>> cards;
  std::vector<std::string> script;  ///< commands that lead here
};

/** A self-contained page like the session's report. Without a renderer it has no pictures and says
why. @pre the record is of the hand and object; the trial is over. */
std::string MakeTrialPage(const TrialPageData& data);

}  // namespace graspbench
