#include "human_study/study/inference/opening_reliability.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>

#include "core/base/text/text.h"
#include "core/statistics/multiple_tests.h"
#include "human_study/statistics/line_fit.h"
#include "human_study/statistics/within_anova.h"
#include "human_study/study/run/run_study.h"

namespace graspbench {
namespace {

constexpr size_t kRobustness = 3;  // the criterion that takes its trials without a digit

struct OpeningTrial {
  size_t cell = 0;     // of the design
  double level = NAN;  // of the factor that the slope goes over
  double open = NAN, closed = NAN;
};
using TrialsByPerson = std::vector<std::vector<OpeningTrial>>;
using Members = std::vector<size_t>;

/** Which numbers of a trial are compared. */
struct OpeningView {
  size_t opening = 0;
  std::optional<size_t> left_out;  // digit

  double Open(const StudyTrial& trial) const {
    const OpeningValues& values = trial.openings[opening];
    return left_out ? values.open_without[*left_out] : values.open;
  }
  double Closed(const StudyTrial& trial) const {
    const OpeningValues& values = trial.openings[opening];
    return left_out ? values.closed_without[*left_out] : values.closed;
  }
  bool Has(const StudyTrial& trial) const {
    return std::isfinite(Open(trial)) && std::isfinite(Closed(trial));
  }
};

/** The kept trials in order, by person and cell. */
class OpeningDesign {
 public:
  explicit OpeningDesign(const StudyResult& result) {
    const std::vector<Factor>& factors = result.study.factors;
    const auto factor = std::find_if(factors.begin(), factors.end(),
                                     [](const Factor& f) { return !f.numbers.empty(); });
    if (factor != factors.end()) slope_factor = factor->name;
    std::map<std::vector<std::string>, size_t> cells;
    std::map<std::string, size_t> persons;
    for (const StudyTrial& trial : result.trials) {
      if (!trial.IsKept() || trial.openings.empty()) continue;
      Entry entry;
      entry.trial = &trial;
      entry.person = persons.insert({trial.participant, persons.size()}).first->second;
      entry.cell = cells.insert({trial.levels, cells.size()}).first->second;
      if (factor != factors.end()) {
        const auto index = static_cast<size_t>(factor - factors.begin());
        const auto level =
            std::find(factor->levels.begin(), factor->levels.end(), trial.levels[index]);
        entry.level = factor->numbers[static_cast<size_t>(level - factor->levels.begin())];
      }
      entries_.push_back(entry);
    }
    num_persons = persons.size();
  }

  /** Those that have both views, with the numbers of the first; persons without any are left out.
   */
  TrialsByPerson List(const OpeningView& view, const OpeningView& other) const {
    TrialsByPerson trials(num_persons);
    for (const Entry& entry : entries_) {
      if (!view.Has(*entry.trial) || !other.Has(*entry.trial)) continue;
      trials[entry.person].push_back(
          {entry.cell, entry.level, view.Open(*entry.trial), view.Closed(*entry.trial)});
    }
    trials.erase(
        std::remove_if(trials.begin(), trials.end(), [](const auto& t) { return t.empty(); }),
        trials.end());
    return trials;
  }
  TrialsByPerson List(const OpeningView& view) const { return List(view, view); }

  std::string slope_factor;
  size_t num_persons = 0;

