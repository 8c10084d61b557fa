#pragma once
/** @file
What others have measured, to stand beside a study's own numbers: an expectation for healthy adults
who reach for things on a table, never a criterion. */

#include <string>
#include <vector>

#include "core/statistics/summary.h"
#include "human_study/events/trial_analysis.h"
#include "human_study/statistics/line_fit.h"

namespace graspbench {

struct StudyResult;

struct PublishedValue {
  const char* measure;   ///< id of TrialMeasureList()
  bool is_slope;         ///< over a factor with numbers, not the measure itself
  const char* unit_end;  ///< of a slope: how the factor's name ends ("_m" of a size, "_kg")
  const char* text;      ///< what was found
  const char* source;
};

const std::vector<PublishedValue>& PublishedValueList();

/** A study's own number for a published one. */
struct ComparedValue {
  const PublishedValue* published = nullptr;
  const TrialMeasure* measure = nullptr;
  Answer<Summary> summary;  ///< of the measure over the trials that count
  std::string factor;       ///< of a slope; else empty
  PersonSlopes slopes;      ///< over it, tested against 0
};
/** Those that the study can say something about, in the order of the list. */
std::vector<ComparedValue> ComparePublished(const StudyResult& result);

}  // namespace graspbench
