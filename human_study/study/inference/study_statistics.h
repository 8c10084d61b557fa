#pragma once
/** @file
Statistics over the trials of a study: each measure by condition, the main test under every choice,
the reliability of every measure of hand opening, the contact order of the digits, and the bias of
the study's own choices for a known asynchrony. */

#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "core/statistics/proportion.h"
#include "human_study/study/inference/independence_null.h"
#include "human_study/study/inference/measure_statistics.h"
#include "human_study/study/inference/opening_reliability.h"
#include "human_study/study/synthetic/bias_card.h"

namespace graspbench {

struct StudyTrial;
struct StudyResult;

/** The GFT that a study would report if all digits touched simultaneously.

GFT = T_all - T_first is a range: errors of the single contacts cannot make it negative, so they
bias a true zero upwards. Every included trial is resampled repeatedly with its own digits and the
uncertainties of its contacts, which reflect marker positions, gaps, noise, frame rate, filter, push
and speed in this trial. The uncertainty shared by all digits is left out. */
struct ZeroGft {
  int num_trials = 0;                                        ///< trials with at least two contacts
  double median = std::numeric_limits<double>::quiet_NaN();  ///< over trials and draws [s]
  /** 95 % quantile of single trials with a true zero [s]. */
  double limit = std::numeric_limits<double>::quiet_NaN();
};

ZeroGft CalcZeroGft(const std::vector<StudyTrial>& trials);

/** One combination of choices. */
struct Universe {
  std::string onset, detector, opening;
  double cutoff = 0.0;      ///< of the contact detectors [Hz]
  Answer<Summary> summary;  ///< of the main measure over the included trials
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

/** Lists the measures that a study tests and draws: its own list, else the default ones, and those
with a hypothesis. */
std::vector<TrialMeasure> ListStudyMeasures(const Study& study);

/** Lists all combinations of the study's own choices and the multiverse's; the study's own comes
first. */
std::vector<Universe> ListUniverses(const StudyConfig& config);
/** Range of the main measure over the choices, and the number of significant tests. */
struct UniverseSummary {
  int num_values = 0;                      ///< universes with a value
  double lowest = NAN, highest = NAN;      ///< medians of the measure, in its unit
  int num_tests = 0, num_significant = 0;  ///< p < 0.05, Greenhouse-Geisser
  double lowest_p = NAN, highest_p = NAN;
  double lowest_effect = NAN, highest_effect = NAN;  ///< generalised eta squared
};
UniverseSummary SummariseUniverses(const std::vector<Universe>& universes);

/** Returns the study's options under one universe, for a recording with `rate` [Hz]. */
AnalysisOptions MakeOptions(const StudyConfig& config, const Universe& universe, double rate);

/** Makes a table with one row per included trial. */
MeasureTable MakeMeasureTable(const StudyResult& result, const TrialMeasure& measure);

/** Computes `statistics` and the results of the universes from the trials. */
void CalcStudyStatistics(StudyResult& result);

/** Who touched first. */
struct FirstDigits {
  std::string participant;
  std::vector<int> counts;  ///< by digit, of trials in which it alone touched first; last: ties
};

/** Counts over the trials in which both digits touched. */
struct Precedence {
  int num_before = 0, num_both = 0;
  double share() const { return CalcShare(num_before, num_both); }
};

struct OrderCount {
  std::string order;  ///< "TH=FF<MF", tied digits in the order of the hand
  int count = 0;
  double share = 0.0;
};

/** The contact order of the digits over the included trials. Ties are orders that the recording
does not resolve (core/grasp/contact_timing.h). */
struct OrderSummary {
  std::vector<FirstDigits> first;
  std::vector<std::vector<Precedence>> precedence;  ///< [a][b]: digit a before digit b
  std::vector<OrderCount> orders;                   ///< most frequent first
  int num_ties = 0, num_neighbours = 0;             ///< pairs of digits with consecutive contacts
};

/** Summarises the orders, with digits in the order of `result.digits`. */
OrderSummary SummariseOrders(const StudyResult& result);

}  // namespace graspbench
