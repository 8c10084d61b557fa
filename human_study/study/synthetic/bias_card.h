#pragma once
/** @file
Bias of a study's analysis for a known asynchrony: trials with this GFT are synthesised at the
study's rate and noise, analysed with the study's options, and compared with the truth. */

#include <string>
#include <vector>

#include "core/statistics/proportion.h"
#include "human_study/events/trial_analysis.h"
#include "human_study/study/synthetic/synthetic_study.h"

namespace graspbench {

struct BiasCase {
  std::string text;  ///< for the table: "this study", "cut-off 6 Hz"
  double rate = 200.0;
  double noise = 0.0003;
  int num_digits = 5;
  bool lifts = true;       ///< SyntheticOptions::lifts
  bool has_object = true;  ///< the object was recorded
  AnalysisOptions options;
};

struct BiasRow {
  std::string text;
  double true_gft = 0.0;  ///< [s]
  int num_trials = 0;
  int num_missing = 0;    ///< trials without a GFT
  double mean_gft = 0.0;  ///< [s] over the trials with a GFT, as all below
  double sd_gft = 0.0;
  double contact_bias = 0.0;  ///< mean of found - true contact time, over all digits [s]
  double contact_sd = 0.0;    ///< SD of that [s]
  /** Share of contacts whose error lies within their stated 95 % interval; ideally 0.95. */
  double coverage = 0.0;

  double gft_error() const { return mean_gft - true_gft; }  ///< [s]
  /** Range of the GFT error, one standard deviation over trials to either side [s]. */
  Interval gft_error_range() const { return {gft_error() - sd_gft, gft_error() + sd_gft}; }
};

/** Analyses the trials and compares the results with their truth. `text` stays empty.
@param has_object  false: the object is hidden from the analysis. */
BiasRow CalcBiasRow(const std::vector<SyntheticTrial>& trials, const AnalysisOptions& options,
                    bool has_object = true);

/** Computes one row per case and asynchrony. @param num_trials  rounded up to a multiple of 20:
five people, four sizes.
@param seed  common to all rows, so that they differ only by the case. */
std::vector<BiasRow> CalcBiasCard(const std::vector<BiasCase>& cases,
                                  const std::vector<double>& true_gfts, int num_trials,
                                  const std::string& seed);

}  // namespace graspbench
