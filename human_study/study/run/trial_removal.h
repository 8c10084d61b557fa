#pragma once
/** @file
Reasons for removing trials, possible problems of included ones, and advice for the user. */

#include <string>
#include <utility>
#include <vector>

#include "human_study/events/trial_analysis.h"
#include "human_study/study/design/study_config.h"

namespace graspbench {

struct StudyTrial;
struct StudyResult;

/** A reason with its code. Codes besides those of plausibility.h: left_out (by the experimenter, in
trials.csv), unreadable, missing_marker, same_recording (a copy of another trial), no_reach,
no_onset, no_hold, no_opening, no_contact, not_usable (a contact without any bound), filled_event,
gap_event, disagreement. */
struct Removal {
  std::string code;
  std::string text;  ///< empty: the trial is included
};

/** Applies the study's rules to an analysed trial. */
Removal FindRemoval(const TrialAnalysis& analysis, const RemovalConfig& rules);

struct RemovalGroup {
  std::string code;
  std::string text;                 ///< with the range of numbers that differ between the trials
  std::vector<std::string> trials;  ///< ids, in the order of the plan
};

/** Groups removed trials by reason, most frequent first; texts that differ only in numbers are one
reason. */
std::vector<RemovalGroup> GroupRemoved(const std::vector<StudyTrial>& trials);

struct FindingGroup {
  std::string code;
  std::string text;  ///< with the range of numbers that differ between the findings
  int count = 0;
  std::vector<std::string> files;
};
/** Groups the findings made when reading files, in the order of the first file; texts that differ
only in numbers are one. */
std::vector<FindingGroup> GroupFindings(const StudyResult& result);

/** Merges texts that differ only in numbers: these become "3..45", and parts of names (trial-3) an
ellipsis. @pre `texts` is not empty. */
std::string MergeNumbers(const std::vector<std::string>& texts);

/** A possible problem of an included trial. */
struct TrialFlag {
  const char* name;  ///< "filled"; shown beside a trial
  const char* text;  ///< a sentence for tables
  bool (*is_set)(const TrialAnalysis& analysis);
};

const std::vector<TrialFlag>& TrialFlagList();

/** Formats the names of the flags set, separated by commas; empty: none. */
std::string FormatFlags(const TrialAnalysis& analysis);

struct FlagCount {
  const TrialFlag* flag = nullptr;
  int count = 0;       ///< included trials with this flag
  double share = 0.0;  ///< of the included trials; NaN without any
};
/** Counts flags, in the order of TrialFlagList(). */
std::vector<FlagCount> CountFlags(const StudyResult& result);

/** Finds a representative trial: an included one, without flags if possible, whose GFT is nearest
to the median; null without included trials. */
const StudyTrial* FindGoodTrial(const StudyResult& result);

/** Contacts in included trials that are indicated only by the digit's stop. */
struct UnverifiedTouches {
  int num_contacts = 0, num_trials = 0;
};
UnverifiedTouches CountUnverified(const StudyResult& result);

/** Advice on a removed trial: the curve that shows the reason, and the keys of study.yaml that
would change it. No key is changed automatically. */
enum class RemovalCurve {
  kNone,     ///< no curve: files, markers, tables
  kSpeed,    ///< speed of the wrist with the threshold of the onset
  kOpening,  ///< opening of the hand with the contacts
};

struct RemovalAdvice {
  const char* code;  ///< of Removal
  RemovalCurve curve;
  const char* keys;  ///< keys that would change it and their effect; for the user
};

/** Finds the advice for a code of trial_removal.h or plausibility.h; for other codes, how to
include doubted trials. */
const RemovalAdvice& FindRemovalAdvice(const std::string& code);

/** Finds the parts of that advice that name no limit and no rule of the analysis: what the user can
check or measure where no setting helps. Empty when there are none. */
std::string FindAdviceBeyondSettings(const std::string& code);

}  // namespace graspbench
