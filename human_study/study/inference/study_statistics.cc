#include "human_study/study/inference/study_statistics.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

#include "core/base/random.h"
#include "core/statistics/summary.h"
#include "human_study/study/design/study_config.h"
#include "human_study/study/run/run_study.h"

namespace graspbench {

namespace {

/** Measures drawn and tested when a study names none. */
constexpr const char* kUsualMeasures[] = {
    "grasp_forming_ratio",  "grasp_opposing_ratio", "grasp_forming_time_s", "grasp_opposing_time_s",
    "grasp_closure_time_s", "peak_opening_m",       "movement_time_s",
};
/** Asynchronies of the bias card [s]. */
constexpr double kBiasGfts[] = {0.0, 0.03, 0.06};

Observation MakeObservation(const StudyTrial& trial, double value) {
  return {trial.participant, trial.id, trial.levels, value, trial.groups, trial.session};
}

std::vector<OpeningCurve> CalcOpeningCurves(const StudyResult& result) {
  std::vector<OpeningCurve> curves;
  const std::vector<std::string> names = ListCells(result.study.factors);
  const std::vector<std::vector<std::string>> cells = ListLevels(result.study.factors);
  for (size_t cell = 0; cell < cells.size(); ++cell) {
    std::vector<const StudyTrial*> trials;
    for (const StudyTrial& trial : result.trials) {
      if (trial.IsKept() && trial.levels == cells[cell]) trials.push_back(&trial);
    }
    OpeningCurve curve;
    curve.cell = names[cell];
    curve.num_trials = static_cast<int>(trials.size());
    for (size_t step = 0; step < kNumOpeningSteps; ++step) {
      std::vector<double> values;
      for (const StudyTrial* trial : trials) values.push_back(trial->opening_course[step]);
      const Answer<Summary> summary = CalcSummary(values);
      const double mean = summary ? summary->mean : std::nan("");
      const double sd = summary ? summary->standard_deviation.value_or(0.0) : std::nan("");
      curve.times.push_back(static_cast<double>(step) / (kNumOpeningSteps - 1));
      curve.mean.push_back(mean);
      curve.low.push_back(mean - sd);
      curve.high.push_back(mean + sd);
    }
    curves.push_back(curve);
  }
  return curves;
}

void CalcUniverse(const StudyResult& result, size_t index, Universe& universe) {
  MeasureTable table =
      MakeMeasureTable(result, FindMeasure(result.study.config.multiverse.measure));
  table.rows.clear();
  for (const StudyTrial& trial : result.trials) {
    if (trial.IsKept()) table.rows.push_back(MakeObservation(trial, trial.universes[index]));
  }
  universe.summary = SummariseRows(table);
  const Answer<WithinAnova> anova = CalcAnova(CalcCellMeans(table));
  universe.test = anova ? anova->effects.front().test : Answer<WithinTest>(anova.none());
}

/** @param index  of the measure in ListStudyMeasures(). */
ChoiceRange CalcOverChoices(const StudyResult& result, size_t index) {
  ChoiceRange range;
  for (size_t universe = 0; universe < result.universes.size(); ++universe) {
    std::vector<double> values;
    for (const StudyTrial& trial : result.trials) {
      if (!trial.IsKept() || index >= trial.measure_universes.size()) continue;
      values.push_back(trial.measure_universes[index][universe]);
    }
    const double median = CalcMedianOfFinite(values);
    if (std::isnan(median)) continue;
    ++range.num_values;
    range.lowest = std::fmin(range.lowest, median);
    range.highest = std::fmax(range.highest, median);
  }
  return range;
}

std::vector<BiasRow> CalcBias(const StudyResult& result) {
  // A study at 8 kHz would only make the simulation slow; above 1 kHz nothing changes.
  const double rate = std::clamp(result.rate, 20.0, 1000.0);
  if (!std::isfinite(result.rate) || !std::isfinite(result.noise)) return {};
  if (result.study.config.bias_trials == 0) return {};
  const AnalysisOptions own = FitCutoffs(result.study.config.analysis, rate);
  BiasCase like_study;  // as many digits, lifted and with the object recorded as in the study
  like_study.noise = result.noise;
  like_study.num_digits = static_cast<int>(result.digits.size());
  like_study.lifts = std::any_of(result.trials.begin(), result.trials.end(), [](const auto& trial) {
    return trial.IsKept() && trial.analysis->object.lift_off.IsFound();
  });
  like_study.has_object = !result.study.config.markers.object.empty();
  std::vector<BiasCase> cases;
  const auto add = [&](std::string text, double case_rate, const AnalysisOptions& options) {
    // A filter needs its cut-off well below half the rate.
    if (options.contact.cutoff >= 0.35 * case_rate) return;
    if (!FindCutoffFault(ListCutoffs(options), case_rate).empty()) return;
    BiasCase bias = like_study;
    bias.text = std::move(text);
    bias.rate = case_rate;
    bias.options = options;
    cases.push_back(bias);
  };
  add("this study", rate, own);
  for (const double factor : {0.5, 2.0}) {
    AnalysisOptions options = own;
    options.contact.cutoff *= factor;
    add(factor < 1.0 ? "half the cut-off" : "twice the cut-off", rate, options);
  }
  for (const ContactDetector& detector : ContactDetectorList()) {
    // Forces are not simulated here, and the surface needs no bias card of its own filter.
    if (own.contact.detector == detector.id || std::string(detector.id) == "force") continue;
    AnalysisOptions options = own;
    options.contact.detector = detector.id;
    add(std::string("detector ") + detector.id, rate, options);
  }
  add("half the frame rate", rate / 2.0, own);
  return CalcBiasCard(cases, {std::begin(kBiasGfts), std::end(kBiasGfts)},
                      result.study.config.bias_trials, "bias card");
}

/** The study's own choice first, then the others. */
template <class T>
std::vector<T> ListChoices(const T& own, const std::vector<T>& others) {
  std::vector<T> choices = {own};
  for (const T& other : others) {
    if (std::find(choices.begin(), choices.end(), other) == choices.end()) {
      choices.push_back(other);
    }
  }
  return choices;
}

}  // namespace

const TrialMeasure& FindMeasure(const std::string& id) {
  const std::vector<TrialMeasure>& list = TrialMeasureList();
  const auto found =
      std::find_if(list.begin(), list.end(), [&](const TrialMeasure& m) { return m.id == id; });
  GRASPBENCH_DEMAND(found != list.end(), id);
  return *found;
}

std::vector<TrialMeasure> ListStudyMeasures(const Study& study) {
  std::vector<std::string> ids = study.config.measures;
  if (ids.empty()) ids.assign(std::begin(kUsualMeasures), std::end(kUsualMeasures));
  for (const Hypothesis& hypothesis : study.hypotheses) {
    if (std::find(ids.begin(), ids.end(), hypothesis.measure) == ids.end()) {
      ids.push_back(hypothesis.measure);
    }
  }
  std::vector<TrialMeasure> measures;
  for (const std::string& id : ids) measures.push_back(FindMeasure(id));
  return measures;
}

std::vector<Universe> ListUniverses(const StudyConfig& config) {
  const MultiverseConfig& multiverse = config.multiverse;
  const AnalysisOptions& own = config.analysis;
  if (multiverse.is_left_out) {
    Universe universe;
    universe.onset = own.movement.rule;
    universe.opening = own.opening.measure;
    universe.cutoff = own.contact.cutoff;
    universe.detector = own.contact.detector;
    universe.is_own = true;
    return {universe};
  }
  std::vector<std::string> others = multiverse.detector;
  if (others.empty()) {
    for (const ContactDetector& detector : ContactDetectorList()) others.push_back(detector.id);
  }
  const std::vector<std::string> detectors = ListChoices(own.contact.detector, others);
  std::vector<Universe> universes;
  for (const std::string& onset : ListChoices(own.movement.rule, multiverse.onset)) {
    for (const std::string& opening : ListChoices(own.opening.measure, multiverse.opening)) {
      for (const double cutoff : ListChoices(own.contact.cutoff, multiverse.cutoff)) {
        for (const std::string& detector : detectors) {
          Universe universe;
          universe.onset = onset;
          universe.opening = opening;
          universe.cutoff = cutoff;
          universe.detector = detector;
          universe.is_own = onset == own.movement.rule && opening == own.opening.measure &&
                            cutoff == own.contact.cutoff && detector == own.contact.detector;
          universes.push_back(universe);
        }
      }
    }
  }
  return universes;
}

AnalysisOptions MakeOptions(const StudyConfig& config, const Universe& universe, double rate) {
  AnalysisOptions options = FitCutoffs(config.analysis, rate);
  options.movement.rule = universe.onset;
  options.opening.measure = universe.opening;
  if (universe.cutoff != config.analysis.contact.cutoff) {
    options.contact.cutoff = FitCutoff(config.analysis, kMultiverseCutoff, universe.cutoff, rate);
  }
  options.contact.detector = universe.detector;
  return options;
}

MeasureTable MakeMeasureTable(const StudyResult& result, const TrialMeasure& measure) {
  MeasureTable table;
  table.measure = measure.id;
  table.unit = measure.unit;
  table.description = measure.name;
  table.factors = result.study.factors;
  table.groups = result.study.groups;
  table.sessions = result.study.sessions;
  for (const StudyTrial& trial : result.trials) {
    if (trial.IsKept()) {
      table.rows.push_back(MakeObservation(trial, measure.value(*trial.analysis)));
    }
  }
  return table;
}

void CalcStudyStatistics(StudyResult& result) {
  for (const TrialMeasure& measure : ListStudyMeasures(result.study)) {
    const size_t index = result.statistics.measures.size();
    result.statistics.measures.push_back(CalcMeasureStatistics(
        measure, MakeMeasureTable(result, measure), result.study.FindHypothesis(measure.id)));
    result.statistics.measures.back().over_choices = CalcOverChoices(result, index);
  }
  for (size_t i = 0; i < result.universes.size(); ++i) CalcUniverse(result, i, result.universes[i]);
  result.statistics.curves = CalcOpeningCurves(result);
  result.statistics.openings = CalcOpeningReliability(result);
  result.statistics.bias = CalcBias(result);
  result.statistics.published = ComparePublished(result);
  result.statistics.zero_gft = CalcZeroGft(result.trials);
  result.statistics.independence = CalcIndependenceNull(result.trials, result.digits.size());
}

UniverseSummary SummariseUniverses(const std::vector<Universe>& universes) {
  constexpr double kSignificance = 0.05;
  UniverseSummary summary;
  for (const Universe& universe : universes) {
    if (!universe.summary) continue;
    ++summary.num_values;
    summary.lowest = std::fmin(summary.lowest, universe.summary->median);
    summary.highest = std::fmax(summary.highest, universe.summary->median);
    if (!universe.test) continue;
    ++summary.num_tests;
    const double p = universe.test->greenhouse_geisser.p;
    const double effect = universe.test->generalised_eta_squared;
    summary.num_significant += p < kSignificance;
    summary.lowest_p = std::fmin(summary.lowest_p, p);
    summary.highest_p = std::fmax(summary.highest_p, p);
    summary.lowest_effect = std::fmin(summary.lowest_effect, effect);
    summary.highest_effect = std::fmax(summary.highest_effect, effect);
  }
  return summary;
}

namespace {

size_t FindPlace(const std::vector<std::string>& digits, const std::string& digit) {
  return static_cast<size_t>(std::find(digits.begin(), digits.end(), digit) - digits.begin());
}

/** The digit alone in the first group; the number of digits for a tie. */
size_t FindFirst(const ContactOrder& order, const std::vector<std::string>& digits) {
  const bool is_sure = !order.groups.empty() && order.groups.front().size() == 1;
  return is_sure ? FindPlace(digits, order.groups.front().front()) : digits.size();
}

/** Tied digits in the order of the hand: which of them came first is not known. */
std::string FormatOrder(ContactOrder order, const std::vector<std::string>& digits) {
  for (std::vector<std::string>& group : order.groups) {
    std::sort(group.begin(), group.end(), [&](const auto& a, const auto& b) {
      return FindPlace(digits, a) < FindPlace(digits, b);
    });
  }
  return order.Format();
}

void CountFirst(const StudyTrial& trial, const std::vector<std::string>& digits,
                std::vector<FirstDigits>& first) {
  auto row = std::find_if(first.begin(), first.end(), [&](const FirstDigits& other) {
    return other.participant == trial.participant;
  });
  if (row == first.end()) {
    row = first.insert(first.end(), {trial.participant, std::vector<int>(digits.size() + 1, 0)});
  }
  ++row->counts[FindFirst(trial.analysis->order, digits)];
}

void CountPrecedence(const ContactOrder& order, const std::vector<std::string>& digits,
                     std::vector<std::vector<Precedence>>& precedence) {
  for (size_t a = 0; a < digits.size(); ++a) {
    for (size_t b = 0; b < digits.size(); ++b) {
      const int rank_a = order.FindRank(digits[a]), rank_b = order.FindRank(digits[b]);
      if (rank_a == 0 || rank_b == 0) continue;  // one of them never touched
      ++precedence[a][b].num_both;
      precedence[a][b].num_before += rank_a < rank_b;
    }
  }
}

}  // namespace

OrderSummary SummariseOrders(const StudyResult& result) {
  const std::vector<std::string>& digits = result.digits;
  OrderSummary summary;
  summary.precedence.assign(digits.size(), std::vector<Precedence>(digits.size()));
  std::map<std::string, int> counts;
  for (const StudyTrial& trial : result.trials) {
    if (!trial.IsKept()) continue;
    const ContactOrder& order = trial.analysis->order;
    CountFirst(trial, digits, summary.first);
    CountPrecedence(order, digits, summary.precedence);
    ++counts[FormatOrder(order, digits)];
    summary.num_ties += order.num_ties;
    summary.num_neighbours += std::max(0, trial.analysis->num_touching - 1);
  }
  for (const auto& [order, count] : counts) {
    summary.orders.push_back({order, count, CalcShare(count, result.CountKept())});
  }
  std::stable_sort(summary.orders.begin(), summary.orders.end(),
                   [](const OrderCount& a, const OrderCount& b) { return a.count > b.count; });
  return summary;
}

ZeroGft CalcZeroGft(const std::vector<StudyTrial>& trials) {
  constexpr int kNumDraws = 50;
  ZeroGft zero;
  std::vector<double> gfts;
  for (const StudyTrial& trial : trials) {
    if (!trial.IsKept() || !trial.analysis) continue;
    std::vector<double> uncertainties;
    for (const DigitContactEvents& digit : trial.analysis->contacts) {
      if (!digit.contact.IsFound()) continue;
      uncertainties.push_back(digit.own_uncertainty);
    }
    if (uncertainties.size() < 2) continue;
    ++zero.num_trials;
    RandomStream random(trial.id, "true GFT zero");
    for (int i = 0; i < kNumDraws; ++i) {
      double first = INFINITY, last = -INFINITY;
      for (const double uncertainty : uncertainties) {
        const double error = uncertainty * random.NextNormal();
        first = std::min(first, error);
        last = std::max(last, error);
      }
      gfts.push_back(last - first);
    }
  }
  if (gfts.empty()) return zero;
  std::sort(gfts.begin(), gfts.end());
  zero.median = CalcSortedQuantile(gfts, 0.5);
  zero.limit = CalcSortedQuantile(gfts, 0.95);
  return zero;
}

}  // namespace graspbench
