#include "human_study/statistics/reliability/reliability.h"

#include <algorithm>
#include <cmath>
#include <limits>

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
  bool is_positive = true;
  for (const PersonTrials& person : persons) {
    std::vector<double> values = ListPresent(person.values);
    result.num_missing += static_cast<int>(person.values.size() - values.size());
    if (values.empty()) continue;
    for (double value : values) {
      if (std::isinf(value))
        return NoAnswer{"person \"" + person.person + "\": a value is infinite"};
      is_positive = is_positive && value > 0.0;
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
  if (is_positive) {
    result.within_person_cv = result.within_person_sd / result.mean;
  } else {
    result.within_person_cv = NoAnswer{"a value is not positive"};
  }
  result.minimal_detectable_change = CalcMinimalDetectableChange(result.within_person_sd);
  result.one_way = one_way;
  result.agreement = CalcIcc(persons, IccForm::kAgreement);
  result.consistency = CalcIcc(persons, IccForm::kConsistency);
  result.trials_needed = CalcTrialsNeeded(one_way->single, wanted_icc);
  return result;
}

Answer<BootstrapInterval> CompareReliability(const std::vector<PersonTrials>& a,
                                             const std::vector<PersonTrials>& b,
                                             const std::string& id) {
  GRASPBENCH_DEMAND(a.size() == b.size(),
                    std::to_string(a.size()) + " and " + std::to_string(b.size()));
  const auto draw = [](const std::vector<PersonTrials>& from, const std::vector<size_t>& persons) {
    std::vector<PersonTrials> drawn;
    for (size_t person : persons) drawn.push_back(from[person]);
    return drawn;
  };
  return CalcBootstrap(
      a.size(),
      [&](const std::vector<size_t>& persons) {
        const Answer<double> of_a = CalcSingleIcc(draw(a, persons));
        const Answer<double> of_b = CalcSingleIcc(draw(b, persons));
        return of_a && of_b ? *of_a - *of_b : std::numeric_limits<double>::quiet_NaN();
      },
      id);
}

PrecisionLoss CalcPrecisionLoss(const Answer<Reliability>& full,
                                const Answer<Reliability>& reduced) {
  PrecisionLoss loss;
  if (!full || !reduced) {
    const NoAnswer none = full ? reduced.none() : full.none();
    loss.cv_ratio = none;
    loss.icc_change = none;
    return loss;
  }
  if (full->within_person_cv && reduced->within_person_cv) {
    loss.cv_ratio = *reduced->within_person_cv / *full->within_person_cv;
  } else {
    loss.cv_ratio =
        full->within_person_cv ? reduced->within_person_cv.none() : full->within_person_cv.none();
  }
  loss.icc_change = reduced->one_way->single.value - full->one_way->single.value;
  return loss;
}

Answer<Separation> CalcSeparation(const std::vector<double>& all_open,
                                  const std::vector<double>& all_closed) {
  const std::vector<double> open = ListPresent(all_open), closed = ListPresent(all_closed);
  if (open.size() < 2 || closed.size() < 2) {
    return NoAnswer{std::to_string(open.size()) + " open and " + std::to_string(closed.size()) +
                    " closed trials; expected 2 or more of each"};
  }
  const Answer<OneWayAnova> anova = CalcOneWayAnova({open, closed});
  if (!anova) return anova.none();
  Separation result;
  result.num_open = static_cast<int>(open.size());
  result.num_closed = static_cast<int>(closed.size());
  result.difference = CalcMoments(open).mean - CalcMoments(closed).mean;
  result.pooled_sd = std::sqrt(anova->ms_within);
  result.d_prime = result.difference / result.pooled_sd;
  const double error =
      std::sqrt(1.0 / result.num_open + 1.0 / result.num_closed +
                result.d_prime * result.d_prime / (2.0 * (result.num_open + result.num_closed)));
  const double half_width = CalcNormalQuantile(0.975) * error;
  result.interval = {result.d_prime - half_width, result.d_prime + half_width};
  return result;
}

}  // namespace graspbench
