#include <memory>
#include <string>

#include "core/base/text/text.h"
#include "workbench/command.h"
#include "workbench/experiments/machines/shell_quote.h"
#include "workbench/experiments/run_session.h"
#include "workbench/result_page.h"
#include "workbench/tables/text_table.h"
#include "workbench/terminal/terminal_observer.h"
#include "workbench/transfer/transfer_session.h"

namespace graspbench {
namespace {

struct TransferOptions {
  TransferRequest request;
  std::string out;
  bool json = false;
};

/** The first rows: those of whole hands. */
std::vector<TransferSummary> TakeHands(const std::vector<TransferSummary>& summaries) {
  std::vector<TransferSummary> hands;
  for (const TransferSummary& summary : summaries) {
    if (summary.object.empty() && summary.type.empty()) hands.push_back(summary);
  }
  return hands;
}

std::string FormatTransferReasons(const TransferFile& file,
                                  const std::vector<TransferSummary>& hands) {
  std::string text;
  for (const std::string& doubt : file.doubts) text += "doubt    " + doubt + "\n";
  for (const TransferSummary& hand : hands) {
    for (const auto& [reason, count] : CountTransferReasons(file, hand.hand)) {
      text += "not transferable to " + hand.hand + ", " + FormatCount(count, "grasp") + ": " +
              reason + (count > 1 ? " (the first)\n" : "\n");
    }
    for (const auto& [reason, count] :
         CountTransferReasons(file, hand.hand, &TransferRow::not_played)) {
      text += "not played by " + hand.hand + ", " + FormatCount(count, "grasp") + ": " + reason +
              (count > 1 ? " (the first)\n" : "\n");
    }
  }
  return text;
}

ExitCode RunTransfer(TransferOptions options) {
  options.request.out = options.out;
  const PreparedSession prepared = PrepareTransfers(options.request);
  TerminalObserver observer;
  const RunRecord record = RunRound(kTrialRound, prepared, options.request.num_workers, observer);
  DemandFinished(record.ending == RunEnding::kFinished);
  const Session session = LoadSession(prepared.folder);
  const std::filesystem::path page = WriteResults(session);
  const TransferFile file = LoadTransferFile(prepared.folder);
  const std::vector<TransferSummary> summaries = SummariseTransfers(file, session);
  if (options.json) {
    PrintJson({{"transfers", MakeJsonRows(ListTransferColumns(), summaries)},
               {"played", MakeJsonRows(ListPlayedColumns(), summaries)},
               {"digits", MakeJsonRows(ListTransferDigitColumns(), ListTransferDigits(file))},
               {"report", page.string()}});
  } else {
    const std::vector<TransferSummary> hands = TakeHands(summaries);
    const std::string played =
        options.request.plays ? FormatTable(ShowTable(ListPlayedColumns(), hands)) : std::string();
    PrintResult(FormatTable(ShowTable(ListTransferColumns(), hands)) + played +
                FormatTransferReasons(file, hands) + FormatPlaces(page) + "next     xdg-open " +
                QuoteForShell(page.string()) + "\n");
  }
  return kExitOk;
}

}  // namespace

void AddTransferCommand(Command& program) {
  Command& command = AddSubcommand(
      program, "transfer", "Put robot hands where a study's people grasped, and try these grasps.",
      "  graspbench transfer study.yaml --hand tum,shadow --out transferred\n"
      "  graspbench transfer study.yaml --hand my_hand --every-trial --out all");
  const auto options = std::make_shared<TransferOptions>();
  TransferRequest& request = options->request;
  request.config.trials = 4;
  command.AddRequired("study", request.study, "study.yaml, or the results of its study", "STUDY");
  command.AddOption("--data", request.data, "folder of the recordings", "DIR")
      ->ShowDefault("that of study.yaml");
  AddListOption(command, "--hand", request.config.hands, "hands by id or folder", "HAND,..");
  command.AddFlag("--every-trial", request.takes_every_trial,
                  "transfer every kept trial, not the median of each person on each object");
  command.AddFlag("--play", request.plays,
                  "try each grasp along the person's course of hand and digits, too");
  AddTrialsOption(command, request.config.trials, "4", "trials of each hand, object, grasp");
  AddSeedOption(command, request.config.seed, "other sampled poses");
  command.AddRequired("--out", options->out,
                      "folder for the session; one with the same grasps is continued", "DIR");
  AddJobsOption(command, request.num_workers);
  AddJsonOption(command, options->json);
  command.SetAction([options] { return RunTransfer(*options); });
}

}  // namespace graspbench
