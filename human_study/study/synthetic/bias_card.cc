#include "human_study/study/synthetic/bias_card.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

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

/** Trials as recorded and as analysed; what several rows share. */
class BiasTrials {
 public:
  BiasTrials(std::vector<SyntheticTrial> trials, bool has_object) : trials_(std::move(trials)) {
    for (const SyntheticTrial& trial : trials_) {
      reaches_.push_back(MakeReachTrial(trial));
      if (!has_object) reaches_.back().object = ObjectTrack();
    }
    for (const ReachTrial& reach : reaches_) filtered_.emplace_back(reach);
  }

  BiasTrials(const BiasTrials&) = delete;  // the filtered trials refer to the others
  BiasTrials& operator=(const BiasTrials&) = delete;

  BiasRow CalcRow(const AnalysisOptions& options);

 private:
  std::vector<SyntheticTrial> trials_;
  std::vector<ReachTrial> reaches_;
  std::vector<FilteredTrial> filtered_;
};

BiasRow BiasTrials::CalcRow(const AnalysisOptions& options) {
  BiasRow row;
  std::vector<double> gfts, true_gfts, errors;
  int num_covered = 0;
  for (size_t i = 0; i < trials_.size(); ++i) {
    const TrialAnalysis analysis = AnalyseTrial(filtered_[i], options);
    ++row.num_trials;
    const std::vector<double>& truth = trials_[i].truth.contacts;
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
      num_covered += std::abs(contact.time - truth[d]) <= contact.CalcHalfWidth();
    }
  }
  row.true_gft = CalcMean(true_gfts);
  row.mean_gft = CalcMean(gfts);
  row.sd_gft = CalcSd(gfts);
  row.contact_bias = CalcMean(errors);
  row.contact_sd = CalcSd(errors);
  row.coverage = CalcShare(num_covered, static_cast<int64_t>(errors.size()));
  return row;
}

SyntheticOptions MakeSyntheticOptions(const BiasCase& bias_case, double true_gft, int num_trials,
                                      const std::string& seed) {
  SyntheticOptions synthetic;
  synthetic.seed = seed;
  synthetic.num_people = kNumPeople;
  const int trials_per_round = kNumPeople * static_cast<int>(synthetic.diameters.size());
  synthetic.trials_per_size = (num_trials + trials_per_round - 1) / trials_per_round;
  synthetic.rate = bias_case.rate;
  synthetic.noise = bias_case.noise;
  synthetic.forming_time = true_gft;
  synthetic.num_digits = bias_case.num_digits;
  synthetic.lifts = bias_case.lifts;
  synthetic.has_force = bias_case.options.contact.detector == "force";
  return synthetic;
}

}  // namespace

BiasRow CalcBiasRow(const std::vector<SyntheticTrial>& trials, const AnalysisOptions& options,
                    bool has_object) {
  return BiasTrials(trials, has_object).CalcRow(options);
}

std::vector<BiasRow> CalcBiasCard(const std::vector<BiasCase>& cases,
                                  const std::vector<double>& true_gfts, int num_trials,
                                  const std::string& seed) {
  std::vector<BiasRow> rows(cases.size() * true_gfts.size());
  for (size_t g = 0; g < true_gfts.size(); ++g) {
    // Cases that were recorded alike see the same trials.
    std::map<std::tuple<double, double, int, bool, bool, bool>, BiasTrials> recorded;
    for (size_t c = 0; c < cases.size(); ++c) {
      const SyntheticOptions synthetic =
          MakeSyntheticOptions(cases[c], true_gfts[g], num_trials, seed);
      const bool has_object = cases[c].has_object;
      const auto key = std::make_tuple(synthetic.rate, synthetic.noise, synthetic.num_digits,
                                       synthetic.lifts, synthetic.has_force, has_object);
      auto trials = recorded.find(key);
      if (trials == recorded.end()) {
        trials = recorded.try_emplace(key, MakeSyntheticStudy(synthetic), has_object).first;
      }
      BiasRow& row = rows[c * true_gfts.size() + g];
      row = trials->second.CalcRow(cases[c].options);
      row.text = cases[c].text;
    }
  }
  return rows;
}

}  // namespace graspbench
