#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

#include "core/base/text/text.h"
#include "human_study/study/output/statistics_table.h"
#include "reports/study/study_format.h"

namespace graspbench {
namespace {

/** Slopes have no customary display unit and are shown in SI units, as in statistics.csv. */
bool IsSlope(const StatisticRow& row) { return row.unit.find(" per ") != std::string::npos; }

std::string FormatEstimate(double value, const StatisticRow& row) {
  return IsSlope(row) ? FormatSignificant(value, 3) : FormatValue(value, row.unit);
}

/** Returns an empty text for values that do not apply. */
std::string OrNothing(double value, const std::string& text) {
  return std::isnan(value) ? std::string() : text;
}

std::string FormatInterval(const StatisticRow& row) {
  if (std::isnan(row.low)) return "";
  return FormatEstimate(row.low, row) + " to " + FormatEstimate(row.high, row) +
         (row.confidence == 0.95 ? "" : " (" + FormatPercent(row.confidence) + ")");
}

std::string FormatDf(const StatisticRow& row) {
  if (std::isnan(row.df_1)) return "";
  return FormatSignificant(row.df_1, 3) +
         (std::isnan(row.df_2) ? "" : ", " + FormatSignificant(row.df_2, 3));
}

/** Lists the assumptions of each analysis once, with the effects unless they hold for all. */
std::vector<std::string> ListNotes(const std::vector<StatisticRow>& rows,
                                   const std::vector<Factor>& factors) {
  struct Note {
    const StatisticRow* first;
    std::string effects;
    bool is_of_all = true;
  };
  std::vector<Note> notes;
  for (const StatisticRow& row : rows) {
    if (row.note.empty()) continue;
    const auto known = std::find_if(notes.begin(), notes.end(), [&](const Note& note) {
      return note.first->analysis == row.analysis && note.first->note == row.note;
    });
    if (known != notes.end()) {
      known->effects += ", " + NameOfEffect(row.effect, factors);
      continue;
    }
    notes.push_back({&row, NameOfEffect(row.effect, factors)});
  }
  for (Note& note : notes) {
    note.is_of_all = std::all_of(rows.begin(), rows.end(), [&](const StatisticRow& row) {
      return row.analysis != note.first->analysis || row.note == note.first->note;
    });
  }
  std::vector<std::string> texts;
  for (const Note& note : notes) {
    texts.push_back(NameOfEffect(note.first->analysis, factors) +
                    (note.is_of_all ? "" : ", " + note.effects) + ": " +
                    NameOfEffect(note.first->note, factors));
  }
  return texts;
}

bool HasAnswer(const std::vector<StatisticRow>& rows) {
  return std::any_of(rows.begin(), rows.end(), [](const StatisticRow& row) {
    return !std::isnan(row.estimate) || !std::isnan(row.p);
  });
}

/** Notes already printed on the page; they hold for every following table. */
using Said = std::set<std::string>;

Html DrawNotes(const std::vector<StatisticRow>& rows, const std::vector<Factor>& factors,
               Said& said) {
  std::vector<std::string> notes;
  for (std::string& note : ListNotes(rows, factors)) {
    if (said.insert(note).second) notes.push_back(std::move(note));
  }
  return notes.empty() ? Html() : MakeList(notes);
}

/** Tabulates estimates with their basis, or tests; columns without values are left out. */
Html DrawRows(const std::string& caption, const std::vector<StatisticRow>& rows,
              const std::vector<Factor>& factors, Said& said) {
  using Row = StatisticRow;
  if (!HasAnswer(rows)) return MakeParagraph(caption) + MakeList(ListNotes(rows, factors));
  const auto show = [](const char* heading, const char* hint, CsvColumn<Row>::Show cell) {
    return CsvColumn<Row>::ForPeople(heading, hint, std::move(cell));
  };
  const auto estimate = [](double Row::*number) {
    return [number](const Row& row) {
      return OrNothing(row.*number, FormatEstimate(row.*number, row));
    };
  };
  const std::vector<CsvColumn<Row>> columns = {
      show("Effect", "", [&](const Row& row) { return NameOfEffect(row.effect, factors); }),
      show("Analysis", "", [&](const Row& row) { return NameOfEffect(row.analysis, factors); }),
      show("Estimate", "", estimate(&Row::estimate)),
      show("SE", "standard error of the estimate", estimate(&Row::standard_error)),
      show("95 % interval", "", FormatInterval),
      show("Unit", "",
           [](const Row& row) {
             return IsSlope(row) ? FormatSlopeUnit(row.unit)
                                 : std::string(FindDisplayUnit(row.unit).name);
           }),
      show("Test", "",
           [](const Row& row) {
             return OrNothing(row.value, row.statistic + " = " + FormatFixed(row.value, 2));
           }),
      show("df", "degrees of freedom; of effect and error for F", FormatDf),
      show("p", "", [](const Row& row) { return OrNothing(row.p, FormatP(row.p)); }),
      show("p (Holm)", "adjusted over all pairs of conditions",
           [](const Row& row) { return OrNothing(row.p_holm, FormatP(row.p_holm)); }),
      show("Effect size", "", [](const Row& row) {
        return OrNothing(row.effect_size,
                         row.effect_size_name + " " + FormatFixed(row.effect_size, 3));
      })};
  return MakeTable(caption, ShowTable(columns, rows)) + DrawNotes(rows, factors, said);
}

Html DrawConditions(const MeasureStatistics& statistics, Said& said) {
  std::vector<StatisticRow> tests, groups, estimates;
  for (const StatisticRow& row : ListConditionTests(statistics)) {
    const bool is_group = row.effect_size_name == "d_s";
    (is_group ? groups : std::isnan(row.estimate) ? tests : estimates).push_back(row);
  }
  const std::vector<Factor>& factors = statistics.table.factors;
  Html html = DrawRows("Do the conditions differ?", tests, factors, said);
  if (!groups.empty()) html += DrawRows("How far do the groups differ?", groups, factors, said);
  if (!estimates.empty()) {
    html += MakeDetails("Means and spreads of the mixed model",
                        DrawRows("Estimates of the mixed model.", estimates, factors, said));
  }
  if (!statistics.cells) return html;
  for (const LeftOut& person : statistics.cells->left_out) {
    html += MakeParagraph("Included only in the mixed model: " + person.person + " (" +
                          person.reason + ").");
  }
  return html;
}

Html DrawRetest(const MeasureStatistics& statistics, Said& said) {
  const std::vector<StatisticRow> rows = ListRetest(statistics);
  if (rows.empty()) return {};
  Html html = DrawRows("Test-retest reliability", rows, statistics.table.factors, said);
  if (!statistics.retest) return html;
  for (const LeftOut& person : statistics.retest->left_out) {
    html += MakeParagraph("Left out: " + person.person + " (" + person.reason + ").");
  }
  return html;
}

Html DrawLines(const TrendStatistics& trend, const std::string& unit) {
  const std::vector<Column> columns = {"Person",    "Slope",   "SE",
                                       "Intercept", "R\u00B2", {"n", "trials"}};
  Table table("Each person's line over " + NameOfFactor(trend.factor) + ", in SI units (" +
                  FormatSlopeUnit(unit + " per " + trend.factor) + ").",
              columns);
  for (const PersonLine& person : trend.slopes.persons) {
    std::vector<Cell> cells;
    if (person.line) {
      const LineFit& line = *person.line;
      cells = {person.person,
               FormatSignificant(line.slope, 3),
               FormatSignificant(line.slope_error.value_or(std::nan("")), 3),
               FormatSignificant(line.intercept, 3),
               FormatFixed(line.r_squared.value_or(std::nan("")), 3),
               line.count};
    } else {
      cells.assign(columns.size(), Text("n/a"));
      cells.front() = Text(person.person + " (" + person.line.reason() + ")");
    }
    table.AddRow(cells);
  }
  return MakeDetails("Each person's line over " + NameOfFactor(trend.factor), table.ToHtml());
}

/** Describes a study in which nothing can be tested, such as one with a single participant. Each
reason is given once, with what the trials of each participant still show. Empty if something can be
tested. */
Html DrawUntestable(const std::vector<MeasureStatistics>& measures) {
  std::vector<std::string> reasons;
  Html lines;
  for (const MeasureStatistics& statistics : measures) {
    std::vector<StatisticRow> rows = ListConditionTests(statistics);
    for (const auto& list : {ListTrends, ListRetest}) {
      for (const StatisticRow& row : list(statistics)) rows.push_back(row);
    }
    if (HasAnswer(rows)) return {};
    for (const std::string& reason : ListNotes(rows, statistics.table.factors)) {
      if (std::find(reasons.begin(), reasons.end(), reason) == reasons.end()) {
        reasons.push_back(reason);
      }
    }
    for (const TrendStatistics& trend : statistics.trends) {
      lines +=
          Element("h3", {}, statistics.measure.name) + DrawLines(trend, statistics.measure.unit);
    }
  }
  return MakeParagraph("No measure can be tested:") + MakeList(reasons) + lines;
}

Html DrawTrends(const MeasureStatistics& statistics, Said& said) {
  if (statistics.trends.empty()) return {};
  Html html = DrawRows("Trend of the measure with the varied quantity", ListTrends(statistics),
                       statistics.table.factors, said);
  for (const TrendStatistics& trend : statistics.trends) {
    html += DrawLines(trend, statistics.measure.unit);
  }
  return html;
}

Html DrawPairs(const MeasureStatistics& statistics, Said& said) {
  if (statistics.pairs.empty() || statistics.cells->persons.size() < 2) return {};
  return MakeDetails("Pairs of conditions (" + std::to_string(statistics.pairs.size()) + ")",
                     DrawRows("Differences of all pairs of conditions.", ListPairs(statistics),
                              statistics.table.factors, said));
}

Html DrawTests(const StudyPageData& data) {
  const Study& study = data.result.study;
  if (study.factors.empty() && study.groups.empty() && study.sessions.empty()) {
    return MakeParagraph("The study names no factor, so there is no comparison.");
  }
  const Html untestable = DrawUntestable(data.result.statistics.measures);
  if (!untestable.markup().empty()) return untestable;
  Html html = MakeParagraph(
      "statistics.csv contains all results in SI units. Assumptions of each test are stated below "
      "its first table.");
  Said said;
  for (const MeasureStatistics& statistics : data.result.statistics.measures) {
    html += Element("h3", {}, statistics.measure.name);
    if (!study.factors.empty() || !study.groups.empty()) html += DrawConditions(statistics, said);
    html += DrawRetest(statistics, said);
    html += DrawTrends(statistics, said);
    html += DrawPairs(statistics, said);
  }
  return html;
}

}  // namespace

StudySection tests_study_section() { return {"tests", "Tests and trends", DrawTests}; }

}  // namespace graspbench
