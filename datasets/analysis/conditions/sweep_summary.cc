#include "datasets/analysis/conditions/sweep_summary.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/base/error.h"
#include "core/base/text/text.h"
#include "core/statistics/summary.h"

namespace graspbench {

namespace {

double FindBreakingForce(const SweepTrial& trial) {
  return trial.record->judgement ? trial.record->judgement->breaking_force : kUnset;
}

}  // namespace

double SweepMeasure::CalcEffectValue(const SweepTrial& trial) const {
  const double found = value(trial);
  if (!threshold || std::isnan(found)) return found;
  const double step = std::log2(threshold->most / threshold->least) / kMostGripPlace;
  return std::isinf(found) ? std::log2(threshold->most) + step : std::log2(found);
}

const std::vector<SweepMeasure>& ListSweepMeasures() {
  static const std::vector<SweepMeasure> measures = {
      {"success", "success [%]", 100.0, 1,
       [](const SweepTrial& trial) { return IsSuccess(trial.record->result.outcome) ? 1.0 : 0.0; }},
      {"gft_ratio", "GFT% [%]", 100.0, 1,
       [](const SweepTrial& trial) {
         const TrialResult& result = trial.record->result;
         const bool has_times =
             !IsNumericalFailure(result.outcome) && !result.timing.contact_before_start;
         return has_times ? result.timing.gft_ratio : kUnset;
       }},
      {"sigma_n", "sigma [N]", 1.0, 2,
       [](const SweepTrial& trial) { return trial.record->result.stability.sigma; }},
      {"breaking_force_n", "breaking force [N]", 1.0, 2, &FindBreakingForce},
      {"threshold_margin", "grip threshold, margin", 1.0, 2,
       [](const SweepTrial& trial) { return trial.thresholds[0]; }, &kThresholdScales[0]},
      {"threshold_force_n", "grip threshold, force [N]", 1.0, 2,
       [](const SweepTrial& trial) { return trial.thresholds[1]; }, &kThresholdScales[1]}};
  return measures;
}

const SweepMeasure& FindSweepMeasure(const std::string& id) {
  const auto& measures = ListSweepMeasures();
  const auto found = std::find_if(measures.begin(), measures.end(),
                                  [&](const SweepMeasure& measure) { return measure.id == id; });
  GRASPBENCH_DEMAND(found != measures.end(), id);
  return *found;
}

std::string FormatValue(const SweepMeasure& measure, double value) {
  if (std::isinf(value)) return "none held";
  return std::isnan(value) ? "n/a" : FormatFixed(measure.scale * value, measure.decimals);
}

std::string FormatChange(const SweepMeasure& measure, double change) {
  if (measure.threshold) return "x " + FormatFixed(std::exp2(change), measure.decimals);
  return FormatFixed(measure.scale * change, measure.decimals);
}

std::string FormatChangeInterval(const SweepMeasure& measure, const Interval& interval) {
  if (!measure.threshold) {
    return FormatRange(measure.scale * interval.low, measure.scale * interval.high,
                       measure.decimals);
  }
  return "x " + FormatRange(std::exp2(interval.low), std::exp2(interval.high), measure.decimals);
}

namespace {

/** A condition as its levels; the first is the base. */
struct Treatment {
  std::optional<std::string> name;
  std::vector<std::string> levels;
};

std::vector<Treatment> ListTreatments(const SessionConfig& config,
                                      const std::vector<SweepFactor>& factors) {
  std::vector<Treatment> treatments = {{std::nullopt, {}}};
  for (const Condition& condition : config.conditions) treatments.push_back({condition.name, {}});
  for (Treatment& treatment : treatments) {
    for (const SweepFactor& factor : factors) {
      treatment.levels.push_back(FindLevel(config, treatment.name, factor.key));
    }
  }
  return treatments;
}

/** Thresholds of each of the session's records. */
using Thresholds = std::array<std::vector<double>, std::size(kThresholdScales)>;

Thresholds ListThresholds(const Session& session, const std::vector<ThresholdSummary>& summaries) {
  Thresholds thresholds;
  for (std::vector<double>& values : thresholds) values.assign(session.records.size(), kUnset);
  for (const ThresholdSummary& summary : summaries) {
    thresholds[static_cast<size_t>(summary.scale - kThresholdScales)] =
        ListThresholdsOf(session, summary);
  }
  return thresholds;
}

/** A draw with the trials of its treatments; without record: not finished, or none is planned. */
struct Draw {
  ComparedDraw of;
  std::vector<SweepTrial> trials;
};

/** The draws of each hand in the plan's order. */
std::map<std::string, std::vector<Draw>> ListDraws(const Session& session,
                                                   const std::vector<Treatment>& treatments,
                                                   const Thresholds& thresholds) {
  std::vector<ComparedSide> sides;
  for (const Treatment& treatment : treatments) sides.push_back({&session, treatment.name});
  std::map<std::string, std::vector<Draw>> draws;
  for (ComparedDraw& of : ListComparedDraws(sides)) {
    Draw draw = {std::move(of), std::vector<SweepTrial>(treatments.size())};
    for (size_t place = 0; place < treatments.size(); ++place) {
      const TrialRecord* record = draw.of.records[place];
      if (!record) continue;
      draw.trials[place].record = record;
      for (size_t scale = 0; scale < thresholds.size(); ++scale) {
        draw.trials[place].thresholds[scale] =
            thresholds[scale][static_cast<size_t>(record - session.records.data())];
      }
    }
    draws[draw.of.hand].push_back(std::move(draw));
  }
  return draws;
}

/** A weighted sum of treatments. */
using Contrast = std::vector<std::pair<size_t, double>>;

bool IsSameBut(const Treatment& a, const Treatment& b, const std::set<size_t>& factors) {
  for (size_t i = 0; i < a.levels.size(); ++i) {
    if (factors.count(i) == 0 && a.levels[i] != b.levels[i]) return false;
  }
  return true;
}

/** The treatment that has these levels where `like` has others; -1: none. */
int FindTreatment(const std::vector<Treatment>& treatments, const Treatment& like,
                  const std::map<size_t, std::string>& levels) {
  for (size_t i = 0; i < treatments.size(); ++i) {
    std::set<size_t> changed;
    bool is_it = true;
    for (const auto& [factor, level] : levels) {
      changed.insert(factor);
      is_it = is_it && treatments[i].levels[factor] == level;
    }
    if (is_it && IsSameBut(treatments[i], like, changed)) return static_cast<int>(i);
  }
  return -1;
}

std::vector<Contrast> ListPairs(const std::vector<Treatment>& treatments, const SweepFactor& factor,
                                size_t index, const std::string& level) {
  std::vector<Contrast> contrasts;
  for (size_t i = 0; i < treatments.size(); ++i) {
    if (treatments[i].levels[index] != level) continue;
    const int base = FindTreatment(treatments, treatments[i], {{index, factor.levels.front()}});
    if (base >= 0) contrasts.push_back({{i, 1.0}, {static_cast<size_t>(base), -1.0}});
  }
  return contrasts;
}

/** One contrast: of all treatments with the level, and of all with that of the base. */
Contrast MakeMarginal(const std::vector<Treatment>& treatments, const SweepFactor& factor,
                      size_t index, const std::string& level) {
  const auto count = [&](const std::string& wanted) {
    return static_cast<double>(
        std::count_if(treatments.begin(), treatments.end(),
                      [&](const Treatment& one) { return one.levels[index] == wanted; }));
  };
  Contrast contrast;
  for (size_t i = 0; i < treatments.size(); ++i) {
    if (treatments[i].levels[index] == level) contrast.push_back({i, 1.0 / count(level)});
    if (treatments[i].levels[index] == factor.levels.front()) {
      contrast.push_back({i, -1.0 / count(factor.levels.front())});
    }
  }
  return contrast;
}

/** A weighted sum of a draw's values; NaN when one is missing. */
double CalcContrast(const Draw& draw, const Contrast& contrast, const SweepMeasure& measure) {
  double sum = 0.0;
  for (const auto& [treatment, weight] : contrast) {
    const SweepTrial& trial = draw.trials[treatment];
    sum += trial.record ? weight * measure.CalcEffectValue(trial) : kUnset;
  }
  return sum;
}

/** Why a draw has no value of every contrast. */
enum class Gap { kNotPlanned, kNotFinished, kNoValue };
constexpr const char* kGapTexts[] = {"without a trial in each condition", "not finished",
                                     "without a value"};

Gap FindGap(const Draw& draw, const std::vector<Contrast>& contrasts) {
  Gap gap = Gap::kNoValue;
  for (const Contrast& contrast : contrasts) {
    for (const auto& part : contrast) {
      if (!draw.of.planned[part.first]) return Gap::kNotPlanned;
      if (!draw.of.records[part.first]) gap = Gap::kNotFinished;
    }
  }
  return gap;
}

bool IsSuccessRate(const SweepMeasure& measure) { return &measure == &ListSweepMeasures().front(); }

/** Some two trials of a contrast have other grasps. */
bool ChangesGrasp(const Draw& draw, const std::vector<Contrast>& contrasts) {
  return std::any_of(contrasts.begin(), contrasts.end(), [&](const Contrast& contrast) {
    return std::any_of(contrast.begin(), contrast.end(), [&](const auto& part) {
      return draw.of.ChangesGrasp(contrast.front().first, part.first);
    });
  });
}

/** Estimate and interval of the mean over draws. @pre there is a contrast. */
void Estimate(const std::vector<Draw>& draws, const std::vector<Contrast>& contrasts,
              const SweepMeasure& measure, SweepEffect& effect) {
  ObjectChanges changes;
  std::set<const TrialRecord*> compared, left_out;
  std::map<Gap, int> gaps;
  const bool is_pair = contrasts.size() == 1 && contrasts.front().size() == 2;
  PairedCounts pairs;
  for (const Draw& draw : draws) {
    std::vector<double> values;
    std::set<const TrialRecord*> records;
    for (const Contrast& contrast : contrasts) {
      const double value = CalcContrast(draw, contrast, measure);
      if (std::isfinite(value)) values.push_back(value);
      for (const auto& part : contrast) {
        if (const TrialRecord* record = draw.of.records[part.first]) records.insert(record);
      }
    }
    const bool is_compared = values.size() == contrasts.size();
    (is_compared ? compared : left_out).insert(records.begin(), records.end());
    if (!is_compared) {
      ++gaps[FindGap(draw, contrasts)];
      continue;
    }
    changes[draw.of.object].push_back(CalcMean(values));
    effect.num_other_grasp += ChangesGrasp(draw, contrasts);
    if (!is_pair) continue;
    const auto succeeds = [&](size_t part) {
      return IsSuccess(draw.of.records[contrasts.front()[part].first]->result.outcome);
    };
    pairs.Add(succeeds(1), succeeds(0));  // the base comes second
  }
  effect.measure = measure.id;
  effect.change = IsSuccessRate(measure)
                      ? EstimateSuccessChange(
                            changes, is_pair ? std::optional<PairedCounts>(pairs) : std::nullopt,
                            ExplainUndecided(CountOutcomes(compared), CountOutcomes(left_out)))
                      : EstimateChange(changes);
  effect.num_left_out = static_cast<int>(draws.size()) - effect.change.num_draws;
  std::vector<std::pair<int, std::string>> counts;
  for (const auto& [gap, num] : gaps) counts.emplace_back(num, kGapTexts[static_cast<size_t>(gap)]);
  effect.why_left_out = DescribeCounts(counts);
}

void AddEffects(const std::vector<Treatment>& treatments, const std::vector<Draw>& draws,
                const std::string& hand, SweepSummary& summary) {
  for (size_t f = 0; f < summary.factors.size(); ++f) {
    const SweepFactor& factor = summary.factors[f];
    for (size_t l = 1; l < factor.levels.size(); ++l) {
      SweepEffect effect;
      effect.factors = {factor.key};
      effect.levels = {factor.levels[l]};
      effect.hand = hand;
      std::vector<Contrast> contrasts = ListPairs(treatments, factor, f, factor.levels[l]);
      effect.is_marginal = contrasts.empty();
      if (contrasts.empty()) {
        contrasts.push_back(MakeMarginal(treatments, factor, f, factor.levels[l]));
      }
      for (const SweepMeasure& measure : ListSweepMeasures()) {
        SweepEffect one = effect;
        Estimate(draws, contrasts, measure, one);
        if (one.change.num_draws > 0 || IsSuccessRate(measure)) summary.effects.push_back(one);
      }
    }
  }
}

std::vector<Contrast> ListSquares(const std::vector<Treatment>& treatments,
                                  const std::vector<SweepFactor>& factors, size_t f, size_t g,
                                  const std::string& level_f, const std::string& level_g) {
  const std::string &base_f = factors[f].levels.front(), &base_g = factors[g].levels.front();
  std::vector<Contrast> contrasts;
  for (size_t i = 0; i < treatments.size(); ++i) {
    if (treatments[i].levels[f] != level_f || treatments[i].levels[g] != level_g) continue;
    const int a = FindTreatment(treatments, treatments[i], {{f, level_f}, {g, base_g}});
    const int b = FindTreatment(treatments, treatments[i], {{f, base_f}, {g, level_g}});
    const int none = FindTreatment(treatments, treatments[i], {{f, base_f}, {g, base_g}});
    if (a < 0 || b < 0 || none < 0) continue;
    contrasts.push_back({{i, 1.0},
                         {static_cast<size_t>(a), -1.0},
                         {static_cast<size_t>(b), -1.0},
                         {static_cast<size_t>(none), 1.0}});
  }
  return contrasts;
}

void AddInteractions(const std::vector<Treatment>& treatments, const std::vector<Draw>& draws,
                     const std::string& hand, SweepSummary& summary) {
  const std::vector<SweepFactor>& factors = summary.factors;
  for (size_t f = 0; f < factors.size(); ++f) {
    for (size_t g = f + 1; g < factors.size(); ++g) {
      for (size_t l = 1; l < factors[f].levels.size(); ++l) {
        for (size_t m = 1; m < factors[g].levels.size(); ++m) {
          SweepEffect effect;
          effect.factors = {factors[f].key, factors[g].key};
          effect.levels = {factors[f].levels[l], factors[g].levels[m]};
          effect.hand = hand;
          const std::vector<Contrast> contrasts =
              ListSquares(treatments, factors, f, g, effect.levels[0], effect.levels[1]);
          if (contrasts.empty()) continue;
          for (const SweepMeasure& measure : ListSweepMeasures()) {
            SweepEffect one = effect;
            Estimate(draws, contrasts, measure, one);
            if (one.change.num_draws > 0 || IsSuccessRate(measure))
              summary.interactions.push_back(one);
          }
        }
      }
    }
  }
}

ConditionRow MakeRow(const Treatment& treatment, size_t place, const std::string& hand,
                     const std::vector<Draw>& draws, const Session& session) {
  ConditionRow row;
  row.name = treatment.name.value_or("");
  row.levels = treatment.levels;
  row.hand = hand;
  for (const PlannedTrial& planned : session.plan) {
    row.num_planned += planned.hand == hand && planned.condition == treatment.name;
  }
  std::vector<std::vector<double>> values(ListSweepMeasures().size());
  std::set<std::string> changed;
  for (const Draw& draw : draws) {
    const PlannedTrial *base = draw.of.planned.front(), *own = draw.of.planned[place];
    if (base && own && draw.of.ChangesGrasp(0, place) && changed.insert(own->object).second) {
      row.other_grasps += (row.other_grasps.empty() ? "" : ", ") + own->object + " " + base->grasp +
                          " to " + own->grasp;
    }
    const SweepTrial& trial = draw.trials[place];
    const TrialRecord* record = trial.record;
    if (!record) continue;
    ++row.num_finished;
    row.num_successes += IsSuccess(record->result.outcome);
    row.num_numerical += IsNumericalFailure(record->result.outcome);
    for (size_t i = 0; i < values.size(); ++i) {
      const double value = ListSweepMeasures()[i].value(trial);
      if (!std::isnan(value)) values[i].push_back(value);
    }
  }
  for (const std::vector<double>& of_measure : values) {
    row.medians.push_back(of_measure.empty() ? kUnset : CalcMedian(of_measure));
  }
  row.medians.front() = CalcShare(row.num_successes, row.num_finished);
  row.undecided = ExplainUndecided({row.num_finished, row.num_successes});
  return row;
}

ConditionThresholds SummariseCondition(const ThresholdSummary& summary, const std::string& name,
                                       const std::string& hand) {
  ConditionThresholds row;
  row.scale = summary.scale;
  row.name = name;
  row.hand = hand;
  for (const CellThreshold& cell : summary.cells) {
    if (cell.condition != name || cell.hand != hand) continue;
    row.num_draws += cell.num_draws;
    row.num_below += cell.num_below;
    row.num_never += cell.num_never;
    if (cell.not_monotone.empty()) continue;
    row.not_monotone +=
        (row.not_monotone.empty() ? "" : "; ") + cell.object + " " + NameNotMonotone(cell);
  }
  return row;
}

}  // namespace

bool SweepSummary::Shows(size_t measure) const {
  if (!ListSweepMeasures()[measure].threshold) return true;
  return std::any_of(rows.begin(), rows.end(), [&](const ConditionRow& row) {
    return measure < row.medians.size() && !std::isnan(row.medians[measure]);
  });
}

std::vector<SweepEffect> SweepSummary::FindInteractions() const {
  std::vector<SweepEffect> found;
  std::copy_if(interactions.begin(), interactions.end(), std::back_inserter(found),
               [](const SweepEffect& effect) { return effect.excludes_zero(); });
  return found;
}

std::string NameEffect(const SweepEffect& effect) {
  std::string name;
  for (size_t i = 0; i < effect.factors.size(); ++i) {
    name += (i > 0 ? " and " : "") + effect.factors[i] + "=" + effect.levels[i];
  }
  return name;
}

SweepSummary SummariseSweep(const Session& session,
                            const std::vector<ThresholdSummary>& thresholds) {
  SweepSummary summary;
  summary.factors = ListFactors(session.config);
  const std::vector<Treatment> treatments = ListTreatments(session.config, summary.factors);
  const std::map<std::string, std::vector<Draw>> draws =
      ListDraws(session, treatments, ListThresholds(session, thresholds));
  for (const PlannedTrial& planned : session.plan) {
    const auto& hands = summary.hands;
    if (std::find(hands.begin(), hands.end(), planned.hand) != hands.end()) continue;
    summary.hands.push_back(planned.hand);
    AddEffects(treatments, draws.at(planned.hand), planned.hand, summary);
    AddInteractions(treatments, draws.at(planned.hand), planned.hand, summary);
  }
  for (size_t place = 0; place < treatments.size(); ++place) {
    for (const std::string& hand : summary.hands) {
      summary.rows.push_back(MakeRow(treatments[place], place, hand, draws.at(hand), session));
    }
  }
  for (const ThresholdSummary& found : thresholds) {
    for (const ConditionRow& row : summary.rows) {
      summary.thresholds.push_back(SummariseCondition(found, row.name, row.hand));
    }
  }
  return summary;
}

}  // namespace graspbench
