#include "human_study/study/design/study_plan.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/base/files/files.h"
#include "core/base/random.h"
#include "core/base/text/delimited_text.h"
#include "core/base/text/text.h"
#include "core/statistics/distributions.h"
#include "core/statistics/summary.h"
#include "human_study/events/trial_analysis.h"

namespace graspbench {
namespace {

constexpr int kNumSimulations = 4000;
constexpr int kNumDraws = 1000;

[[noreturn]] void FailPilot(const std::string& text) { throw Error(ErrorKind::kFormat, text); }

/** Columns between `trial` and `measure` that hold levels. */
std::vector<std::string> ListDesignColumns(const DataTable& table) {
  std::vector<std::string> columns;
  for (const std::string& column : table.columns()) {
    const std::string number = "_number";
    const bool is_number = column.size() > number.size() &&
                           column.substr(column.size() - number.size()) == number &&
                           table.Has(column.substr(0, column.size() - number.size()));
    const std::set<std::string> others = {"person", "trial", "measure", "value"};
    if (others.count(column) == 0 && !is_number) columns.push_back(column);
  }
  return columns;
}

/** Numbers in their order, else as they appear. */
std::vector<std::string> ListLevelsOf(const DataTable& table, const std::string& column) {
  std::vector<std::pair<double, std::string>> levels;
  for (size_t row = 0; row < table.num_rows(); ++row) {
    const std::string& level = table.Text(row, column);
    const bool is_known = std::any_of(levels.begin(), levels.end(),
                                      [&](const auto& known) { return known.second == level; });
    const std::string& number = table.Text(row, column + "_number");
    if (!is_known) levels.push_back({ParseFiniteNumber(number).value_or(0.0), level});
  }
  std::stable_sort(levels.begin(), levels.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<std::string> names;
  for (const auto& [number, name] : levels) names.push_back(name);
  return names;
}

void ChooseLevels(const DataTable& table, const PilotQuestion& question,
                  const std::vector<std::string>& columns, Pilot& pilot) {
  pilot.factor = question.factor.empty() && !columns.empty() ? columns.front() : question.factor;
  if (columns.empty()) FailPilot(table.file() + ": the pilot has no factor to compare levels of");
  if (std::find(columns.begin(), columns.end(), pilot.factor) == columns.end()) {
    FailPilot(table.file() + ": the pilot has no factor \"" + pilot.factor + "\"" +
              SuggestNames(pilot.factor, columns));
  }
  const std::vector<std::string> levels = ListLevelsOf(table, pilot.factor);
  if (levels.size() < 2) {
    FailPilot(table.file() + ": " + pilot.factor + " has one level; expected two to compare");
  }
  const std::vector<std::string> chosen =
      question.levels.empty() ? std::vector<std::string>{levels.front(), levels.back()}
                              : question.levels;
  if (chosen.size() != 2 || chosen[0] == chosen[1]) {
    throw Error(ErrorKind::kUsage, "expected two different levels to compare");
  }
  for (const std::string& level : chosen) {
    if (std::find(levels.begin(), levels.end(), level) == levels.end()) {
      FailPilot(table.file() + ": " + pilot.factor + " has no level \"" + level + "\"" +
                SuggestNames(level, levels));
    }
  }
  pilot.level_a = chosen[0];
  pilot.level_b = chosen[1];
}

/** Values of one person: by level, and by condition for the spread of trials. */
struct PilotPerson {
  std::vector<double> values[2];
  std::map<std::string, std::vector<double>> cells;
};

std::map<std::string, PilotPerson> CollectPersons(DataTable& table, const Pilot& pilot,
                                                  const std::string& measure,
                                                  const std::vector<std::string>& columns) {
  std::map<std::string, PilotPerson> persons;
  bool is_known = false;
  std::vector<std::string> measures;
  for (size_t row = 0; row < table.num_rows(); ++row) {
    const std::string& own = table.Text(row, "measure");
    if (std::find(measures.begin(), measures.end(), own) == measures.end()) measures.push_back(own);
    if (own != measure) continue;
    is_known = true;
    const std::string& level = table.Text(row, pilot.factor);
    const double value = table.Number(row, "value");
    if ((level != pilot.level_a && level != pilot.level_b) || std::isnan(value)) continue;
    PilotPerson& person = persons[table.Text(row, "person")];
    person.values[level == pilot.level_b ? 1 : 0].push_back(value);
    std::string cell;
    for (const std::string& column : columns) cell += table.Text(row, column) + "\n";
    person.cells[cell].push_back(value);
  }
  if (!is_known) {
    FailPilot(table.file() + ": no measure \"" + measure + "\"" + SuggestNames(measure, measures));
  }
  return persons;
}

void PoolTrials(const std::map<std::string, PilotPerson>& persons, Pilot& pilot) {
  double sum = 0.0;
  for (const auto& [name, person] : persons) {
    for (const auto& [cell, values] : person.cells) {
      sum += CalcMoments(values).sum_of_squares;
      pilot.trial_df += static_cast<double>(values.size()) - 1.0;
      pilot.num_trials += static_cast<int>(values.size());
    }
  }
  if (pilot.trial_df < 1.0) {
    FailPilot(
        "the pilot: nobody has two trials in a condition, so the spread of trials is not "
        "known; state the variances instead (--trial-sd, --person-sd)");
  }
  pilot.trial_variance = sum / pilot.trial_df;
}

/** Persons' differences b - a. */
void PoolDifferences(const std::map<std::string, PilotPerson>& persons, Pilot& pilot) {
  std::vector<double> differences, means;
  for (const auto& [name, person] : persons) {
    if (person.values[0].empty() || person.values[1].empty()) continue;
    const double a = CalcMean(person.values[0]), b = CalcMean(person.values[1]);
    differences.push_back(b - a);
    means.push_back(0.5 * (a + b));
    for (const auto& values : person.values) {
      pilot.trial_share += 1.0 / static_cast<double>(values.size());
    }
  }
  pilot.num_persons = static_cast<int>(differences.size());
  if (pilot.num_persons < 2) {
    FailPilot("the pilot: " + FormatCount(pilot.num_persons, "person has", "persons have") +
              " trials at both levels of " + pilot.factor + "; expected 2 or more");
  }
  pilot.trial_share /= pilot.num_persons;
  const Moments moments = CalcMoments(differences);
  pilot.difference = moments.mean;
  pilot.mean = CalcMean(means);
  pilot.observed_df = pilot.num_persons - 1.0;
  pilot.observed_variance = moments.sum_of_squares / pilot.observed_df;
}

/** Persons' means in two groups. */
void PoolGroups(const std::map<std::string, PilotPerson>& persons, Pilot& pilot) {
  std::vector<double> means[2];
  for (const auto& [name, person] : persons) {
    const int group = person.values[0].empty() ? 1 : 0;
    means[group].push_back(CalcMean(person.values[group]));
    pilot.trial_share += 1.0 / static_cast<double>(person.values[group].size());
  }
  for (int group = 0; group < 2; ++group) {
    if (means[group].size() < 2) {
      FailPilot("the pilot: group \"" + (group == 0 ? pilot.level_a : pilot.level_b) + "\" has " +
                FormatCount(means[group].size(), "person") + "; expected 2 or more");
    }
  }
  const Moments a = CalcMoments(means[0]), b = CalcMoments(means[1]);
  pilot.num_persons = static_cast<int>(means[0].size() + means[1].size());
  pilot.trial_share /= pilot.num_persons;
  pilot.difference = b.mean - a.mean;
  pilot.mean = 0.5 * (a.mean + b.mean);
  pilot.observed_df = pilot.num_persons - 2.0;
  pilot.observed_variance = (a.sum_of_squares + b.sum_of_squares) / pilot.observed_df;
}

/** The design if the variances were others. */
PowerDesign MakeDesignOf(const Pilot& pilot, double difference, double trial_variance,
                         double observed_variance) {
  PowerDesign design;
  design.is_between = pilot.is_between;
  design.difference = difference;
  design.trial_sd = std::sqrt(trial_variance);
  design.person_sd =
      std::sqrt(std::max(0.0, observed_variance - pilot.trial_share * trial_variance));
  return design;
}

Interval CalcOverPilot(const Pilot& pilot, double difference, int num_persons, int num_trials) {
  RandomStream random("study plan", "pilot");
  const auto draw = [&](double variance, double df) {
    return variance * df / CalcChiSquaredQuantile(random.NextUniform(1e-9, 1.0 - 1e-9), df);
  };
  std::vector<double> powers;
  for (int i = 0; i < kNumDraws; ++i) {
    const double trial = draw(pilot.trial_variance, pilot.trial_df);
    const double observed = draw(pilot.observed_variance, pilot.observed_df);
    const PowerDesign design = MakeDesignOf(pilot, difference, trial, observed);
    powers.push_back(CalcPower(design, num_persons, num_trials));
  }
  std::sort(powers.begin(), powers.end());
  return {CalcSortedQuantile(powers, 0.025), CalcSortedQuantile(powers, 0.975)};
}

[[noreturn]] void FailPlan(const std::string& text) { throw Error(ErrorKind::kUsage, text); }

void CheckRequest(const PlanRequest& request, const PowerDesign& design) {
  const auto say = [](double value) { return FormatSignificant(value, 4); };
  if (!(request.difference > 0.0) || !std::isfinite(request.difference)) {
    FailPlan("--difference is " + say(request.difference) +
             "; expected the difference to be shown, above 0, in the measure's SI unit (10 ms is "
             "0.01)");
  }
  if (!(request.wanted >= 0.1 && request.wanted <= 0.99)) {
    FailPlan("--power is " + say(request.wanted) + "; expected 0.1 to 0.99");
  }
  if (!(design.trial_sd >= 0.0 && design.person_sd >= 0.0) || !std::isfinite(design.trial_sd) ||
      !std::isfinite(design.person_sd)) {
    FailPlan("--trial-sd is " + say(design.trial_sd) + ", --person-sd " + say(design.person_sd) +
             "; expected 0 or more");
  }
  if (design.trial_sd == 0.0 && design.person_sd == 0.0) {
    FailPlan(
        "trials and persons without any spread need no statistics; expected --trial-sd or "
        "--person-sd above 0");
  }
  if (request.trials.empty()) FailPlan("--trials: expected one number or more");
  for (const int trials : request.trials) {
    if (trials < 1 || trials > 10000) {
      FailPlan("--trials has " + std::to_string(trials) + "; expected 1 to 10000");
    }
  }
  if (request.num_persons != 0 && (request.num_persons < 2 || request.num_persons > 1000)) {
    FailPlan("--persons is " + std::to_string(request.num_persons) + "; expected 2 to 1000");
  }
  // Milliseconds given as seconds, per cent as shares: no reach has such a difference.
  const std::vector<TrialMeasure>& measures = TrialMeasureList();
  const auto measure = std::find_if(measures.begin(), measures.end(),
                                    [&](const auto& m) { return m.id == request.measure; });
  if (measure == measures.end()) {
    std::vector<std::string> ids;
    for (const TrialMeasure& one : measures) ids.push_back(one.id);
    FailPlan("measure \"" + request.measure + "\" is not known" +
             SuggestNames(request.measure, ids));
  }
  const std::map<std::string, double> largest = {{"s", 5.0}, {"m", 0.5}, {"1", 1.0}};
  const auto limit = largest.find(measure->unit);
  if (limit != largest.end() && request.difference > limit->second) {
    FailPlan("--difference is " + say(request.difference) + " " +
             (limit->first == "1" ? std::string("(100 %)") : limit->first) + " of " +
             measure->name + "; expected at most " + say(limit->second) +
             " (10 ms is 0.01, 10 % is 0.1)");
  }
}

}  // namespace

PowerDesign Pilot::MakeDesign(double wanted_difference) const {
  return MakeDesignOf(*this, wanted_difference, trial_variance, observed_variance);
}

Pilot LoadPilot(const std::filesystem::path& folder, const PilotQuestion& question) {
  const std::filesystem::path file = folder / "tidy" / "tidy.csv";
  if (!std::filesystem::exists(file)) {
    throw Error(ErrorKind::kNotFound, "\"" + folder.string() +
                                          "\" is no result of graspbench study run: tidy/tidy.csv "
                                          "is missing");
  }
  Diagnostics problems;
  DataTable table(ReadFile(file), file.string(), problems);
  for (const char* column : {"person", "trial", "measure", "value"}) table.Require(column);
  problems.ThrowIfErrors(ErrorKind::kFormat, "the pilot cannot be read");
  const std::vector<std::string> columns = ListDesignColumns(table);
  Pilot pilot;
  ChooseLevels(table, question, columns, pilot);
  const auto persons = CollectPersons(table, pilot, question.measure, columns);
  problems.ThrowIfErrors(ErrorKind::kFormat, "the pilot cannot be read");
  pilot.is_between =
      !persons.empty() && std::all_of(persons.begin(), persons.end(), [](const auto& person) {
        return person.second.values[0].empty() || person.second.values[1].empty();
      });
  PoolTrials(persons, pilot);
  pilot.is_between ? PoolGroups(persons, pilot) : PoolDifferences(persons, pilot);
  return pilot;
}

StudyPlan MakeStudyPlan(const PlanRequest& request) {
  StudyPlan plan;
  plan.wanted = request.wanted;
  plan.design = request.pilot ? request.pilot->MakeDesign(request.difference) : request.stated;
  plan.design.difference = request.difference;
  CheckRequest(request, plan.design);
  for (const int num_trials : request.trials) {
    PlanRow row;
    row.num_trials = num_trials;
    row.num_persons = request.num_persons > 0
                          ? Answer<int>(request.num_persons)
                          : FindPersons(plan.design, num_trials, request.wanted);
    if (row.num_persons) {
      row.power = SimulatePower(plan.design, *row.num_persons, num_trials, kNumSimulations,
                                "study plan " + std::to_string(num_trials));
      if (request.pilot) {
        row.over_pilot =
            CalcOverPilot(*request.pilot, request.difference, *row.num_persons, num_trials);
      }
    }
    plan.rows.push_back(row);
  }
  return plan;
}

}  // namespace graspbench
