#include "human_study/synthetic/bias_card.h"

#include <algorithm>
#include <cmath>

#include "core/statistics/summary.h"

namespace graspbench {
namespace {

constexpr int kNumPeople = 5;

double CalcMean(const std::vector<double>& values) {
  return values.empty() ? std::nan("") : CalcMoments(values).mean;
}

double CalcSd(const std::vector<double>& values) {
  if (values.size() < 2) return std::nan("");
  return std::sqrt(CalcMoments(values).sum_of_squares / static_cast<double>(values.size() - 1));
}

}  // namespace

BiasRow CalcBiasRow(const std::vector<SyntheticTrial>& trials, const AnalysisOptions& options) {
  BiasRow row;
  std::vector<double> gfts, true_gfts, errors;
  int num_covered = 0;
  for (const SyntheticTrial& trial : trials) {
    const TrialAnalysis analysis = AnalyseTrial(MakeReachTrial(trial), options);
    ++row.num_trials;
    const std::vector<double>& truth = trial.truth.contacts;
    true_gfts.push_back(*std::max_element(truth.begin(), truth.end()) -
                        *std::min_element(truth.begin(), truth.end()));
    if (std::isnan(analysis.timing_all.gft)) {
      ++row.num_missing;
    } else {
      gfts.push_back(analysis.timing_all.gft);
    }
    for (size_t d = 0; d < truth.size(); ++d) {
      const EventTime& contact = analysis.contacts[d].contact;
      if (!contact.IsFound()) continue;
      errors.push_back(contact.time - truth[d]);
      num_covered += std::abs(contact.time - truth[d]) <= 1.96 * contact.uncertainty;
    }
  }
  row.true_gft = CalcMean(true_gfts);
  row.mean_gft = CalcMean(gfts);
  row.sd_gft = CalcSd(gfts);
  row.contact_bias = CalcMean(errors);
  row.contact_sd = CalcSd(errors);
  row.coverage = errors.empty() ? std::nan("") : num_covered / static_cast<double>(errors.size());
  return row;
}

std::vector<BiasRow> CalcBiasCard(const std::vector<BiasCase>& cases,
                                  const std::vector<double>& true_gfts, int num_trials,
                                  const std::string& seed) {
  std::vector<BiasRow> rows;
  for (const BiasCase& bias_case : cases) {
    for (const double true_gft : true_gfts) {
      SyntheticOptions synthetic;
      synthetic.seed = seed;
      synthetic.num_people = kNumPeople;
      const int trials_per_round = kNumPeople * static_cast<int>(synthetic.diameters.size());
      synthetic.trials_per_size = (num_trials + trials_per_round - 1) / trials_per_round;
      synthetic.rate = bias_case.rate;
      synthetic.noise = bias_case.noise;
      synthetic.forming_time = true_gft;
      synthetic.has_force = bias_case.options.contact.detector == "force";
      rows.push_back(CalcBiasRow(MakeSyntheticStudy(synthetic), bias_case.options));
      rows.back().text = bias_case.text;
    }
  }
  return rows;
}

}  // namespace graspbench
