#pragma once
/** @file
Why a trial does not count, what may be doubtful about one that does, and what a person can do. */

#include <string>
#include <utility>
#include <vector>

#include "human_study/events/trial_analysis.h"
#include "human_study/study/design/study_config.h"

namespace graspbench {

struct StudyTrial;
struct StudyResult;

/** A reason with its code. Besides those of plausibility.h: left_out (by a person, in trials.csv),
unreadable, missing_marker, same_recording (a copy of another trial), no_reach, no_onset, no_hold,
no_opening, no_contact, not_usable (a contact without any bound), filled_event, gap_event,
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

/** What may be doubtful about an included trial. */
struct TrialFlag {
  const char* name;  ///< "filled", beside a trial
  const char* text;  ///< a sentence for tables
  bool (*is_set)(const TrialAnalysis& analysis);
};

const std::vector<TrialFlag>& TrialFlagList();

/** Names of those set, with commas; empty: none. */
std::string FormatFlags(const TrialAnalysis& analysis);

struct FlagCount {
  const TrialFlag* flag = nullptr;
  int count = 0;       ///< included trials with it
  double share = 0.0;  ///< of the included trials; NaN without any
};
/** In the order of TrialFlagList(). */
std::vector<FlagCount> CountFlags(const StudyResult& result);

/** The trial to begin with: one that counts, without a flag if there is one, whose GFT is nearest
to the median; null when none counts. */
const StudyTrial* FindGoodTrial(const StudyResult& result);

/** Contacts that only the digit's own stop shows, in included trials. */
struct UnverifiedTouches {
  int num_contacts = 0, num_trials = 0;
};
UnverifiedTouches CountUnverified(const StudyResult& result);

/** What a person can do about a removed trial: the curve that shows why it does not count, and the
keys of study.yaml that would change it. Nothing is changed by itself. */
enum class RemovalCurve {
  kNone,     ///< no curve shows it: files, markers, tables
  kSpeed,    ///< speed of the wrist with the threshold of the onset
  kOpening,  ///< opening of the hand with the contacts
};

struct RemovalAdvice {
  const char* code;  ///< of Removal
  RemovalCurve curve;
  const char* keys;  ///< what would change it, and what that means; for a person
};

/** Advice for a code of trial_removal.h or plausibility.h; for one without any of its own, how
doubted trials are kept. */
const RemovalAdvice& FindRemovalAdvice(const std::string& code);

/** The parts of that advice that name no limit and no rule of the analysis: what a person can look
at or measure where no setting helps. Empty when all of them do. */
std::string FindAdviceBeyondSettings(const std::string& code);

}  // namespace graspbench
