#include "human_study/study/output/study_tables.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>

#include "core/base/files/files.h"
#include "core/base/text/csv.h"
#include "core/statistics/summary.h"
#include "human_study/study/output/statistics_table.h"
#include "human_study/study/run/run_study.h"
#include "human_study/study/run/trial_removal.h"

namespace graspbench {

namespace {

using TrialColumns = std::vector<CsvColumn<const StudyTrial*>>;

void AddDesign(const StudyResult& result, TrialColumns& columns) {
  columns.push_back({"trial_id", "", "participant and trial", &StudyTrial::id});
  columns.push_back({"participant", "", "who reached", &StudyTrial::participant});
  for (size_t i = 0; i < result.study.factors.size(); ++i) {
    const Factor& factor = result.study.factors[i];
    const bool is_number = !factor.numbers.empty();
    columns.push_back({factor.name, is_number ? "number" : "string", "", "factor of the design",
                       [i, is_number](const StudyTrial* trial) {
                         const std::string& level = trial->levels[i];
                         return is_number ? Json::try_parse(level) : Json(level);
                       }});
  }
  for (size_t i = 0; i < result.study.groups.size(); ++i) {
    columns.push_back({result.study.groups[i].name, "", "group of the participant",
                       [i](const StudyTrial* trial) { return trial->groups[i]; }});
  }
  const std::string& session = result.study.config.session;
  const bool is_factor =
      std::any_of(columns.begin(), columns.end(), [&](const auto& c) { return c.name == session; });
  if (!session.empty() && !is_factor) {
    columns.push_back({session, "", "session", &StudyTrial::session});
  }
}

TrialColumns ListTrialColumns(const StudyResult& result) {
  TrialColumns columns;
  AddDesign(result, columns);
  columns.push_back({"trial", "", "label within the participant", &StudyTrial::trial});
  columns.push_back({"file", "", "recording", &StudyTrial::file});
  columns.push_back({"object", "", "what was grasped", &StudyTrial::object});
  columns.push_back({"begin_s", "s", "first sample on the recording's clock", &StudyTrial::begin});
  columns.push_back({"end_s", "s", "last sample on the recording's clock", &StudyTrial::end});
  columns.push_back({"is_kept", "", "1 when the trial counts",
                     [](const StudyTrial* trial) { return trial->IsKept(); }});
  columns.push_back(
      {"removed", "", "why it does not count; empty when it does", &StudyTrial::removed});
  columns.push_back({"removed_code", "", "the same for programs", &StudyTrial::removed_code});
  columns.push_back(
      {"flags", "",
       "what is doubtful about it, as regrasp, with commas; empty: nothing, or it was "
       "not analysed",
       [](const StudyTrial* trial) {
         return trial->analysis ? FormatFlags(*trial->analysis) : "";
       }});
  columns.push_back({"reviewed", "", "contacts that a person looked at; empty: none",
                     [](const StudyTrial* trial) { return DescribeReviews(trial->reviews); }});
  return columns;
}

/** One column a digit; NaN where a trial lacks it. */
void AddTipNoise(const StudyResult& result, TrialColumns& columns) {
  for (const std::string& digit : result.digits) {
    columns.push_back({"tip_noise_" + digit + "_m", "m",
                       "noise of the unfiltered tip against the object about the hold, SD of a "
                       "coordinate",
                       [digit](const StudyTrial* trial) {
                         double noise = std::nan("");
                         for (const DigitContactEvents& events : trial->analysis->contacts) {
                           if (events.digit == digit) noise = events.noise_O;
                         }
                         return noise;
                       }});
  }
}

void AddOpenings(TrialColumns& columns) {
  for (size_t i = 0; i < HandOpeningList().size(); ++i) {
    const std::string id = HandOpeningList()[i].id;
    columns.push_back({"open_" + id + "_m", "m",
                       "largest opening by " + id + " before the last contact",
                       [i](const StudyTrial* trial) { return trial->openings[i].open; }});
    columns.push_back({"closed_" + id + "_m", "m", "opening by " + id + " at the last contact",
                       [i](const StudyTrial* trial) { return trial->openings[i].closed; }});
  }
}

TrialColumns ListMeasureColumns(const StudyResult& result) {
  TrialColumns columns;
  AddDesign(result, columns);
  for (const TrialMeasure& measure : TrialMeasureList()) {
    const std::string unit = std::string(measure.unit) == "1" ? "" : measure.unit;
    columns.push_back({measure.id, unit, measure.name, [measure](const StudyTrial* trial) {
                         return measure.value(*trial->analysis);
                       }});
  }
  const auto uncertainty = [](double TrialAnalysis::*field) {
    return [field](const StudyTrial* trial) { return (*trial->analysis).*field; };
  };
  columns.push_back({"grasp_forming_time_uncertainty_s", "s",
                     "standard uncertainty of grasp_forming_time_s",
                     uncertainty(&TrialAnalysis::gft_uncertainty)});
  columns.push_back({"grasp_opposing_time_uncertainty_s", "s",
                     "standard uncertainty of grasp_opposing_time_s",
                     uncertainty(&TrialAnalysis::got_uncertainty)});
  columns.push_back({"grasp_closure_time_uncertainty_s", "s",
                     "standard uncertainty of grasp_closure_time_s",
                     uncertainty(&TrialAnalysis::gct_uncertainty)});
  AddTipNoise(result, columns);
  AddOpenings(columns);
  columns.push_back({"num_digits_touching", "", "digits with a contact",
                     [](const StudyTrial* trial) { return trial->analysis->num_touching; }});
  columns.push_back(
      {"num_unverified_touches", "",
       "contacts of which neither the object's shape nor a force shows that the digit touched",
       [](const StudyTrial* trial) { return trial->analysis->num_unverified; }});
  columns.push_back({"contact_order", "",
                     "digits by first contact; = joins those the data cannot separate",
                     [](const StudyTrial* trial) { return trial->analysis->order.Format(); }});
  columns.push_back({"used_filled", "", "an event was decided on filled samples",
                     [](const StudyTrial* trial) { return trial->analysis->used_filled; }});
  columns.push_back({"used_gap", "", "an event fell into a gap",
                     [](const StudyTrial* trial) { return trial->analysis->used_gap; }});
  columns.push_back(
      {"contact_before_start", "", "a digit touched before the widest opening",
       [](const StudyTrial* trial) { return trial->analysis->timing.contact_before_start; }});
  columns.push_back(
      {"ambiguous_opening", "", "the largest and the last maximum of the opening differ",
       [](const StudyTrial* trial) { return trial->analysis->peak_opening.is_ambiguous; }});
  return columns;
}

std::vector<CsvColumn<StudyEvent>> ListEventColumns() {
  return {
      {"trial_id", "", "participant and trial",
       [](const StudyEvent& event) { return event.trial->id; }},
      {"event", "", "what happened", &StudyEvent::name},
      {"digit", "", "TH, FF, MF, RF or LF; empty where none is meant", &StudyEvent::digit},
      {"detector", "", "how it was found; empty for events with one rule", &StudyEvent::detector},
      {"is_believed", "", "1 for the event that the measures rest on", &StudyEvent::is_believed},
      {"time_s", "s", "on the recording's clock; empty when not found",
       [](const StudyEvent& event) { return event.event.time; }},
      {"uncertainty_s", "s",
       "standard uncertainty of the instant by its rule; of onset, end and lift-off not how far "
       "the rule's threshold lags the motion's beginning: movement_start is that beginning, "
       "extrapolated, and onset_lag_s of measures.csv the lag",
       [](const StudyEvent& event) { return event.event.uncertainty; }},
      {"is_filled", "", "decided on filled samples",
       [](const StudyEvent& event) { return event.event.is_filled; }},
      {"is_in_gap", "", "fell into a gap; the time is its middle",
       [](const StudyEvent& event) { return event.event.is_in_gap; }},
      {"missing", "", "why it was not found",
       [](const StudyEvent& event) { return event.event.missing; }},
  };
}

template <class Row>
void WriteDictionary(const std::filesystem::path& folder, const std::string& name,
                     const std::vector<CsvColumn<Row>>& columns, const std::string& primary_key) {
  WriteFileAtomically(folder / (name + ".schema.json"),
                      FormatJson(MakeTableSchema(columns, primary_key), 2) + "\n");
}

template <class Row>
void WriteTable(const std::filesystem::path& folder, const std::string& name,
                const std::vector<CsvColumn<Row>>& columns, const std::vector<Row>& rows,
                const std::string& primary_key) {
  WriteFileAtomically(folder / (name + ".csv"), FormatCsv(columns, rows));
  WriteDictionary(folder, name, columns, primary_key);
}

/** Trial by trial: the events of ten thousand are more than anything else a study keeps. */
void WriteEvents(const StudyResult& result, const std::filesystem::path& folder) {
  const std::vector<CsvColumn<StudyEvent>> columns = ListEventColumns();
  std::string text = FormatCsvHeading(columns);
  for (const StudyTrial& trial : result.trials) {
    text += FormatCsvLines(columns, ListEvents(trial, result.study.config));
  }
  WriteFileAtomically(folder / "events.csv", text);
  WriteDictionary(folder, "events", columns, "");
}

}  // namespace

std::vector<StudyEvent> ListEvents(const StudyTrial& trial, const StudyConfig& config) {
  std::vector<StudyEvent> events;
  if (!trial.analysis) return events;
  const TrialAnalysis& analysis = *trial.analysis;
  const std::vector<ContactDetector>& detectors = ContactDetectorList();
  const auto add = [&](const char* name, const EventTime& event, bool is_believed = true) {
    events.push_back({&trial, name, "", "", event, is_believed});
  };
  const std::string& maximum = config.analysis.opening.maximum;
  add("movement_start", analysis.movement.start);
  add("movement_onset", analysis.movement.onset);
  add("maximum_opening", analysis.peak_opening.largest, maximum == "largest");
  add("last_maximum_opening", analysis.peak_opening.last, maximum == "last");
  for (const DigitContactEvents& digit : analysis.contacts) {
    const bool is_changed =
        std::any_of(trial.reviews.begin(), trial.reviews.end(), [&](const ContactReview& review) {
          return review.digit == digit.digit && review.verdict != ReviewVerdict::kConfirmed;
        });
    for (size_t i = 0; i < detectors.size(); ++i) {
      events.push_back({&trial, "contact", digit.digit, detectors[i].id, digit.by_detector[i],
                        config.analysis.contact.detector == detectors[i].id && !is_changed});
    }
    if (is_changed) {
      events.push_back({&trial, "contact", digit.digit, "review", digit.contact, true});
    }
  }
  if (!config.markers.object.empty()) {
    add("object_moved", analysis.object.moved);
    add("lift_off", analysis.object.lift_off);
  }
  add("reacceleration", analysis.phases.reacceleration);
  add("movement_end", analysis.movement.end);
  return events;
}

namespace {

struct OpeningRow {
  const StudyTrial* trial;
  size_t opening;
  const OpeningValues& values() const { return trial->openings[opening]; }
};

std::vector<CsvColumn<OpeningRow>> ListOpeningColumns(const StudyResult& result) {
  using Row = OpeningRow;
  const Study& study = result.study;
  std::vector<CsvColumn<Row>> columns = {
      {"person", "", "who reached", [](const Row& r) { return r.trial->participant; }},
      {"trial", "", "which trial", [](const Row& r) { return r.trial->id; }}};
  for (size_t i = 0; i < study.factors.size(); ++i) {
    const Factor& factor = study.factors[i];
    columns.push_back({factor.name, "", "factor of the design",
                       [i](const Row& r) { return r.trial->levels[i]; }});
    if (factor.numbers.empty()) continue;
    columns.push_back(
        {factor.name + "_number", "", "the same as a quantity", [i, &factor](const Row& r) {
           const auto level =
               std::find(factor.levels.begin(), factor.levels.end(), r.trial->levels[i]);
           return factor.numbers[static_cast<size_t>(level - factor.levels.begin())];
         }});
  }
  columns.push_back({"opening", "", "measure of hand opening",
                     [](const Row& r) { return HandOpeningList()[r.opening].id; }});
  columns.push_back({"open", "m", "largest between the onset and the last contact",
                     [](const Row& r) { return r.values().open; }});
  columns.push_back(
      {"closed", "m", "at the last contact", [](const Row& r) { return r.values().closed; }});
  for (size_t i = 0; i < result.digits.size(); ++i) {
    columns.push_back({"open_without_" + result.digits[i], "m", "without this digit",
                       [i](const Row& r) { return r.values().open_without[i]; }});
    columns.push_back({"closed_without_" + result.digits[i], "m", "without this digit",
                       [i](const Row& r) { return r.values().closed_without[i]; }});
  }
  return columns;
}

}  // namespace

std::string FormatOpeningTable(const StudyResult& result) {
  std::vector<OpeningRow> rows;
  for (const StudyTrial& trial : result.trials) {
    for (size_t i = 0; trial.IsKept() && i < trial.openings.size(); ++i)
      rows.push_back({&trial, i});
  }
  // By opening, in the order of their list: the first is the aperture.
  std::stable_sort(rows.begin(), rows.end(),
                   [](const OpeningRow& a, const OpeningRow& b) { return a.opening < b.opening; });
  return FormatCsv(ListOpeningColumns(result), rows);
}

std::vector<std::pair<std::string, Json>> MakeStudySchemas(const StudyResult& result) {
  return {{"trials.csv", MakeTableSchema(ListTrialColumns(result), "")},
          {"measures.csv", MakeTableSchema(ListMeasureColumns(result), "")},
          {"events.csv", MakeTableSchema(ListEventColumns(), "")},
          {"statistics.csv", MakeTableSchema(ListStatisticColumns(), "")},
          {"openings.csv", MakeTableSchema(ListOpeningColumns(result), "")}};
}

void WriteStudyTables(const StudyResult& result, const std::filesystem::path& folder) {
  MakeFolder(folder);
  std::vector<const StudyTrial*> all, kept;
  for (const StudyTrial& trial : result.trials) {
    all.push_back(&trial);
    if (trial.IsKept()) kept.push_back(&trial);
  }
  WriteTable(folder, "trials", ListTrialColumns(result), all, "trial_id");
  WriteTable(folder, "measures", ListMeasureColumns(result), kept, "trial_id");
  WriteEvents(result, folder);
  WriteTable(folder, "statistics", ListStatisticColumns(), ListStatistics(result.statistics), "");
}

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

Json MakeWideSchema(const StudyResult& result) {
  return MakeTableSchema(ListWideColumns(result), "participant");
}

void WriteWideTable(const StudyResult& result, const std::filesystem::path& folder) {
  WriteFileAtomically(folder / "wide.csv", FormatCsv(ListWideColumns(result), ListPersons(result)));
  WriteFileAtomically(folder / "wide.schema.json", FormatJson(MakeWideSchema(result), 2) + "\n");
}

}  // namespace graspbench
