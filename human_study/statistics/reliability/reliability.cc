#include "human_study/statistics/reliability/reliability.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "core/base/text/text.h"
#include "core/statistics/distributions.h"
#include "core/statistics/summary.h"
#include "human_study/statistics/within_anova.h"

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

namespace {

/** The ratio (f - 1) / (f + k - 1), which all single-trial forms share. */
double CalcShare(double f, double k) { return (f - 1.0) / (f + k - 1.0); }

/** Spearman and Brown: from one trial to the mean of k; unbounded where that has no meaning. */
double ScaleToMean(double single, double k) {
  const double divisor = 1.0 + (k - 1.0) * single;
  return divisor > 0.0 ? k * single / divisor : -std::numeric_limits<double>::infinity();
}

IccPair MakePair(IccForm form, double k, double value, Interval interval) {
  IccPair pair;
  pair.single = {form, 1.0, value, interval};
  pair.average = {form,
                  k,
                  ScaleToMean(value, k),
                  {ScaleToMean(interval.low, k), ScaleToMean(interval.high, k)}};
  return pair;
}

/** Exact for a ratio f of mean squares whose expectations differ by the persons' variance. */
Interval CalcInterval(double f, double k, double df_1, double df_2) {
  return {CalcShare(f / CalcFisherQuantile(0.975, df_1, df_2), k),
          CalcShare(f * CalcFisherQuantile(0.975, df_2, df_1), k)};
}

struct OneWay {
  OneWayAnova anova;
  double k = 0.0;
  double harmonic_size = 0.0;
  double icc = 0.0;
  std::vector<double> means;
};

Answer<OneWay> CalcOneWay(const std::vector<PersonTrials>& persons) {
  OneWay result;
  std::vector<std::vector<double>> groups;
  double sum_of_squared_sizes = 0.0, sum_of_inverse_sizes = 0.0;
  bool has_repeats = false;
  for (const PersonTrials& person : persons) {
    std::vector<double> values;
    for (double value : person.values) {
      if (!std::isnan(value)) values.push_back(value);
    }
    if (values.empty()) continue;
    const double size = static_cast<double>(values.size());
    sum_of_squared_sizes += size * size;
    sum_of_inverse_sizes += 1.0 / size;
    has_repeats = has_repeats || values.size() > 1;
    result.means.push_back(CalcMoments(values).mean);
    groups.push_back(std::move(values));
  }
  if (groups.size() < 2) {
    return NoAnswer{FormatCount(groups.size(), "person") + " with a value; expected 2 or more"};
  }
  if (!has_repeats) return NoAnswer{"no person has two trials"};
  const Answer<OneWayAnova> anova = CalcMeanSquares(groups);
  if (!anova) return anova.none();
  result.anova = *anova;
  const double n = anova->num_groups;
  result.k = (anova->num_values - sum_of_squared_sizes / anova->num_values) / (n - 1.0);
  result.harmonic_size = n / sum_of_inverse_sizes;
  result.icc = CalcShare(anova->f, result.k);
  return result;
}

IccPair MakeOneWayPair(const OneWay& y) {
  const double ms_of_means =
      y.harmonic_size * CalcMoments(y.means).sum_of_squares / y.anova.df_between;
  return MakePair(IccForm::kOneWay, y.k, y.icc,
                  CalcInterval(ms_of_means / y.anova.ms_within, y.harmonic_size, y.anova.df_between,
                               y.anova.df_within));
}

struct TwoWay {
  double n = 0.0, k = 0.0;
  double ms_person = 0.0, ms_trial = 0.0, ms_error = 0.0;
};

Answer<TwoWay> CalcTwoWay(const std::vector<PersonTrials>& persons) {
  if (persons.size() < 2) {
    return NoAnswer{FormatCount(persons.size(), "person") + "; expected 2 or more"};
  }
  const auto [fewest, most] = std::minmax_element(
      persons.begin(), persons.end(),
      [](const auto& a, const auto& b) { return a.values.size() < b.values.size(); });
  if (fewest->values.size() != most->values.size()) {
    return NoAnswer{"persons have " + std::to_string(fewest->values.size()) + " to " +
                    std::to_string(most->values.size()) +
                    " trials; a two-way form needs the same for all"};
  }
  if (most->values.size() < 2) return NoAnswer{"one trial a person; expected 2 or more"};
  Eigen::MatrixXd y(static_cast<Eigen::Index>(persons.size()),
                    static_cast<Eigen::Index>(most->values.size()));
  for (size_t p = 0; p < persons.size(); ++p) {
    for (size_t t = 0; t < persons[p].values.size(); ++t) {
      const double value = persons[p].values[t];
      if (!std::isfinite(value)) {
        return NoAnswer{"person \"" + persons[p].person + "\" has no value in trial " +
                        std::to_string(t + 1) + "; a two-way form needs all"};
      }
      y(static_cast<Eigen::Index>(p), static_cast<Eigen::Index>(t)) = value;
    }
  }
  TwoWay result;
  result.n = static_cast<double>(y.rows());
  result.k = static_cast<double>(y.cols());
  const double largest = y.cwiseAbs().maxCoeff();
  y.array() -= y.mean();
  const Eigen::VectorXd of_person = y.rowwise().mean();
  const Eigen::RowVectorXd of_trial = y.colwise().mean();
  const Eigen::MatrixXd rest = (y.colwise() - of_person).rowwise() - of_trial;
  result.ms_person = result.k * of_person.squaredNorm() / (result.n - 1.0);
  result.ms_trial = result.n * of_trial.squaredNorm() / (result.k - 1.0);
  result.ms_error = rest.squaredNorm() / ((result.n - 1.0) * (result.k - 1.0));
  if (std::sqrt(result.ms_error) <= 16.0 * std::numeric_limits<double>::epsilon() * largest) {
    return NoAnswer{"persons differ by the same amount in every trial: no rest to compare with"};
  }
  return result;
}

IccPair CalcConsistency(const TwoWay& y) {
  const double f = y.ms_person / y.ms_error;
  return MakePair(IccForm::kConsistency, y.k, CalcShare(f, y.k),
                  CalcInterval(f, y.k, y.n - 1.0, (y.n - 1.0) * (y.k - 1.0)));
}

/** McGraw and Wong 1996, table 7, case 2; the degrees of freedom are Satterthwaite's, whose
variance components must not be negative. */
Answer<IccPair> CalcAgreement(const TwoWay& y) {
  const double n = y.n, k = y.k;
  const double total = y.ms_person + (k - 1.0 - k / n) * y.ms_error + k * y.ms_trial / n;
  if (!(total > 0.0)) return NoAnswer{"neither persons nor trials differ"};
  const double icc = (y.ms_person - y.ms_error) / total;
  const double share = std::max(icc, 0.0);
  const double a = k * share * y.ms_trial / y.ms_error;
  const double b = n * (1.0 + (k - 1.0) * share) - k * share;
  const double df = (k - 1.0) * (n - 1.0) * (a + b) * (a + b) / ((n - 1.0) * a * a + b * b);
  const double spread = k * y.ms_trial + (k * n - k - n) * y.ms_error;
  const double f_low = CalcFisherQuantile(0.975, n - 1.0, df);
  const double f_high = CalcFisherQuantile(0.975, df, n - 1.0);
  return MakePair(IccForm::kAgreement, k, icc,
                  {n * (y.ms_person - f_low * y.ms_error) / (f_low * spread + n * y.ms_person),
                   n * (f_high * y.ms_person - y.ms_error) / (spread + n * f_high * y.ms_person)});
}

}  // namespace

