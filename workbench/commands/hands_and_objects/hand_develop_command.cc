#include <memory>
#include <string>

#include "core/base/text/text.h"
#include "core/develop/development_warnings.h"
#include "core/hand/load_hand.h"
#include "datasets/analysis/development_summary.h"
#include "reports/kind_pages.h"
#include "reports/page/layout.h"
#include "workbench/command.h"
#include "workbench/experiments/develop_hand.h"
#include "workbench/experiments/machines/shell_quote.h"
#include "workbench/tables/text_table.h"
#include "workbench/terminal/terminal_observer.h"

namespace graspbench {
namespace {

constexpr double kMuchMore = 1.2;  // trials than the budget
constexpr int kFewTrials = 3000;   // for the grasps of a hand with five digits

std::string FormatDeveloped(const std::vector<DevelopedGrasp>& developed) {
  TextTable table({"grasp", "digits", "trials", "failed numerically", "score by geometry",
                   "developed", "unseen shapes"});
  for (const DevelopedGrasp& one : developed) {
    std::string digits;
    for (const std::string& id : one.grasp.digits) digits += (digits.empty() ? "" : " ") + id;
    table.AddRow(
        {one.grasp.id, digits, std::to_string(one.num_trials),
         std::to_string(one.num_numerical_failures), FormatFixed(one.proposed_score, 2),
         FormatFixed(one.score, 2),
         std::to_string(CountSuccesses(one.check)) + " of " + std::to_string(one.check.size())});
  }
  return table.Format();
}

std::filesystem::path WritePage(const DevelopHandRequest& request,
                                const std::vector<DevelopedGrasp>& developed) {
  const std::filesystem::path folder = request.out / "development";
  PosturePageData data;
  data.hand = std::make_shared<const Hand>(LoadHand(request.out.string()));
  data.config = request.config;
  data.developed = developed;
  data.stages = SummariseDevelopment(DevelopmentJournal(folder / "journal.jsonl"));
  return WriteReportPage(folder, MakePosturePage(data));
}

/** A development has a smallest size, whatever the budget. */
std::string DescribeFewest(const DevelopHandRequest& request, const Stage& stage) {
  const int budget = request.config.budget;
  if (stage.num_trials > kMuchMore * budget) {
    return "\nthat is more than the budget of " + FormatCount(budget, "trial") +
           ": fewer cannot select a grasp; about 3,000 find usable grasps";
  }
  return budget < kFewTrials
             ? "\na budget below about 3,000 trials often leaves grasps that hold no "
               "unseen shape"
             : "";
}

void Develop(const DevelopHandRequest& request) {
  TerminalObserver observer([&](const Stage& stage) {
    return request.out.string() + ": " + DescribeTasks(stage) + ", about " +
           FormatCount(stage.num_trials, "trial") + " on " +
           FormatCount(request.num_workers, "worker") + DescribeFewest(request, stage);
  });
  try {
    const std::vector<DevelopedGrasp> developed = DevelopHand(request, observer);
    const std::filesystem::path page = WritePage(request, developed);
    const Hand hand = LoadHand(request.out.string());
    for (const DevelopedGrasp& one : developed) {
      for (const std::string& warning : ListDevelopmentWarnings(hand, one)) {
        PrintMessage("warning: " + one.grasp.id + ": " + warning);
      }
    }
    PrintResult(FormatDeveloped(developed) + "\nhand     " + request.out.string() + "\npage     " +
                page.string() + "\nnext     graspbench run --hand " +
                QuoteForShell(request.out.string()) + " --grasp all --out results/NAME\n");
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::kInterrupted) throw;
    throw Error(ErrorKind::kInterrupted,
                "stopped; finished trials are kept. Repeat the command to continue");
  }
}

}  // namespace

void AddHandDevelopCommand(Command& program) {
  const auto request = std::make_shared<DevelopHandRequest>();
  Command& command = AddSubcommand(
      program.Subcommand("hand"), "develop",
      "Find the grasps g1 to g6 of a hand, by geometry and then by simulation on synthetic shapes.",
      "  graspbench hand develop allegro --out allegro-developed\n"
      "  graspbench hand develop shadow --budget 20000 --seed 2 --out my-shadow");
  command.AddRequired("hand", request->hand, "id, or folder with hand.urdf and hand.yaml", "HAND");
  command.AddRequired("--out", request->out,
                      "folder for the hand with its grasps; repeat the command to continue", "DIR");
  command
      .AddOption("--budget", request->config.budget,
                 "approximate number of trials for all grasps together; at least 52 per grasp", "N")
      ->Within(100, 10000000)
      ->ShowDefault();
  command.AddOption("--seed", request->config.seed, "random seed", "N")
      ->Within(0, 2147483647)
      ->ShowDefault();
  command.AddFlag("--any-coupling", request->config.any_coupling,
                  "the coupling rule is unknown: train with all rules");
  AddJobsOption(command, request->num_workers);
  AddTrialTimeoutOption(command, request->trial_time_limit);
  command.SetAction([request] { Develop(*request); });
}

}  // namespace graspbench
