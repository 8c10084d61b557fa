#include <filesystem>
#include <memory>
#include <string>

#include "workbench/command.h"
#include "workbench/experiments/schedule_session.h"
#include "workbench/tables/experiment_tables.h"
#include "workbench/text/timed_grasp.h"

namespace graspbench {
namespace {

struct SimultaneityOptions {
  ExperimentRequest request;
  std::filesystem::path study;
  bool delays = false, schedules = false;
  bool json = false;
};

void RunDelays(const SimultaneityOptions& options) {
  const PreparedSession experiment =
      PrepareExperiment(options.request, "delays", ListDelayConditions);
  if (!RunOrPlan(experiment, options.request)) return;
  const std::vector<DoseResponse> rows =
      SummariseDelays(ListDelayedTrials(LoadSession(experiment.folder, options.request.on_damage)));
  if (options.json) return PrintJson({{"delays", MakeDosesJson(rows)}});
  PrintResult(FormatDoseResponses(rows));
}

void RunSchedulesOf(const SimultaneityOptions& options) {
  People people;
  if (!options.study.empty()) {
    people = {options.study.lexically_normal().filename().string(),
              ReadStudyTouches(options.study)};
  }
  const PreparedSession schedules = PrepareSchedules(options.request, people);
  if (options.request.plan_only) {
    const SchedulePlan plan = {LoadPeopleFile(schedules.folder), &schedules.session};
    if (options.json) {
      return PrintJson({{"folder", schedules.folder.string()}, {"schedules", ToJson(plan)}});
    }
    PrintResult(FormatSchedulePlan(plan));
    return PrintExperimentPlan(schedules);
  }
  ExperimentRequest request = options.request;
  request.thresholds = &kThresholdScales[0];
  RunOrPlan(schedules, request);
  const Session session =
      LoadSession(schedules.folder, options.request.on_damage, RecordParts::kBrief);
  ScheduleComparison found =
      CompareSchedules(session, LoadPeopleFile(schedules.folder), LoadThresholds(session));
  found.folder = schedules.folder.string();
  if (options.json) return PrintJson(ToJson(found));
  PrintResult(FormatSchedules(found));
}

void Run(SimultaneityOptions options) {
  const bool runs = options.delays || options.schedules;
  if (options.request.trials_per_cell > 0 && !runs) {
    throw Error(ErrorKind::kUsage, "--trials requires --delay or --schedules");
  }
  if (options.request.plan_only && !runs) {
    throw Error(ErrorKind::kUsage, "--plan-only requires --delay or --schedules");
  }
  if (options.schedules) return RunSchedulesOf(options);
  if (options.request.trials_per_cell == 0) options.request.trials_per_cell = 1;
  if (options.delays) return RunDelays(options);
  const Session session = LoadSession(options.request.folder);
  if (!session.config.conditions.empty()) {
    throw Error(ErrorKind::kUsage, "\"" + options.request.folder.string() +
                                       "\" is a sweep, and its conditions must not be mixed; use "
                                       "the factor delay.last, or a session without conditions");
  }
  if (!session.findings.entries().empty()) PrintMessage(session.findings.Format());
  const std::vector<SimultaneityRelation> relations = SummariseSimultaneity(session);
  if (options.json) return PrintJson({{"relations", MakeRelationsJson(relations)}});
  PrintResult(FormatRelations(relations));
}

}  // namespace

void AddSimultaneityCommand(Command& program) {
  Command& command = AddSubcommand(
      program, "simultaneity", "Relate contact simultaneity to the outcome of trials.",
      "  graspbench simultaneity results/pilot            correlations within conditions\n  "
      "graspbench simultaneity results/pilot --delay    the same trials, one digit delayed\n  "
      "graspbench simultaneity results/pilot --schedules --people results/study");
  const auto options = std::make_shared<SimultaneityOptions>();
  AddStoreFolder(command, options->request.folder, "folder of the session");
  Option* delay = command.AddFlag("--delay", options->delays,
                                  "repeat trials with the last or first digit delayed by 50 to 300 "
                                  "ms, with the object unchanged, light, slippery and off-centre");
  Option* schedules = command.AddFlag("--schedules", options->schedules,
                                      "repeat trials with simultaneous and with people-like "
                                      "contact times, and compare the grip thresholds");
  schedules->Excludes(delay);
  command
      .AddOption("--people", options->study,
                 "folder of a study of people on the same objects, for --schedules", "STUDY")
      ->Needs(schedules);
  AddTrialsOption(command, options->request.trials_per_cell, "1; all with --schedules",
                  "trials to repeat per hand, object and grasp");
  AddPlanOnlyOption(command, options->request.plan_only);
  command
      .AddFlag("--judge", options->request.with_judge,
               "also find breaking forces of the delayed trials; takes about five times as long")
      ->Needs(delay);
  AddJobsOption(command, options->request.num_workers);
  AddJsonOption(command, options->json);
  command.SetAction([options] { Run(*options); });
}

}  // namespace graspbench
