#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <set>
#include <string>

#include "core/base/text/text.h"
#include "core/trial/measures/diagnosis_text.h"
#include "datasets/session/explanation_store.h"
#include "datasets/session/find_trial.h"
#include "workbench/command.h"
#include "workbench/experiments/run_session.h"
#include "workbench/result_page.h"
#include "workbench/terminal/terminal_observer.h"

namespace graspbench {
namespace {

struct SessionExplainOptions {
  std::string folder;
  bool with_all = false;
  int num_workers = 1;
  OnDamage on_damage = OnDamage::kRefuse;
  double trial_time_limit = kTrialTimeLimit;
  bool json = false;
};

Json MakeExplainedJson(const TrialRecord& record, const Explanation& explanation) {
  return {{"trial_id", record.plan.id},
          {"name", NameTrial(record.plan)},
          {"mechanism", NameOf(record.result.diagnosis->mechanism)},
          {"diagnosis", DescribeDiagnosis(record.result)},
          {"explanation", RecordToJson(explanation)},
          {"text", DescribeExplanation(explanation)}};
}

void PrintExplained(const Session& session, bool json) {
  const Explanations explanations = LoadExplanations(session.folder);
  Json all = Json::array();
  int num_failed = 0, num_explained = 0, num_without = 0;
  std::set<std::string> without;  // outcomes of failures that no remedy is tried on
  std::string text;
  for (const TrialRecord& record : session.records) {
    const Outcome outcome = record.result.outcome;
    if (!record.result.diagnosis && !IsSuccess(outcome)) {
      ++num_without;
      without.insert(RowOf(kOutcomes, outcome).name);
    }
    if (!record.result.diagnosis) continue;
    ++num_failed;
    const auto explained = explanations.find(record.plan.id);
    if (explained == explanations.end()) continue;
    ++num_explained;
    all.push_back(MakeExplainedJson(record, explained->second));
    text += NameTrial(record.plan) + "\n  " + DescribeDiagnosis(record.result) + "\n  " +
            DescribeExplanation(explained->second) + "\n";
  }
  if (json) return PrintJson(all);
  PrintResult(text + (text.empty() ? "" : "\n") + std::to_string(num_explained) + " of " +
              FormatCount(num_failed, "failure") + " explained" +
              (num_explained < num_failed ? "; --all explains every one\n" : "\n") +
              (num_without > 0 ? FormatCount(num_without, "failure") + " without explanation: " +
                                     fmt::format("{}", fmt::join(without, ", ")) + "\n"
                               : ""));
}

ExitCode ExplainFailures(const SessionExplainOptions& options) {
  const std::filesystem::path folder = options.folder;
  TerminalObserver observer(
      [&](const Stage& stage) { return options.folder + ": " + DescribeTasks(stage); });
  DemandFinished(ExplainSession(folder, options.with_all ? kExplainAllRound : kExplainRound,
                                options.num_workers, observer, options.on_damage,
                                options.trial_time_limit));
  const Session session = LoadSession(folder, options.on_damage, RecordParts::kBrief);
  const std::filesystem::path report = WriteResults(session, MakeKeptTracer(session));
  PrintExplained(session, options.json);
  if (!options.json) PrintResult(FormatPlaces(report, folder / "export" / "trials.csv"));
  return kExitOk;
}

}  // namespace

void AddExplainCommand(Command& program) {
  Command& command = AddSubcommand(
      program, "explain", "Repeat failed trials with remedies and report which remedies succeed.",
      "  graspbench explain results/pilot          one failure of each condition\n"
      "  graspbench explain results/pilot --all    every failure");
  const auto options = std::make_shared<SessionExplainOptions>();
  command.AddRequired("folder", options->folder, "folder of the session", "DIR");
  command.AddFlag("--all", options->with_all,
                  "every failure, not only the first of each condition");
  AddJobsOption(command, options->num_workers, "failures");
  AddTrialTimeoutOption(command, options->trial_time_limit);
  AddAcceptDamageOption(command, options->on_damage);
  AddJsonOption(command, options->json, "print the explanations as one JSON array");
  command.SetAction([options] { return ExplainFailures(*options); });
}

}  // namespace graspbench
