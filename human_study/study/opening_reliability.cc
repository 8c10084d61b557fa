#include "human_study/study/opening_reliability.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "human_study/study/run_study.h"

namespace graspbench {
namespace {

using ValueOf = std::function<double(const StudyTrial&)>;

/** Values of the kept trials by person, the means of conditions taken out. */
std::vector<PersonTrials> CollectTrials(const StudyResult& result, const ValueOf& value_of) {
  struct Sum {
    double sum = 0.0;
    int count = 0;
    double Mean() const { return sum / count; }
    void Add(double value) {
      sum += value;
      ++count;
    }
  };
  std::map<std::vector<std::string>, Sum> cells;
  Sum all;
  for (const StudyTrial& trial : result.trials) {
    if (!trial.IsKept()) continue;
    const double value = value_of(trial);
    if (std::isnan(value)) continue;
    cells[trial.levels].Add(value);
    all.Add(value);
  }
  std::vector<PersonTrials> persons;
  for (const StudyTrial& trial : result.trials) {
    if (!trial.IsKept()) continue;
    auto person = std::find_if(persons.begin(), persons.end(),
                               [&](const auto& p) { return p.person == trial.participant; });
    if (person == persons.end()) {
      persons.push_back({trial.participant, {}});
      person = persons.end() - 1;
    }
    const double value = value_of(trial);
    person->values.push_back(std::isnan(value) ? value
                                               : value - cells[trial.levels].Mean() + all.Mean());
  }
  return persons;
}

std::vector<double> ListAll(const std::vector<PersonTrials>& persons) {
  std::vector<double> values;
  for (const PersonTrials& person : persons) {
    values.insert(values.end(), person.values.begin(), person.values.end());
  }
  return values;
}

/** Root of the mean square within persons. */
double CalcWithinSd(const std::vector<PersonTrials>& persons) {
  double sum_of_squares = 0.0;
  int df = 0;
  for (const PersonTrials& person : persons) {
    const Answer<Summary> summary = CalcSummary(person.values);
    if (!summary || !summary->standard_deviation) continue;
    sum_of_squares +=
        (summary->count - 1) * *summary->standard_deviation * *summary->standard_deviation;
    df += summary->count - 1;
  }
  return df > 0 ? std::sqrt(sum_of_squares / df) : std::nan("");
}

void CalcSeparations(const std::vector<PersonTrials>& open, const std::vector<PersonTrials>& closed,
                     OpeningReliability& row) {
  double sum = 0.0;
  for (size_t i = 0; i < open.size(); ++i) {
    const Answer<Separation> separation = CalcSeparation(open[i].values, closed[i].values);
    if (!separation) continue;
    sum += separation->d_prime;
    ++row.num_separated;
  }
  if (row.num_separated > 0) row.d_prime = sum / row.num_separated;
}

}  // namespace

std::vector<OpeningReliability> CalcOpeningReliability(const StudyResult& result) {
  std::vector<OpeningReliability> rows;
  const auto collect_open = [&](size_t i) {
    return CollectTrials(result, [i](const StudyTrial& trial) { return trial.openings[i].open; });
  };
  // The aperture comes first in the family.
  const std::vector<PersonTrials> aperture = collect_open(0);
  for (size_t i = 0; i < HandOpeningList().size(); ++i) {
    OpeningReliability row;
    row.opening = &HandOpeningList()[i];
    const std::vector<PersonTrials> open = collect_open(i);
    row.open = CalcSummary(ListAll(open));
    row.within_person_sd = CalcWithinSd(open);
    if (row.open) row.within_person_cv = row.within_person_sd / row.open->mean;
    row.minimal_detectable_change = CalcMinimalDetectableChange(row.within_person_sd);
    row.reliability = CalcReliability(open);
    CalcSeparations(
        open, CollectTrials(result, [i](const StudyTrial& t) { return t.openings[i].closed; }),
        row);
    row.against_aperture = i == 0 ? Answer<BootstrapInterval>(NoAnswer{"the aperture itself"})
                                  : CompareReliability(open, aperture, row.opening->id);
    for (size_t digit = 0; digit < result.digits.size(); ++digit) {
      const std::vector<PersonTrials> reduced = CollectTrials(
          result,
          [i, digit](const StudyTrial& trial) { return trial.openings[i].open_without[digit]; });
      row.without_digit.push_back(CalcPrecisionLoss(row.reliability, CalcReliability(reduced)));
    }
    rows.push_back(row);
  }
  return rows;
}

}  // namespace graspbench
