#include "human_study/statistics/tidy_export.h"

#include <algorithm>

#include "core/base/files/files.h"
#include "core/base/text/csv.h"
#include "core/base/text/json.h"
#include "human_study/statistics/assets.h"

namespace graspbench {

namespace {

std::string QuoteForR(const std::string& text) {
  std::string quoted = "\"";
  for (char letter : text) {
    if (letter == '"' || letter == '\\') quoted += '\\';
    quoted += letter == '\n' ? ' ' : letter;
  }
  return quoted + "\"";
}

std::string FormatList(const std::vector<std::string>& texts) {
  std::string joined;
  for (const std::string& text : texts) joined += (joined.empty() ? "" : ", ") + QuoteForR(text);
  return joined.empty() ? std::string("character(0)") : "c(" + joined + ")";
}

std::string FormatNumbers(const std::vector<Hypothesis>& hypotheses, double Hypothesis::*field) {
  std::string joined;
  for (const Hypothesis& hypothesis : hypotheses) {
    const double value = hypothesis.*field;
    joined += (joined.empty() ? "" : ", ") + QuoteForR(hypothesis.measure) + " = " +
              (std::isnan(value) ? std::string("NA") : FormatJson(Json(value)));
  }
  return "c(" + (joined.empty() ? "none = NA" : joined) + ")";
}

}  // namespace

std::string FormatRScript(const MeasureTable& table, const std::vector<Hypothesis>& hypotheses) {
  std::vector<std::string> names, quantities, groups;
  std::string levels;
  for (const auto* list : {&table.factors, &table.groups}) {
    for (const Factor& factor : *list) {
      (list == &table.groups ? groups : names).push_back(factor.name);
      levels += std::string(levels.empty() ? "" : ",") + "\n  " + QuoteForR(factor.name) + " = " +
                FormatList(factor.levels);
    }
  }
  for (const Factor& factor : table.factors) {
    if (!factor.numbers.empty()) quantities.push_back(factor.name);
  }
  return "# Repeats the statistics of this study from tidy.csv. Run it in the folder it lies in:\n"
         "#   Rscript analysis.R\n"
         "# Base R does most of it; lme4 and lmerTest add the mixed models where they are "
         "installed.\n"
         "factors <- " +
         FormatList(names) + "\ngroups <- " + FormatList(groups) + "  # between persons\n" +
         "quantities <- " + FormatList(quantities) + "  # factors with numbers\n" +
         "levels_of <- list(" + levels + ")\nsession <- " + QuoteForR(kSessionColumn) +
         "\nsessions <- " + FormatList(table.sessions) +
         "\n# What is tested against, by measure.\nslope_of <- " +
         FormatNumbers(hypotheses, &Hypothesis::slope) + "\nequal_within <- " +
         FormatNumbers(hypotheses, &Hypothesis::equal_within) + "\n\n" +
         std::string(assets::kAnalysisR);
}

namespace {

struct TidyRow {
  const MeasureTable* table;
  const Observation* trial;
};

std::vector<TidyRow> ListRows(const std::vector<MeasureTable>& measures) {
  std::vector<TidyRow> rows;
  for (const MeasureTable& table : measures) {
    for (const Observation& trial : table.rows) rows.push_back({&table, &trial});
  }
  return rows;
}

using Column = CsvColumn<TidyRow>;

std::vector<Column> ListColumns(const MeasureTable& first) {
  const std::vector<Factor>& factors = first.factors;
  std::vector<Column> columns = {
      {"person", "", "who reached", [](const TidyRow& row) { return row.trial->person; }},
      {"trial", "", "which of the person's trials",
       [](const TidyRow& row) { return row.trial->trial; }}};
  for (size_t i = 0; i < factors.size(); ++i) {
    const Factor& factor = factors[i];
    columns.push_back(
        {factor.name, "",
         factor.description.empty() ? "varied within each person" : factor.description,
         [i](const TidyRow& row) { return row.trial->levels[i]; }});
    if (factor.numbers.empty()) continue;
    columns.push_back({factor.name + "_number", "",
                       "the level of \"" + factor.name + "\" as a quantity, in SI units",
                       [i](const TidyRow& row) {
                         const Factor& own = row.table->factors[i];
                         const auto level =
                             std::find(own.levels.begin(), own.levels.end(), row.trial->levels[i]);
                         return own.numbers[static_cast<size_t>(level - own.levels.begin())];
                       }});
  }
  for (size_t i = 0; i < first.groups.size(); ++i) {
    columns.push_back({first.groups[i].name, "", "group of the person",
                       [i](const TidyRow& row) { return row.trial->groups[i]; }});
  }
  if (!first.sessions.empty()) {
    columns.push_back({kSessionColumn, "", "session of the trial",
                       [](const TidyRow& row) { return row.trial->session; }});
  }
  columns.push_back(
      {"measure", "", "what was measured", [](const TidyRow& row) { return row.table->measure; }});
  columns.push_back({"value", "", "of the measure in this trial, in the measure's unit",
                     [](const TidyRow& row) { return row.trial->value; }});
  return columns;
}

void CheckMeasures(const std::vector<MeasureTable>& measures) {
  const std::vector<Column> columns = ListColumns(measures.front());
  for (auto column = columns.begin(); column != columns.end(); ++column) {
    const auto has_name = [&](const Column& other) { return other.name == column->name; };
    if (std::any_of(columns.begin(), column, has_name)) {
      throw Error(ErrorKind::kFormat,
                  "tidy.csv would have two columns \"" + column->name + "\"; rename the factor");
    }
  }
  for (const MeasureTable& table : measures) {
    const auto is_same = [](const Factor& a, const Factor& b) {
      return a.name == b.name && a.levels == b.levels && a.numbers == b.numbers;
    };
    const auto& first = measures.front();
    if (!std::equal(table.factors.begin(), table.factors.end(), first.factors.begin(),
                    first.factors.end(), is_same)) {
      throw Error(ErrorKind::kFormat, "measures \"" + first.measure + "\" and \"" + table.measure +
                                          "\" have different factors; export them apart");
    }
    for (const Observation& row : table.rows) {
      const Answer<size_t> cell = FindCell(table.factors, row);
      if (!cell)
        throw Error(ErrorKind::kFormat, "measure \"" + table.measure + "\": " + cell.reason());
      const Answer<std::vector<size_t>> groups = FindGroups(table.groups, row);
      if (!groups)
        throw Error(ErrorKind::kFormat, "measure \"" + table.measure + "\": " + groups.reason());
    }
  }
}

std::string FormatDictionary(const std::vector<MeasureTable>& measures) {
  Json schema = MakeTableSchema(ListColumns(measures.front()), "");
  for (Json& field : schema["fields"]) {
    for (const Factor& factor : measures.front().factors) {
      if (field["name"] == factor.name) field["constraints"]["enum"] = factor.levels;
    }
  }
  for (const MeasureTable& table : measures) {
    schema["measures"].push_back(
        {{"name", table.measure}, {"unit", table.unit}, {"description", table.description}});
  }
  return FormatJson(schema, 2) + "\n";
}

}  // namespace

TidyExport FormatTidyExport(const std::vector<MeasureTable>& measures,
                            const std::vector<Hypothesis>& hypotheses) {
  if (measures.empty()) throw Error(ErrorKind::kFormat, "no measure to export");
  CheckMeasures(measures);
  return {FormatCsv(ListColumns(measures.front()), ListRows(measures)), FormatDictionary(measures),
          FormatRScript(measures.front(), hypotheses)};
}

void SaveTidyExport(const std::vector<MeasureTable>& measures, const std::filesystem::path& folder,
                    const std::vector<Hypothesis>& hypotheses) {
  const TidyExport files = FormatTidyExport(measures, hypotheses);
  MakeFolder(folder);
  WriteFileAtomically(folder / "tidy.csv", files.csv);
  WriteFileAtomically(folder / "tidy.json", files.dictionary);
  WriteFileAtomically(folder / "analysis.R", files.r_script);
}

}  // namespace graspbench