Answer<std::vector<PersonTrials>> ListTrials(const MeasureTable& table, size_t cell) {
  std::vector<PersonTrials> persons;
  std::map<std::string, size_t> index_of;
  for (const Observation& row : table.rows) {
    const Answer<size_t> own_cell = FindCell(table.factors, row);
    if (!own_cell) return own_cell.none();
    if (std::string fault = FindUnusable(row.value); !fault.empty()) return NoAnswer{fault};
    if (*own_cell != cell) continue;
    const auto [entry, is_new] = index_of.try_emplace(row.person, persons.size());
    if (is_new) persons.push_back({row.person, {}});
    persons[entry->second].values.push_back(row.value);
  }
  return persons;
}

std::string NameOf(const Icc& icc) {
  return "ICC(" + std::to_string(static_cast<int>(icc.form) + 1) +
         (icc.num_trials == 1.0 ? ",1)" : ",k)");
}

Answer<IccPair> CalcIcc(const std::vector<PersonTrials>& persons, IccForm form) {
  if (form == IccForm::kOneWay) {
    const Answer<OneWay> one_way = CalcOneWay(persons);
    if (!one_way) return one_way.none();
    return MakeOneWayPair(*one_way);
  }
  const Answer<TwoWay> two_way = CalcTwoWay(persons);
  if (!two_way) return two_way.none();
  if (form == IccForm::kAgreement) return CalcAgreement(*two_way);
  return CalcConsistency(*two_way);
}

Answer<Retest> CalcRetest(const MeasureTable& table) {
  Retest retest;
  retest.sessions = table.sessions;
  if (retest.sessions.size() < 2) {
    return NoAnswer{FormatCount(retest.sessions.size(), "session") + "; expected 2 or more"};
  }
  // A session that is a factor, too, is no condition within itself.
  MeasureTable by_session = table;
  for (size_t i = by_session.factors.size(); i-- > 0;) {
    const auto is_session = [i](const Observation& row) {
      return i < row.levels.size() && row.levels[i] == row.session;
    };
    if (!std::all_of(by_session.rows.begin(), by_session.rows.end(), is_session)) continue;
    const auto at = static_cast<std::ptrdiff_t>(i);
    by_session.factors.erase(by_session.factors.begin() + at);
    for (Observation& row : by_session.rows) row.levels.erase(row.levels.begin() + at);
  }
  // The session becomes the last factor, so that the cells of a person are session by session.
  Factor session;
  session.name = "session, of the retest";
  session.levels = retest.sessions;
  by_session.factors.push_back(session);
  for (Observation& row : by_session.rows) row.levels.push_back(row.session);
  const Answer<CellMeans> cells = CalcCellMeans(by_session);
  if (!cells) return cells.none();
  retest.left_out = cells->left_out;
  const auto num_sessions = static_cast<Eigen::Index>(retest.sessions.size());
  std::vector<std::vector<double>> columns(retest.sessions.size());
  for (size_t person = 0; person < cells->persons.size(); ++person) {
    PersonTrials own = {cells->persons[person], {}};
    for (Eigen::Index s = 0; s < num_sessions; ++s) {
      double sum = 0.0;
      for (Eigen::Index cell = s; cell < cells->means.cols(); cell += num_sessions) {
        sum += cells->means(static_cast<Eigen::Index>(person), cell);
      }
      own.values.push_back(sum * static_cast<double>(num_sessions) /
                           static_cast<double>(cells->means.cols()));
      columns[static_cast<size_t>(s)].push_back(own.values.back());
    }
    retest.persons.push_back(std::move(own));
  }
  retest.reliability = CalcReliability(retest.persons);
  for (size_t b = 1; b < columns.size(); ++b) {
    retest.shifts.push_back({b - 1, b, CalcPairedTTest(columns[b], columns[b - 1])});
  }
  return retest;
}

}  // namespace graspbench
