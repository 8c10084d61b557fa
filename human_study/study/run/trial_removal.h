#pragma once
/** @file
Why a trial does not count. */

#include <string>
#include <utility>
#include <vector>

#include "human_study/study/design/study_config.h"

namespace graspbench {

struct StudyTrial;
struct StudyResult;

/** A reason with its code. Besides those of plausibility.h: left_out (by a person, in trials.csv),
unreadable, missing_marker, same_recording (a copy of another trial), no_reach, no_onset, no_hold,
no_opening, no_contact, not_usable (a contact known too badly), filled_event, gap_event,
disagreement. */
struct Removal {
  std::string code;
  std::string text;  ///< empty: the trial counts
};

/** What the study's rules say about an analysed trial. */
Removal FindRemoval(const TrialAnalysis& analysis, const RemovalConfig& rules);

struct RemovalGroup {
  std::string code;
  std::string text;                 ///< with the range of numbers that differ between the trials
  std::vector<std::string> trials;  ///< ids, in the order of the plan
};

/** Trials that do not count by their reason, most frequent first; texts that differ in numbers
alone are one reason. */
std::vector<RemovalGroup> GroupRemoved(const std::vector<StudyTrial>& trials);

struct FindingGroup {
  std::string code;
  std::string text;  ///< with the range of numbers that differ between the findings
  int count = 0;
  std::vector<std::string> files;
};
/** What had to be assumed to read the files, in the order of the first file; texts that differ in
numbers alone are one. */
std::vector<FindingGroup> GroupFindings(const StudyResult& result);

/** One text for several that differ in their numbers alone, which become "3..45"; parts of names
(trial-3) become an ellipsis. @pre not empty. */
std::string MergeNumbers(const std::vector<std::string>& texts);

}  // namespace graspbench
