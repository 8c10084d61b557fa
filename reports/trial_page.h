#pragma once
/** @file
The page of one trial: object and grasp, outcome and reason, pictures, times, contacts. */

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
  TrialRecord record;                      ///< its plan names hand, object, grasp and draw
  std::string name = {};                   ///< "tum-can-g3:2"; empty: not from a session
  std::optional<TracedTrial> traced = {};  ///< unset: it cannot be simulated again
  /** Pairs of a heading and preformatted text. */
  std::vector<std::pair<std::string, std::string>> cards;
  std::vector<std::string> script;              ///< shell commands that reproduce the trial
  std::vector<std::string> commands = {};       ///< that reproduce the page
  std::vector<std::string> warnings = {};       ///< sentences for the reader
  std::optional<Explanation> explanation = {};  ///< of a failure: what would have held the object
};

/** Makes a self-contained page like the session's report. Without a renderer it has no pictures and
says why. @pre the record belongs to the setup; the trial is over. */
std::string MakeTrialPage(const TrialPageData& data);

}  // namespace graspbench
