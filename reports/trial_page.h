#pragma once
/** @file
One trial as one page: what was grasped and how, how it ended and why, pictures, times, contacts. */

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/trial/remedies.h"
#include "core/trial/trial_setup.h"
#include "core/trial/trial_trace.h"
#include "datasets/records/trial_record.h"

namespace graspbench {

struct TrialPageData {
  TrialSetup setup;
  TrialRecord record;                      ///< its plan names hand, object, grasp and the draw
  std::string name = {};                   ///< "tum-can-g3:2"; empty: of no session
  std::optional<TracedTrial> traced = {};  ///< unset: nobody can carry it out again
  /** A heading and plain text in columns, shown as it is. */
  std::vector<std::pair<std::string, std::string>> cards;
  std::vector<std::string> script;              ///< lines of the shell that lead here
  std::vector<std::string> commands = {};       ///< that make the page again
  std::vector<std::string> warnings = {};       ///< what a reader must know, as sentences
  std::optional<Explanation> explanation = {};  ///< of a failure: what would have held
};

/** A self-contained page like the session's report. Without a renderer it has no pictures and says
why. @pre the record is of the setup; the trial is over. */
std::string MakeTrialPage(const TrialPageData& data);

}  // namespace graspbench
