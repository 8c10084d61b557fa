#include "human_study/statistics/reliability/reliability.h"

#include <algorithm>
#include <cmath>

#include "core/statistics/distributions.h"
#include "core/statistics/summary.h"
#include "human_study/statistics/one_way_anova.h"

namespace graspbench {
namespace {

/** Spearman and Brown, rounded up; an excess that is only rounding does not cost a trial. */
int CountTrials(double icc, double wanted_icc) {
  const double count = wanted_icc * (1.0 - icc) / (icc * (1.0 - wanted_icc));
  return static_cast<int>(std::clamp(std::ceil(count * (1.0 - 1e-12)), 1.0, 1e9));
}

std::vector<double> ListPresent(const std::vector<double>& values) {
  std::vector<double> present;
  for (double value : values) {
    if (!std::isnan(value)) present.push_back(value);
  }
  return present;
}

}  // namespace

Answer<TrialsNeeded> CalcTrialsNeeded(const Icc& single, double wanted_icc) {
  GRASPBENCH_DEMAND(wanted_icc > 0.0 && wanted_icc < 1.0, std::to_string(wanted_icc));
  if (!(single.value > 0.0)) {
    return NoAnswer{"the ICC of one trial is not positive: no number of trials would do"};
  }
  TrialsNeeded needed;
  needed.wanted_icc = wanted_icc;
  needed.num_trials = CountTrials(single.value, wanted_icc);
  needed.fewest = CountTrials(single.interval.high, wanted_icc);
  if (single.interval.low > 0.0) {
    needed.most = CountTrials(single.interval.low, wanted_icc);
  } else {
    needed.most = NoAnswer{"the interval of the ICC reaches 0"};
  }
  return needed;
}

double CalcMinimalDetectableChange(double within_person_sd) {
  return CalcNormalQuantile(0.975) * std::sqrt(2.0) * within_person_sd;
}

Answer<Reliability> CalcReliability(const std::vector<PersonTrials>& persons, double wanted_icc) {
  Reliability result;
  std::vector<std::vector<double>> groups;
  std::vector<double> means;
  for (const PersonTrials& person : persons) {
    std::vector<double> values = ListPresent(person.values);
    result.num_missing += static_cast<int>(person.values.size() - values.size());
    if (values.empty()) continue;
    for (double value : values) {
      if (const std::string fault = FindUnusable(value); !fault.empty()) {
        return NoAnswer{"person \"" + person.person + "\": " + fault};
      }
    }
    means.push_back(CalcMoments(values).mean);
    groups.push_back(std::move(values));
  }
  const Answer<IccPair> one_way = CalcIcc(persons, IccForm::kOneWay);
  if (!one_way) return one_way.none();
  const OneWayAnova anova = *CalcOneWayAnova(groups);
  result.num_persons = anova.num_groups;
  result.num_values = anova.num_values;
  result.mean = CalcMoments(means).mean;
  result.within_person_sd = std::sqrt(anova.ms_within);
  result.within_person_interval = {
      std::sqrt(anova.ss_within / CalcChiSquaredQuantile(0.975, anova.df_within)),
      std::sqrt(anova.ss_within / CalcChiSquaredQuantile(0.025, anova.df_within))};
  result.between_person_sd =
      std::sqrt(std::max(0.0, (anova.ms_between - anova.ms_within) / one_way->average.num_trials));
  result.minimal_detectable_change = CalcMinimalDetectableChange(result.within_person_sd);
  result.one_way = one_way;
  result.agreement = CalcIcc(persons, IccForm::kAgreement);
  result.consistency = CalcIcc(persons, IccForm::kConsistency);
  result.trials_needed = CalcTrialsNeeded(one_way->single, wanted_icc);
  return result;
}

}  // namespace graspbench
