#pragma once
/** @file
What the trials of a study say together: each measure by condition, the main test under every
choice, the reliability of every measure of hand opening, and what the study's own choices do to a
known asynchrony. */

#include <cmath>
#include <string>
#include <vector>

#include "human_study/study/inference/independence_null.h"
#include "human_study/study/inference/measure_statistics.h"
#include "human_study/study/inference/opening_reliability.h"
#include "human_study/study/inference/published_values.h"
#include "human_study/study/inference/zero_gft.h"
#include "human_study/study/synthetic/bias_card.h"

namespace graspbench {

struct StudyResult;

/** One combination of choices. */
struct Universe {
  std::string onset, detector, opening;
  double cutoff = 0.0;      ///< of the contact detectors [Hz]
  Answer<Summary> summary;  ///< of the main measure over the kept trials
  Answer<WithinTest> test;  ///< of the first factor
  bool is_own = false;      ///< the study's own choices
};

/** The chosen opening from the onset (0) to the last contact (1), over the trials of one cell. */
struct OpeningCurve {
  std::string cell;
  int num_trials = 0;
  std::vector<double> times;  ///< 0..1
  std::vector<double> mean;   ///< [m], as low and high: mean -+ SD; NaN where no trial has a value
  std::vector<double> low, high;
};

struct StudyStatistics {
  std::vector<MeasureStatistics> measures;
  std::vector<OpeningCurve> curves;
  OpeningFamily openings;
  std::vector<BiasRow> bias;
  std::vector<ComparedValue> published;
  ZeroGft zero_gft;
  Answer<IndependenceNull> independence;
};

/** @pre the id is one of TrialMeasureList(). */
const TrialMeasure& FindMeasure(const std::string& id);

/** The measures a study tests and draws: its own list, else the usual ones, and those that it has a
hypothesis about. */
std::vector<TrialMeasure> ListStudyMeasures(const Study& study);

/** All combinations of the study's own choices and the multiverse's; its own come first. */
std::vector<Universe> ListUniverses(const StudyConfig& config);
/** How far the choices move the main measure, and in how many its test says the same. */
struct UniverseSummary {
  int num_values = 0;                      ///< universes with a value
  double lowest = NAN, highest = NAN;      ///< medians of the measure, in its unit
  int num_tests = 0, num_significant = 0;  ///< p < 0.05, Greenhouse-Geisser
  double lowest_p = NAN, highest_p = NAN;
  double lowest_effect = NAN, highest_effect = NAN;  ///< generalised eta squared
};
UniverseSummary SummariseUniverses(const std::vector<Universe>& universes);

/** The study's options under one of them, for a recording of `rate` [Hz]. */
AnalysisOptions MakeOptions(const StudyConfig& config, const Universe& universe, double rate);

/** A row a kept trial. */
MeasureTable MakeMeasureTable(const StudyResult& result, const TrialMeasure& measure);

/** Fills `statistics` and the results of the universes from the trials. */
void CalcStudyStatistics(StudyResult& result);

}  // namespace graspbench
