#include <memory>

#include "core/base/text/text.h"
#include "human_study/study/design/study_plan.h"
#include "workbench/command.h"
#include "workbench/tables/text_table.h"

namespace graspbench {
namespace {

struct PlanOptions {
  std::string pilot;  ///< folder; empty: stated variances
  PilotQuestion question;
  PlanRequest request;
};

std::string DescribeVariances(const PlanOptions& options, const PowerDesign& design) {
  const auto say = [](double value) { return FormatSignificant(value, 3); };
  std::string text = "SD of trials " + say(design.trial_sd) + ", of persons' " +
                     (design.is_between ? "means " : "differences ") + say(design.person_sd);
  if (!options.request.pilot) return text + " (stated)";
  const Pilot& pilot = *options.request.pilot;
  text += " (pilot: " + FormatCount(pilot.num_persons, "person") + ", " +
          FormatCount(pilot.num_trials, "trial") + ", " + pilot.factor + " " + pilot.level_a +
          " and " + pilot.level_b + ")";
  if (design.person_sd == 0.0) {
    text +=
        "\nnote     the pilot shows no variance between persons beyond that of trials; the plan "
        "assumes zero, so rely on the lower end of the last column";
  }
  return text;
}

std::string FormatPlan(const PlanOptions& options, const StudyPlan& plan) {
  const bool has_pilot = options.request.pilot.has_value();
  std::vector<std::string> heads = {"trials a condition",
                                    plan.design.is_between ? "persons a group" : "persons",
                                    "power (95 %)", "half 95 % interval"};
  if (has_pilot) heads.push_back("power within the pilot's uncertainty (95 %)");
  TextTable table(heads);
  for (const PlanRow& row : plan.rows) {
    std::vector<std::string> cells = {std::to_string(row.num_trials)};
    if (row.num_persons) {
      cells.push_back(std::to_string(*row.num_persons));
      cells.push_back(
          FormatWithRange(row.power.power, row.power.interval.low, row.power.interval.high, 2));
      cells.push_back(FormatSignificant(row.power.half_width, 2));
    } else {
      cells.insert(cells.end(), {row.num_persons.reason(), "", ""});
    }
    if (has_pilot) {
      cells.push_back(row.over_pilot ? FormatRange(row.over_pilot->low, row.over_pilot->high, 2)
                                     : "");
    }
    table.AddRow(cells);
  }
  return "plan     a difference of " + FormatSignificant(plan.design.difference, 4) + " in " +
         options.request.measure +
         (plan.design.is_between ? " between groups" : " within persons") + ", power " +
         FormatFixed(plan.wanted, 2) + ", two-sided t test at 0.05\n" + "spread   " +
         DescribeVariances(options, plan.design) + "\n" + table.Format();
}

void RunPlan(PlanOptions options) {
  const bool is_stated =
      options.request.stated.trial_sd != 0.0 || options.request.stated.person_sd != 0.0;
  if (options.pilot.empty() != is_stated) {
    throw Error(ErrorKind::kUsage,
                is_stated ? "expected either a pilot or stated variances, not both"
                          : "expected the result folder of a pilot, or --trial-sd and --person-sd");
  }
  const bool asks_pilot = !options.question.factor.empty() || !options.question.levels.empty();
  if (options.pilot.empty() ? asks_pilot : options.request.stated.is_between) {
    throw Error(ErrorKind::kUsage, options.pilot.empty()
                                       ? "--factor and --levels need a pilot; none is given"
                                       : "--groups needs stated variances; with a pilot, --factor "
                                         "names the column of the group");
  }
  options.request.measure = options.question.measure;
  if (!options.pilot.empty()) options.request.pilot = LoadPilot(options.pilot, options.question);
  PrintResult(FormatPlan(options, MakeStudyPlan(options.request)));
}

}  // namespace

void AddStudyPlanCommand(Command& program) {
  const auto options = std::make_shared<PlanOptions>();
  Command& plan = AddSubcommand(
      program.Subcommand("study"), "plan",
      "Plan the number of persons and trials that detects a difference, by simulation.",
      "  graspbench study plan results/pilot --difference 0.01\n"
      "  graspbench study plan --difference 0.01 --trial-sd 0.03 --person-sd 0.01 --trials 5,10");
  plan.AddOption("pilot", options->pilot,
                 "pilot: result of graspbench study run that supplies the variances", "[DIR]");
  plan.AddRequired(
      "--difference", options->request.difference,
      "difference to detect, in the SI unit of the measure; never the one found in the pilot");
  plan.AddOption("--measure", options->question.measure, "id, as in measures.csv")->ShowDefault();
  plan.AddOption("--factor", options->question.factor,
                 "column of the pilot that holds the compared levels")
      ->ShowDefault("the first");
  plan.AddOption("--levels", options->question.levels, "two of them: 0.03,0.06")
      ->SplitAtCommas()
      ->ShowDefault("the first and the last");
  plan.AddOption("--trial-sd", options->request.stated.trial_sd,
                 "standard deviation of the trials of a person in a condition");
  plan.AddOption(
      "--person-sd", options->request.stated.person_sd,
      "standard deviation of the true differences of persons; with --groups, of their true means");
  plan.AddFlag("--groups", options->request.stated.is_between,
               "two groups of persons instead of two conditions");
  plan.AddOption("--trials", options->request.trials, "trials per person and condition")
      ->SplitAtCommas()
      ->ShowDefault();
  plan.AddOption("--persons", options->request.num_persons,
                 "number of persons (per group) whose power is computed")
      ->ShowDefault("as many as the target power needs");
  plan.AddOption("--power", options->request.wanted, "wanted")->ShowDefault();
  plan.SetAction([options] { RunPlan(*options); });
}

}  // namespace graspbench
