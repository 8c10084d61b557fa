#include "human_study/study/output/statistics_table.h"

#include <iterator>
#include <utility>

#include "core/base/enum_table.h"
#include "core/base/text/text.h"

namespace graspbench {
namespace {

std::string Format(double value) { return FormatSignificant(value, 3); }

StatisticRow MakeRow(const MeasureStatistics& statistics, const char* analysis,
                     const std::string& effect) {
  StatisticRow row;
  row.measure = statistics.measure.id;
  row.analysis = analysis;
  row.effect = effect;
  row.unit = statistics.measure.unit;
  return row;
}

/** The interval of a t test and what it rests on. */
void SetTTest(const TTest& test, StatisticRow& row) {
  row.estimate = test.mean;
  row.standard_error = test.standard_deviation / std::sqrt(test.count);
  row.low = test.interval.low;
  row.high = test.interval.high;
  row.statistic = "t";
  row.value = test.t;
  row.df_1 = test.df;
  row.p = test.p;
  row.effect_size_name = "d_z";
  row.effect_size = test.d_z;
  row.num_persons = test.count;
}

void SetBootstrap(const Answer<BootstrapInterval>& bootstrap, size_t num_persons,
                  StatisticRow& row) {
  if (!bootstrap) {
    row.note = "none: " + bootstrap.reason();
    return;
  }
  row.estimate = bootstrap->estimate;
  row.low = bootstrap->interval.low;
  row.high = bootstrap->interval.high;
  row.num_persons = static_cast<int>(num_persons);
  row.note = std::to_string(bootstrap->num_resamples) +
             " draws of persons; no distribution is assumed, but few persons make it too short";
}

/** One line of the analysis of variance: F with the degrees of freedom of one correction. */
StatisticRow MakeAnovaRow(const MeasureStatistics& statistics, const char* analysis,
                          const WithinEffect& effect, double df_effect, double df_error, double p) {
  StatisticRow row = MakeRow(statistics, analysis, effect.name);
  row.unit.clear();
  row.statistic = "F";
  row.value = effect.test->f;
  row.df_1 = df_effect;
  row.df_2 = df_error;
  row.p = p;
  row.effect_size_name = "generalised eta squared";
  row.effect_size = effect.test->generalised_eta_squared;
  row.num_persons = statistics.anova->num_persons;
  return row;
}

void AddAnova(const MeasureStatistics& statistics, std::vector<StatisticRow>& rows) {
  const char* const kAnalysis =
      statistics.table.groups.empty() ? "repeated-measures ANOVA" : "mixed ANOVA (type III)";
  if (!statistics.anova) {
    rows.push_back(MakeRow(statistics, kAnalysis, "condition"));
    rows.back().unit.clear();
    rows.back().note = "none: " + statistics.anova.reason();
    return;
  }
  for (const WithinEffect& effect : statistics.anova->effects) {
    if (!effect.test) {
      rows.push_back(MakeRow(statistics, kAnalysis, effect.name));
      rows.back().unit.clear();
      rows.back().note = "none: " + effect.test.reason();
      continue;
    }
    const WithinTest& test = *effect.test;
    rows.push_back(
        MakeAnovaRow(statistics, kAnalysis, effect, effect.df_effect, effect.df_error, test.p));
    if (effect.factors.empty()) {
      rows.back().note =
          "assumes persons' means that are normal with one spread in all groups; partial eta "
          "squared " +
          Format(test.partial_eta_squared);
      continue;
    }
    rows.back().note = "assumes normal differences and sphericity; partial eta squared " +
                       Format(test.partial_eta_squared);
    rows.back().note +=
        test.mauchly ? "; Mauchly's W " + Format(test.mauchly->w) + ", p " + Format(test.mauchly->p)
                     : "; no test of sphericity: " + test.mauchly.reason();
    const auto add_corrected = [&](const char* analysis, const CorrectedF& corrected) {
      rows.push_back(MakeAnovaRow(statistics, analysis, effect, corrected.df_effect,
                                  corrected.df_error, corrected.p));
      rows.back().note = "sphericity is not assumed; epsilon " + Format(corrected.epsilon);
    };
    add_corrected("ANOVA, Greenhouse-Geisser", test.greenhouse_geisser);
    if (test.huynh_feldt) add_corrected("ANOVA, Huynh-Feldt", *test.huynh_feldt);
  }
}

void AddSlopes(const MeasureStatistics& statistics, const TrendStatistics& trend,
               std::vector<StatisticRow>& rows) {
  const std::string effect = "slope over " + trend.factor;
  rows.push_back(MakeRow(statistics, "persons' slopes, t test", effect));
  if (trend.slopes.test) {
    SetTTest(*trend.slopes.test, rows.back());
    rows.back().effect_size_name.clear();
    rows.back().effect_size = std::nan("");  // a slope is its own
    rows.back().note = "assumes slopes that are normal over persons; tested against " +
                       Format(trend.slopes.test->reference);
  } else {
    rows.back().note = "none: " + trend.slopes.test.reason();
  }
  rows.push_back(MakeRow(statistics, "persons' slopes, BCa bootstrap", effect));
  const size_t num_slopes = trend.slopes.test ? static_cast<size_t>(trend.slopes.test->count) : 0;
  SetBootstrap(trend.bootstrap, num_slopes, rows.back());
  for (size_t i = rows.size() - 2; i < rows.size(); ++i) rows[i].unit += " per " + trend.factor;
}

/** The slope of the mixed model over all trials. */
void AddModelSlope(const MeasureStatistics& statistics, const TrendStatistics& trend,
                   std::vector<StatisticRow>& rows) {
  rows.push_back(MakeRow(statistics, "mixed model (REML)", "slope over " + trend.factor));
  StatisticRow& row = rows.back();
  row.unit = std::string(statistics.measure.unit) + " per " + trend.factor;
  const Answer<SlopeEstimate> slope =
      trend.model ? trend.model->slope : Answer<SlopeEstimate>(trend.model.none());
  if (!slope) {
    row.note = "none: " + slope.reason();
    return;
  }
  row.estimate = slope->estimate;
  row.standard_error = slope->standard_error;
  row.statistic = "t";
  row.value = slope->t;
  row.num_persons = trend.model->num_persons;
  if (!slope->test) {
    row.note = "no test: " + slope->test.reason();
    return;
  }
  row.df_1 = slope->test->df;
  row.p = slope->test->p;
  row.low = slope->test->interval.low;
  row.high = slope->test->interval.high;
  row.note = "all " + std::to_string(trend.model->num_observations) + " trials, " +
             DescribeRandom(*trend.model) +
             "; assumes normal persons and residuals; df after Satterthwaite; tested against " +
             Format(slope->reference);
}

/** F of every effect, the parts that vary and what the conditions' means are. */
void AddEffectsModel(const MeasureStatistics& statistics, const Answer<EffectsModel>& model,
                     const char* analysis, std::vector<StatisticRow>& rows) {
  const auto add = [&](const std::string& effect) -> StatisticRow& {
    rows.push_back(MakeRow(statistics, analysis, effect));
    if (model) rows.back().num_persons = model->num_persons;
    return rows.back();
  };
  if (!model) {
    StatisticRow& row = add("condition");
    row.unit.clear();
    row.note = "none: " + model.reason();
    return;
  }
  for (const EffectTest& effect : model->effects) {
    StatisticRow& row = add(effect.name);
    row.unit.clear();
    if (!effect.test) {
      row.note = "none: " + effect.test.reason();
      continue;
    }
    row.statistic = "F";
    row.value = effect.test->f;
    row.df_1 = effect.test->df_1;
    row.df_2 = effect.test->df_2;
    row.p = effect.test->p;
    row.note = "all " + FormatCount(model->num_observations, "trial") +
               ", also of persons with an empty condition; type III, df after Satterthwaite; "
               "assumes normal persons and residuals; " +
               DescribeRandom(*model);
  }
  for (const CellEstimate& cell : model->cells) {
    StatisticRow& row = add("mean in " + (cell.cell.empty() ? "all trials" : cell.cell));
    row.estimate = cell.estimate;
    row.standard_error = cell.standard_error;
    if (!cell.test) continue;
    row.df_1 = cell.test->df;
    const Interval interval = CutAt(FindPossible(statistics.measure), cell.test->interval);
    row.low = interval.low;
    row.high = interval.high;
    row.note = "every person and group weighs the same";
  }
  for (const RandomPart& part : model->random) {
    StatisticRow& row = add("SD of " + part.name);
    row.estimate = part.sd;
    const std::string slope = "slope over ";
    if (part.name.rfind(slope, 0) == 0) row.unit += " per " + part.name.substr(slope.size());
  }
  add("SD of trials").estimate = model->residual_sd;
}

/** At what a difference of two means can be. */
void CutDifference(const MeasureStatistics& statistics, StatisticRow& row) {
  const Interval cut = CutAt(FindPossibleDifference(statistics.measure), {row.low, row.high});
  row.low = cut.low;
  row.high = cut.high;
}

void AddGroups(const MeasureStatistics& statistics, std::vector<StatisticRow>& rows) {
  for (const GroupComparison& pair : statistics.group_pairs) {
    const Factor& group = statistics.table.groups[pair.group];
    rows.push_back(
        MakeRow(statistics, "Welch t test of groups",
                group.name + ": " + group.levels[pair.b] + " minus " + group.levels[pair.a]));
    StatisticRow& row = rows.back();
    if (!pair.test) {
      row.note = "none: " + pair.test.reason();
      continue;
    }
    row.estimate = pair.test->difference;
    row.standard_error = pair.test->standard_error;
    row.low = pair.test->interval.low;
    row.high = pair.test->interval.high;
    CutDifference(statistics, row);
    row.statistic = "t";
    row.value = pair.test->t;
    row.df_1 = pair.test->df;
    row.p = pair.test->p;
    row.p_holm = pair.p_holm;
    row.effect_size_name = "d_s";
    row.effect_size = pair.test->d_s;
    row.num_persons = pair.test->count_a + pair.test->count_b;
    row.note = "persons' means over all conditions, normal within groups whose spread may differ";
  }
}

void AddShifts(const MeasureStatistics& statistics, const Retest& retest,
               std::vector<StatisticRow>& rows) {
  for (const SessionShift& shift : retest.shifts) {
    rows.push_back(
        MakeRow(statistics, "test-retest, shift (paired t test)",
                "session " + retest.sessions[shift.b] + " minus " + retest.sessions[shift.a]));
    if (shift.test) {
      SetTTest(*shift.test, rows.back());
      CutDifference(statistics, rows.back());
      rows.back().note = "assumes normal differences";
    } else {
      rows.back().note = "none: " + shift.test.reason();
    }
  }
}

void AddPair(const MeasureStatistics& statistics, const PairStatistics& pair,
             std::vector<StatisticRow>& rows) {
  const std::vector<std::string>& cells = statistics.cells->cells;
  const std::string effect = cells[pair.means.b] + " - " + cells[pair.means.a];
  rows.push_back(MakeRow(statistics, "paired t test", effect));
  if (pair.means.test) {
    SetTTest(*pair.means.test, rows.back());
    CutDifference(statistics, rows.back());
    rows.back().p_holm = pair.means.p_holm;
    rows.back().note = "assumes normal differences; the interval is not adjusted";
  } else {
    rows.back().note = "none: " + pair.means.test.reason();
  }
  rows.push_back(MakeRow(statistics, "Wilcoxon signed ranks", effect));
  if (pair.ranks) {
    StatisticRow& row = rows.back();
    row.unit.clear();
    row.statistic = "W+";
    row.value = pair.ranks->w_plus;
    row.p = pair.ranks->p;
    row.p_holm = pair.p_ranks_holm;
    row.effect_size_name = "rank-biserial r";
    row.effect_size = pair.ranks->rank_biserial;
    row.num_persons = pair.ranks->count;
    row.note = "exact; assumes differences that are symmetric about their median";
    if (pair.ranks->num_zeros > 0) {
      row.note +=
          "; without " + FormatCount(pair.ranks->num_zeros, "person") + " who did not differ";
    }
  } else {
    rows.back().note = "none: " + pair.ranks.reason();
  }
  rows.push_back(MakeRow(statistics, "BCa bootstrap of the mean", effect));
  SetBootstrap(pair.bootstrap, statistics.cells->persons.size(), rows.back());
  if (std::isnan(statistics.hypothesis.equal_within)) return;
  rows.push_back(MakeRow(statistics, "equivalence, two one-sided t tests", effect));
  if (pair.equivalence) {
    StatisticRow& row = rows.back();
    SetTTest(*pair.means.test, row);
    row.low = pair.equivalence->interval.low;
    row.high = pair.equivalence->interval.high;
    CutDifference(statistics, row);
    row.confidence = 0.9;
    const bool is_low = pair.equivalence->p_low > pair.equivalence->p_high;
    row.value = is_low ? pair.equivalence->t_low : pair.equivalence->t_high;
    row.p = pair.equivalence->p;
    row.note = "assumes normal differences; a small p says that the means differ by less than " +
               Format(statistics.hypothesis.equal_within) + " " + statistics.measure.unit;
  } else {
    rows.back().note = "none: " + pair.equivalence.reason();
  }
}

}  // namespace

std::vector<StatisticRow> ListConditionTests(const MeasureStatistics& statistics) {
  std::vector<StatisticRow> rows;
  AddAnova(statistics, rows);
  AddEffectsModel(statistics, statistics.model, "mixed model (REML), all factors", rows);
  AddGroups(statistics, rows);
  if (statistics.table.factors.empty()) return rows;
  rows.push_back(MakeRow(statistics, "Friedman", "condition"));
  StatisticRow& row = rows.back();
  row.unit.clear();
  if (!statistics.friedman) {
    row.note = "none: " + statistics.friedman.reason();
    return rows;
  }
  row.statistic = "chi squared";
  row.value = statistics.friedman->chi_squared;
  row.df_1 = statistics.friedman->df;
  row.p = statistics.friedman->p;
  row.effect_size_name = "Kendall's W";
  row.effect_size = statistics.friedman->kendall_w;
  row.num_persons = statistics.friedman->num_persons;
  row.note =
      "ranks within persons, no distribution is assumed; all conditions as one factor; "
      "rough below 10 persons";
  return rows;
}

std::vector<StatisticRow> ListTrends(const MeasureStatistics& statistics) {
  std::vector<StatisticRow> rows;
  for (const TrendStatistics& trend : statistics.trends) {
    AddSlopes(statistics, trend, rows);
    AddModelSlope(statistics, trend, rows);
    if (statistics.table.groups.empty()) continue;
    const std::string analysis = "mixed model (REML), " + trend.factor + " as a quantity";
    AddEffectsModel(statistics, trend.model, analysis.c_str(), rows);
  }
  return rows;
}

std::vector<StatisticRow> ListRetest(const MeasureStatistics& statistics) {
  std::vector<StatisticRow> rows;
  if (statistics.table.sessions.empty()) return rows;
  const auto add = [&](const char* effect) -> StatisticRow& {
    rows.push_back(MakeRow(statistics, "test-retest", effect));
    return rows.back();
  };
  const Answer<Retest>& retest = statistics.retest;
  if (!retest || !retest->reliability) {
    add("between sessions").note =
        "none: " + (retest ? retest->reliability : Answer<Reliability>(retest.none())).reason();
    if (retest) AddShifts(statistics, *retest, rows);
    return rows;
  }
  const Reliability& reliability = *retest->reliability;
  const auto add_icc = [&](const Answer<IccPair>& icc, const char* effect, const char* note) {
    StatisticRow& row = add(effect);
    row.unit = "1";
    row.num_persons = reliability.num_persons;
    row.note = icc ? note : "none: " + icc.reason();
    if (!icc) return;
    row.estimate = icc->single.value;
    row.low = icc->single.interval.low;
    row.high = icc->single.interval.high;
  };
  add_icc(reliability.agreement, "ICC(2,1)",
          "of one session's mean over its conditions; a shift between sessions counts as error");
  add_icc(reliability.consistency, "ICC(3,1)", "the same; a shift between sessions does not count");
  StatisticRow& sem = add("SEM");
  sem.estimate = reliability.within_person_sd;
  sem.low = reliability.within_person_interval.low;
  sem.high = reliability.within_person_interval.high;
  sem.num_persons = reliability.num_persons;
  sem.note = "standard deviation of a person's sessions";
  StatisticRow& change = add("minimal detectable change");
  change.estimate = reliability.minimal_detectable_change;
  change.num_persons = reliability.num_persons;
  change.note = "two sessions that differ by less may be equal";
  AddShifts(statistics, *retest, rows);
  return rows;
}

std::vector<StatisticRow> ListPairs(const MeasureStatistics& statistics) {
  std::vector<StatisticRow> rows;
  for (const PairStatistics& pair : statistics.pairs) AddPair(statistics, pair, rows);
  return rows;
}

std::vector<StatisticRow> ListOpenings(const OpeningFamily& family) {
  std::vector<StatisticRow> rows;
  for (size_t i = 1; i < family.rows.size(); ++i) {
    for (size_t k = 0; k < kNumOpeningCriteria; ++k) {
      const OpeningComparison& comparison = family.rows[i].against_aperture[k];
      StatisticRow row;
      row.measure = std::string("open_") + family.rows[i].opening->id + "_m";
      row.analysis = "reliability against the aperture, jackknife";
      row.effect = ListOpeningCriteria()[k].id;
      row.unit = "1";
      if (!comparison.no_answer.empty()) {
        row.note = "none: " + comparison.no_answer;
      } else {
        row.estimate = comparison.ratio;
        row.low = comparison.low;
        row.high = comparison.high;
        row.p = comparison.p;
        row.p_holm = comparison.p_holm;
        row.num_persons = comparison.num_persons;
        row.note = "criterion over the aperture's, above 1 is more reliable; persons left out";
      }
      rows.push_back(row);
    }
  }
  return rows;
}

namespace {

/** Over persons, as the interval is; else that of the means over all trials. */
double EstimateRatio(const IndependenceTest& test) {
  return test.over_persons ? std::exp(test.over_persons->estimate) : test.observed / test.expected;
}

}  // namespace

std::vector<StatisticRow> ListIndependence(const Answer<IndependenceNull>& null) {
  std::vector<StatisticRow> rows;
  const auto add = [&](const char* measure,
                       std::array<IndependenceTest, kNumClocks> IndependenceNull::*tests) {
    for (size_t clock = 0; clock < kNumClocks; ++clock) {
      StatisticRow row;
      row.measure = measure;
      row.analysis = "independent digits, by permutation";
      row.effect =
          std::string("mean over that of independent digits, clock ") + ListClocks()[clock];
      row.unit = "1";
      if (!null) {
        row.note = "none: " + null.reason();
        rows.push_back(row);
        continue;
      }
      const IndependenceTest& test = ((*null).*tests)[clock];
      row.estimate = EstimateRatio(test);
      row.p = test.p;
      row.num_persons = null->num_persons;
      row.note = "mean " + Format(test.observed) + ", independent digits " + Format(test.expected) +
                 " (95 % of 999 permutations " + Format(test.low) + " to " + Format(test.high) +
                 "); a reduction by " + Format(test.detectable) + " is found in 8 of 10 studies";
      if (test.over_persons) {
        row.low = std::exp(test.over_persons->interval.low);
        row.high = std::exp(test.over_persons->interval.high);
        row.note += "; estimate and interval over persons";
      }
      rows.push_back(row);
    }
  };
  add("grasp_forming_time_s", &IndependenceNull::gft);
  add("grasp_forming_ratio", &IndependenceNull::gft_ratio);
  return rows;
}

std::vector<StatisticRow> ListIndependenceVerdicts(const Answer<IndependenceNull>& null) {
  std::vector<StatisticRow> rows;
  const auto add = [&](const char* measure,
                       std::array<IndependenceTest, kNumClocks> IndependenceNull::*member) {
    StatisticRow row;
    row.measure = measure;
    row.analysis = kIndependenceVerdictAnalysis;
    row.effect = "not testable";
    row.unit = "1";
    row.note = null ? SayIndependence(null) : "none: independence was not calculated";
    if (null) {
      const auto& tests = (*null).*member;
      const IndependenceTest& test = tests[IndependenceNull::FindStrictest(tests)];
      row.effect = RowOf(kIndependenceVerdicts, null->Judge(tests)).name;
      row.estimate = EstimateRatio(test);
      for (const IndependenceTest& one : tests) {
        if (!one.over_persons) continue;
        row.low = std::fmin(row.low, std::exp(one.over_persons->interval.low));
        row.high = std::fmax(row.high, std::exp(one.over_persons->interval.high));
      }
      row.statistic = "mean";
      row.value = test.observed;
      row.p = test.p;
      row.effect_size_name = "reduction that is found in 8 of 10 studies";
      row.effect_size = test.detectable;
      row.num_persons = null->num_persons;
      row.note = FormatCount(null->num_trials, "trial") + ", " +
                 std::to_string(null->num_incomplete) +
                 " left out because a digit or a clock is missing; estimate of the clock with the "
                 "least evidence for a difference, interval from the lowest to the highest limit "
                 "of all clocks, over persons. " +
                 row.note;
    }
    rows.push_back(row);
  };
  add("grasp_forming_time_s", &IndependenceNull::gft);
  add("grasp_forming_ratio", &IndependenceNull::gft_ratio);
  return rows;
}

std::vector<StatisticRow> ListStatistics(const StudyStatistics& statistics) {
  std::vector<StatisticRow> all;
  const auto add = [&](std::vector<StatisticRow> rows) {
    std::move(rows.begin(), rows.end(), std::back_inserter(all));
  };
  for (const MeasureStatistics& measure : statistics.measures) {
    add(ListRetest(measure));
    if (measure.table.factors.empty() && measure.table.groups.empty()) continue;
    for (const auto& list : {ListConditionTests, ListTrends, ListPairs}) add(list(measure));
  }
  add(ListOpenings(statistics.openings));
  add(ListIndependence(statistics.independence));
  add(ListIndependenceVerdicts(statistics.independence));
  return all;
}

std::vector<CsvColumn<StatisticRow>> ListStatisticColumns() {
  using R = StatisticRow;
  return {
      {"measure", "", "id, as in measures.csv", &R::measure},
      {"analysis", "", "how it was computed", &R::analysis},
      {"effect", "", "what is tested or estimated", &R::effect},
      {"unit", "", "of the estimate; 1 for a ratio", &R::unit},
      {"estimate", "", "difference, slope, ..", &R::estimate},
      {"standard_error", "", "of the estimate", &R::standard_error},
      {"low", "", "lower end of the interval", &R::low},
      {"high", "", "upper end of the interval", &R::high},
      {"confidence", "", "of the interval; empty without one",
       [](const R& row) { return std::isnan(row.low) ? row.low : row.confidence; }},
      {"statistic", "", "F, t, chi squared or W+", &R::statistic},
      {"value", "", "of the statistic", &R::value},
      {"df_1", "", "degrees of freedom; of the effect for F", &R::df_1},
      {"df_2", "", "degrees of freedom of the error for F", &R::df_2},
      {"p", "", "two-sided; not adjusted for several tests", &R::p},
      {"p_holm", "", "adjusted over the family of the analysis", &R::p_holm},
      {"effect_size_name", "", "which effect size", &R::effect_size_name},
      {"effect_size", "", "its value", &R::effect_size},
      {"num_persons", "integer", "", "persons that took part; empty without an answer",
       [](const R& row) { return row.num_persons > 0 ? Json(row.num_persons) : Json(); }},
      {"note", "", "what it assumes, or why there is no answer", &R::note},
  };
}

}  // namespace graspbench
