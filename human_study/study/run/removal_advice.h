#pragma once
/** @file
What a person can do about a removed trial: the curve that shows why it does not count, and the keys
of study.yaml that would change it. Nothing is changed by itself. */

#include <string>

namespace graspbench {

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
