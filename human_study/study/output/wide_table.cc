#include "human_study/study/output/wide_table.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>

#include "core/base/files/files.h"
#include "core/base/text/csv.h"
#include "core/statistics/summary.h"
#include "human_study/study/run/run_study.h"

namespace graspbench {
namespace {

constexpr size_t kMaxName = 64;  // of SPSS

using WidePerson = std::vector<const StudyTrial*>;  // the person's kept trials
using WideColumn = CsvColumn<WidePerson>;

std::vector<WidePerson> ListPersons(const StudyResult& result) {
  std::vector<WidePerson> persons;
  for (const StudyTrial& trial : result.trials) {
    if (!trial.IsKept() || !trial.analysis) continue;
    auto person = std::find_if(persons.begin(), persons.end(), [&](const WidePerson& p) {
      return p.front()->participant == trial.participant;
    });
    if (person == persons.end()) person = persons.insert(persons.end(), WidePerson());
    person->push_back(&trial);
  }
  return persons;
}

/** "diameter_m 0.03, weight_kg 1". */
std::string DescribeCell(const std::vector<Factor>& factors,
                         const std::vector<std::string>& levels) {
  std::string text;
  for (size_t i = 0; i < factors.size(); ++i) {
    text += (i == 0 ? "" : ", ") + factors[i].name + " " + levels[i];
  }
  return text.empty() ? "all trials" : text;
}

std::string JoinLevels(const std::vector<std::string>& levels) {
  std::string text;
  for (const std::string& level : levels) text += "_" + level;
  return text;
}

Json CountTrials(const WidePerson& person, const std::vector<std::string>& levels) {
  return static_cast<int>(std::count_if(
      person.begin(), person.end(), [&](const auto* trial) { return trial->levels == levels; }));
}

Json CalcCellMean(const WidePerson& person, const TrialMeasure& measure,
                  const std::vector<std::string>& levels) {
  std::vector<double> values;
  for (const StudyTrial* trial : person) {
    const double value = measure.value(*trial->analysis);
    if (trial->levels == levels && !std::isnan(value)) values.push_back(value);
  }
  return JsonNumber(CalcMean(values));
}

std::vector<WideColumn> ListWideColumns(const StudyResult& result) {
  const std::vector<Factor>& factors = result.study.factors;
  std::vector<WideColumn> columns = {
      {"participant", "", "who reached",
       [](const WidePerson& person) { return person.front()->participant; }}};
  for (size_t i = 0; i < result.study.groups.size(); ++i) {
    columns.push_back({result.study.groups[i].name, "", "group of the participant",
                       [i](const WidePerson& person) { return person.front()->groups[i]; }});
  }
  const auto add = [&](const std::string& id, const char* type, const std::string& unit,
                       const std::string& meaning, auto value) {
    for (const std::vector<std::string>& levels : ListLevels(factors)) {
      columns.push_back({id + JoinLevels(levels), type, unit,
                         meaning + ": " + DescribeCell(factors, levels),
                         [=](const WidePerson& person) { return value(person, levels); }});
    }
  };
  for (const TrialMeasure& measure : ListStudyMeasures(result.study)) {
    const std::string unit = std::string(measure.unit) == "1" ? "" : measure.unit;
    add(measure.id, "number", unit, std::string("mean of ") + measure.name,
        [measure](const WidePerson& person, const std::vector<std::string>& levels) {
          return CalcCellMean(person, measure, levels);
        });
  }
  add("num_trials", "integer", "", "trials that count", CountTrials);
  std::vector<std::string> texts;
  for (const WideColumn& column : columns) texts.push_back(column.name);
  const std::vector<std::string> names = MakeColumnNames(texts);
  for (size_t i = 0; i < columns.size(); ++i) columns[i].name = names[i];
  return columns;
}

std::string ToUpper(std::string text) {
  for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

}  // namespace

std::vector<std::string> MakeColumnNames(const std::vector<std::string>& texts) {
  std::vector<std::string> names;
  std::set<std::string> taken;
  for (const std::string& text : texts) {
    std::string name;
    for (const char c : text) {
      const auto byte = static_cast<unsigned char>(c);
      if ((byte & 0xC0) == 0x80) continue;  // the rest of a character of several bytes
      name += byte < 0x80 && std::isalnum(byte) != 0 ? c : '_';
    }
    if (name.empty() || std::isalpha(static_cast<unsigned char>(name[0])) == 0) name = "v" + name;
    name.resize(std::min(name.size(), kMaxName));
    std::string unlike = name;
    for (int number = 2; !taken.insert(ToUpper(unlike)).second; ++number) {
      const std::string end = "_" + std::to_string(number);
      unlike = name.substr(0, kMaxName - end.size()) + end;
    }
    names.push_back(unlike);
  }
  return names;
}

void WriteWideTable(const StudyResult& result, const std::filesystem::path& folder) {
  const std::vector<WideColumn> columns = ListWideColumns(result);
  WriteFileAtomically(folder / "wide.csv", FormatCsv(columns, ListPersons(result)));
  WriteFileAtomically(folder / "wide.schema.json",
                      FormatJson(MakeTableSchema(columns, "participant"), 2) + "\n");
}

}  // namespace graspbench