 private:
  struct Entry {
    const StudyTrial* trial;
    size_t person, cell;
    double level = NAN;
  };
  std::vector<Entry> entries_;
};

enum class HandState { kOpen, kBoth };

/** Standard deviation within persons and conditions, pooled; NaN when nobody repeats a condition. */
double CalcSpread(const TrialsByPerson& trials, const Members& members, HandState hand) {
  double sum_of_squares = 0.0, df = 0.0;
  const auto add = [&](const std::vector<OpeningTrial>& person, double OpeningTrial::*field) {
    std::map<size_t, std::vector<double>> cells;
    for (const OpeningTrial& trial : person) cells[trial.cell].push_back(trial.*field);
    for (const auto& [cell, values] : cells) {
      sum_of_squares += CalcMoments(values).sum_of_squares;
      df += static_cast<double>(values.size()) - 1.0;
    }
  };
  for (const size_t member : members) {
    add(trials[member], &OpeningTrial::open);
    if (hand == HandState::kBoth) add(trials[member], &OpeningTrial::closed);
  }
  return df > 0.0 && sum_of_squares > 0.0 ? std::sqrt(sum_of_squares / df) : std::nan("");
}

/** The largest openings of each member, the means of conditions over the members taken out. */
std::vector<std::vector<double>> TakeConditionsOut(const TrialsByPerson& trials,
                                                   const Members& members) {
  struct Sum {
    double sum = 0.0;
    int count = 0;
    double Mean() const { return sum / count; }
    void Add(double value) {
      sum += value;
      ++count;
    }
  };
  std::map<size_t, Sum> cells;
  Sum all;
  for (const size_t member : members) {
    for (const OpeningTrial& trial : trials[member]) {
      cells[trial.cell].Add(trial.open);
      all.Add(trial.open);
    }
  }
  std::vector<std::vector<double>> persons;
  for (const size_t member : members) {
    std::vector<double>& person = persons.emplace_back();
    for (const OpeningTrial& trial : trials[member]) {
      person.push_back(trial.open - cells[trial.cell].Mean() + all.Mean());
    }
  }
  return persons;
}

double CalcPersons(const TrialsByPerson& trials, const Members& members) {
  const Answer<OneWayAnova> anova = CalcMeanSquares(TakeConditionsOut(trials, members));
  return anova ? std::sqrt(anova->f) : std::nan("");
}

double CalcDPrime(const TrialsByPerson& trials, const Members& members) {
  double sum = 0.0;
  for (const size_t member : members) {
    double difference = 0.0;
    for (const OpeningTrial& trial : trials[member]) difference += trial.open - trial.closed;
    sum += difference / static_cast<double>(trials[member].size());
  }
  return sum / static_cast<double>(members.size()) / CalcSpread(trials, members, HandState::kBoth);
}

/** Slopes of the members who met two levels. */
std::vector<double> ListSlopes(const TrialsByPerson& trials, const Members& members) {
  std::vector<double> slopes;
  for (const size_t member : members) {
    std::vector<double> x, y;
    for (const OpeningTrial& trial : trials[member]) {
      x.push_back(trial.level);
      y.push_back(trial.open);
    }
    const Answer<LineFit> line = FitLine(x, y);
    if (line) slopes.push_back(line->slope);
  }
  return slopes;
}

double CalcSlope(const TrialsByPerson& trials, const Members& members) {
  return CalcMean(ListSlopes(trials, members)) / CalcSpread(trials, members, HandState::kOpen);
}

using Calc = double (*)(const TrialsByPerson&, const Members&);
constexpr std::array<Calc, kNumOpeningCriteria> kCalcs = {CalcPersons, CalcDPrime, CalcSlope,
                                                          CalcDPrime};

Members ListMembers(const TrialsByPerson& trials) {
  Members members(trials.size());
  std::iota(members.begin(), members.end(), size_t{0});
  return members;
}

Answer<double> CalcCriterion(size_t criterion, const TrialsByPerson& trials) {
  if (trials.empty()) return NoAnswer{"no trial has a value"};
  if (criterion == 0 && trials.size() < 2) return NoAnswer{"1 person; expected 2 or more"};
  const double value = kCalcs[criterion](trials, ListMembers(trials));
  if (!std::isfinite(value)) return NoAnswer{"nobody has two trials in a condition that differ"};
  return value;
}

/** Persons' slopes are above zero beyond chance. */
bool GrowsWithFactor(const TrialsByPerson& trials) {
  const Answer<TTest> test = CalcTTest(ListSlopes(trials, ListMembers(trials)), 0.0);
  return test && test->mean > 0.0 && test->p < 0.05;
}

OpeningComparison Compare(size_t criterion, const TrialsByPerson& own,
                          const TrialsByPerson& aperture) {
  OpeningComparison comparison;
  comparison.num_persons = static_cast<int>(own.size());
  if (comparison.num_persons < kMinPersons) {
    comparison.no_answer = FormatCount(comparison.num_persons, "person") + "; expected " +
                           std::to_string(kMinPersons) + " or more";
    return comparison;
  }
  const Answer<JackknifeInterval> answer = CalcJackknife(own.size(), [&](const Members& members) {
    // With two digits every opening is the aperture, up to rounding.
    const double ratio =
        std::log(kCalcs[criterion](own, members) / kCalcs[criterion](aperture, members));
    return std::abs(ratio) < 1e-12 ? 0.0 : ratio;
  });
  if (!answer) {
    comparison.no_answer = answer.reason();
    return comparison;
  }
  comparison.ratio = std::exp(answer->estimate);
  comparison.low = std::exp(answer->interval.low);
  comparison.high = std::exp(answer->interval.high);
  comparison.p = answer->p;
  return comparison;
}

std::vector<Answer<double>> CalcKept(const OpeningDesign& design, size_t opening,
                                     size_t num_digits) {
  std::vector<Answer<double>> kept;
  for (size_t digit = 0; digit < num_digits; ++digit) {
    const OpeningView full = {opening, {}}, reduced = {opening, digit};
    const Answer<double> without = CalcCriterion(kRobustness, design.List(reduced, full));
    const Answer<double> with = CalcCriterion(kRobustness, design.List(full, reduced));
    kept.push_back(without && with ? Answer<double>(*without / *with) : without.none());
  }
  return kept;
}

/** The digit whose loss costs most; none when no digit can be left out. */
std::optional<size_t> FindWorst(const std::vector<Answer<double>>& kept) {
  std::optional<size_t> worst;
  for (size_t digit = 0; digit < kept.size(); ++digit) {
    if (kept[digit] && (!worst || *kept[digit] < *kept[*worst])) worst = digit;
  }
  return worst;
}

OpeningReliability CalcOwn(const OpeningDesign& design, size_t opening, size_t num_digits) {
  OpeningReliability row;
  row.opening = &HandOpeningList()[opening];
  const TrialsByPerson trials = design.List({opening, {}});
  std::vector<PersonTrials> persons;
  std::vector<double> all;
  for (const std::vector<double>& values : TakeConditionsOut(trials, ListMembers(trials))) {
    persons.push_back({std::to_string(persons.size() + 1), values});
    all.insert(all.end(), values.begin(), values.end());
  }
  row.open = CalcSummary(all);
  row.within_person_sd = CalcSpread(trials, ListMembers(trials), HandState::kOpen);
  row.minimal_detectable_change = CalcMinimalDetectableChange(row.within_person_sd);
  row.reliability = CalcReliability(persons);
  row.kept_without = CalcKept(design, opening, num_digits);
  for (size_t i = 0; i < kNumOpeningCriteria; ++i) row.criteria[i] = CalcCriterion(i, trials);
  if (design.slope_factor.empty()) row.criteria[2] = NoAnswer{"no factor has numbers"};
  const std::optional<size_t> worst = FindWorst(row.kept_without);
  row.criteria[kRobustness] = worst ? CalcCriterion(kRobustness, design.List({opening, worst}))
                                    : Answer<double>(NoAnswer{"no digit can be left out"});
  return row;
}

void CompareWithAperture(const OpeningDesign& design, const OpeningReliability& aperture,
                         size_t opening, OpeningReliability& row) {
  const OpeningView own = {opening, {}}, first = {0, {}};
  for (size_t i = 0; i < kNumOpeningCriteria; ++i) {
    OpeningView a = own, b = first;
    if (i == kRobustness) {
      a.left_out = FindWorst(row.kept_without);
      b.left_out = FindWorst(aperture.kept_without);
    }
    OpeningComparison& comparison = row.against_aperture[i];
    if (!row.criteria[i] || !aperture.criteria[i]) {
      comparison.no_answer =
          row.criteria[i] ? aperture.criteria[i].reason() : row.criteria[i].reason();
    } else if (i == 2 && !GrowsWithFactor(design.List(first))) {
      comparison.no_answer = "the aperture does not grow with " + design.slope_factor;
    } else {
      comparison = Compare(i, design.List(a, b), design.List(b, a));
    }
  }
}

void AdjustFamily(OpeningFamily& family) {
  std::vector<double> p;
  for (const OpeningReliability& row : family.rows) {
    for (const OpeningComparison& c : row.against_aperture) {
      p.push_back(c.p);
      family.num_tests += std::isfinite(c.p) ? 1 : 0;
    }
  }
  const std::vector<double> adjusted = AdjustHolm(p);
  size_t next = 0;
  for (OpeningReliability& row : family.rows) {
    for (OpeningComparison& c : row.against_aperture) c.p_holm = adjusted[next++];
  }
}

std::string FormatComparison(const char* text, const OpeningComparison& c) {
  return std::string(text) + " " + FormatWithRange(c.ratio, c.low, c.high, 2) + ", p " +
         (c.p_holm < 0.001 ? "< 0.001" : FormatFixed(c.p_holm, 3));
}

const char* FormatVerdict(OpeningVerdict verdict) {
  switch (verdict) {
    case OpeningVerdict::kShown:
      return "shown";
    case OpeningVerdict::kNotShown:
      return "not shown";
    case OpeningVerdict::kWorse:
      return "not shown, less reliable";
    case OpeningVerdict::kDivided:
      return "not shown, better by one criterion and worse by another";
    case OpeningVerdict::kNotTestable:
      break;
  }
  return "not testable";
}

std::string ListWithVerdict(const OpeningFamily& family, const std::string& own,
                            OpeningVerdict verdict) {
  std::string text;
  for (size_t i = 1; i < family.rows.size(); ++i) {
    const OpeningReliability& row = family.rows[i];
    if (row.opening->id == own || row.verdict() != verdict) continue;
    text += (text.empty() ? "" : ", ") + std::string(row.opening->id);
  }
  return text;
}

}  // namespace

const std::array<OpeningCriterion, kNumOpeningCriteria>& ListOpeningCriteria() {
  static const std::array<OpeningCriterion, kNumOpeningCriteria> criteria = {{
      {"persons", "spread of persons"},
      {"separation", "d' open, closed"},
      {"slope", "slope / SEM"},
      {"robustness", "d' without the worst digit"},
  }};
  return criteria;
}

OpeningVerdict OpeningReliability::verdict() const {
  bool is_tested = false, is_better = false, is_worse = false;
  for (const OpeningComparison& comparison : against_aperture) {
    is_tested = is_tested || std::isfinite(comparison.p);
    is_better = is_better || comparison.IsBetter();
    is_worse = is_worse || comparison.IsWorse();
  }
  if (!is_tested) return OpeningVerdict::kNotTestable;
  if (is_better && is_worse) return OpeningVerdict::kDivided;
  if (is_better) return OpeningVerdict::kShown;
  return is_worse ? OpeningVerdict::kWorse : OpeningVerdict::kNotShown;
}

OpeningFamily CalcOpeningReliability(const StudyResult& result) {
  const OpeningDesign design(result);
  OpeningFamily family;
  family.slope_factor = design.slope_factor;
  family.num_persons = static_cast<int>(design.num_persons);
  for (size_t i = 0; i < HandOpeningList().size(); ++i) {
    family.rows.push_back(CalcOwn(design, i, result.digits.size()));
    if (i > 0) CompareWithAperture(design, family.rows.front(), i, family.rows.back());
  }
  AdjustFamily(family);
  return family;
}

std::string DescribeOpeningArgument(const StudyResult& result) {
  const OpeningFamily& family = result.statistics.openings;
  const std::string own = result.study.config.analysis.opening.measure;
  const std::string claim = "More reliable than the aperture: ";
  if (result.digits.size() < 3) {
    return claim + "not testable with " +
           FormatCount(static_cast<int>(result.digits.size()), "digit") +
           ": every opening is then the aperture.";
  }
  if (family.num_tests == 0) {
    const std::string persons = FormatCount(family.num_persons, "person");
    if (family.num_persons < kMinPersons) {
      return claim + "not testable with " + persons + " (" + std::to_string(kMinPersons) +
             " or more are needed).";
    }
    return claim + "not testable with the trials of " + persons + " (" +
           family.rows.back().against_aperture.front().no_answer + ").";
  }
  std::string text = claim;
  for (const OpeningReliability& row : family.rows) {
    if (row.opening->id != own || &row == &family.rows.front()) continue;
    text += std::string(FormatVerdict(row.verdict())) + " for " + own +
            ". Its criteria as multiples of the aperture's, with 95 % intervals and p after Holm";
    const char* before = ": ";
    for (size_t i = 0; i < kNumOpeningCriteria; ++i) {
      if (!row.against_aperture[i].no_answer.empty()) continue;
      text += before + FormatComparison(ListOpeningCriteria()[i].text, row.against_aperture[i]);
      before = "; ";
    }
    text += ". ";
  }
  if (text == claim) text += "the study's own opening is the aperture itself. ";
  const std::string shown = ListWithVerdict(family, own, OpeningVerdict::kShown);
  const std::string worse = ListWithVerdict(family, own, OpeningVerdict::kWorse);
  const std::string divided = ListWithVerdict(family, own, OpeningVerdict::kDivided);
  text += "Of the other openings it is shown for " + (shown.empty() ? "none" : shown);
  if (!worse.empty()) text += "; less reliable: " + worse;
  if (!divided.empty()) text += "; better and worse: " + divided;
  return text + " (" + FormatCount(family.num_persons, "person") + ", " +
         FormatCount(family.num_tests, "comparison") + ").";
}

}  // namespace graspbench
