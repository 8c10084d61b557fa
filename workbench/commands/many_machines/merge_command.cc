#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/base/text/text.h"
#include "datasets/analysis/campaign/campaign_summary.h"
#include "datasets/analysis/session_summary.h"
#include "datasets/campaign/campaign_store.h"
#include "datasets/session/merge_sessions.h"
#include "reports/campaign/campaign_report.h"
#include "workbench/command.h"
#include "workbench/experiments/machines/shell_quote.h"
#include "workbench/experiments/run_campaign.h"
#include "workbench/result_page.h"
#include "workbench/tables/optimise_tables.h"
#include "workbench/tables/progress_tables.h"
#include "workbench/tables/summary_table.h"

namespace graspbench {
namespace fs = std::filesystem;
namespace {

struct MergeOptions {
  fs::path folder;
  std::vector<fs::path> others;
  std::vector<std::string> aside;
  bool json = false;
};

Json MakeJson(const SessionSummary& summary, const std::vector<MachineShards>& machines,
              const Session& session, const MergeOptions& options, const fs::path& report) {
  Json json = MakeSummaryJson(summary, options.folder, report);
  json["left"] = session.plan.size() - session.records.size();
  json["machines"] = MakeMachinesJson(machines);
  json["differences"] = session.machine_differences;
  return json;
}

[[noreturn]] void FailOnRest(const MergeOptions& options, const std::string& rest) {
  throw Error(ErrorKind::kInterrupted,
              rest +
                  " left; the finished trials are merged and reported. Work on the shards again, "
                  "then merge again: graspbench status " +
                  QuoteForShell(options.folder.string()));
}

ExitCode MergeOfCampaign(const MergeOptions& options) {
  const CampaignRest rest = MergeCampaign(options.folder, options.others);
  const Campaign campaign = LoadCampaign(options.folder);
  if (!campaign.benchmark.records.empty()) ExportCampaign(options.folder, campaign);
  const std::string report = WriteCampaignReport(options.folder, campaign).string();
  const std::vector<std::string> differences = DescribeCampaignMachines(options.folder);
  if (options.json) {
    PrintJson({{"folder", options.folder.string()},
               {"report", report},
               {"scenes_left", rest.scenes},
               {"trials_left", rest.trials},
               {"judgements_left", rest.judgements},
               {"searches_left", rest.searches},
               {"differences", differences}});
  } else {
    PrintResult(FormatVariantsTable(campaign) + FormatPlaces(report));
  }
  for (const std::string& difference : differences) PrintMessage("warning: " + difference);
  if (rest.scenes > 0) FailOnRest(options, FormatCount(rest.scenes, "scene is", "scenes are"));
  if (rest.sum() > 0) {
    FailOnRest(options, "all scenes are finished; " + FormatCount(rest.trials, "trial") + ", " +
                            FormatCount(rest.judgements, "grasp") + " to judge and " +
                            FormatCount(rest.searches, "search", "searches") + " are");
  }
  return kExitOk;
}

ExitCode MergeOfScene(const MergeOptions& options) {
  const int num_new = MergeScenes(options.folder, options.others);
  if (num_new > 0) PrintMessage(FormatCount(num_new, "evaluation") + " came from other folders");
  if (!HasSceneResult(options.folder)) {
    throw Error(ErrorKind::kInterrupted,
                "the optimisation is not finished; the finished evaluations are merged. To "
                "continue: graspbench work " +
                    QuoteForShell(options.folder.string()) + " --shard 1/1");
  }
  PrintResult("data     " + (options.folder / "result.json").string() + "\n");
  return kExitOk;
}

ExitCode Merge(const MergeOptions& options) {
  for (const std::string& journal : options.aside) {
    SetJournalAside(options.folder, journal);
    PrintMessage(journal + " is set aside as " + journal + ".set-aside; its results are ignored");
  }
  const StoreKind* kind = FindStoreKind(options.folder);
  if (kind == &kCampaignStore) return MergeOfCampaign(options);
  if (kind == &kSceneStore) return MergeOfScene(options);
  const int num_new = MergeSessions(options.folder, options.others);
  // Damage is found before it is sealed.
  const Session session = LoadSession(options.folder, OnDamage::kRefuse, RecordParts::kBrief);
  SealStore(kSessionStore, options.folder);
  fs::path report;
  std::string page = "\nrun the command that planned it again to see it with its session\n";
  if (!HasSession(options.folder / ".." / "..")) {
    ExplainUnasked(options.folder, 1, OnDamage::kRefuse);
    report = WriteResults(session, MakeKeptTracer(session));
    page = FormatPlaces(report, options.folder / "export" / "trials.csv");
  }
  const std::vector<MachineShards> machines = ListMachines(options.folder);
  const SessionSummary summary = SummariseSession(session);
  if (options.json) {
    PrintJson(MakeJson(summary, machines, session, options, report));
  } else {
    PrintResult(FormatMachines(machines) + FormatSummaryTable(summary) + page);
  }
  if (num_new > 0) PrintMessage(FormatCount(num_new, "trial") + " came from other folders");
  if (const size_t num = CountBuilds(machines); num > 1) {
    PrintMessage("note: " + std::to_string(num) + " builds of graspbench have worked on this");
  }
  for (const std::string& difference : session.machine_differences) {
    PrintMessage("warning: " + difference);
  }
  if (const std::string rest = DescribeRest(session); !rest.empty()) FailOnRest(options, rest);
  return summary.total.CountOf(Outcome::kNumericalFailure) > 0 ? kExitNumericalFailures : kExitOk;
}

}  // namespace

void AddMergeCommand(Command& program) {
  Command& command = AddSubcommand(
      program, "merge", "Merge the shards of a session or campaign and write its report.",
      "  graspbench merge results/pilot                 after graspbench work, on one disk\n"
      "  graspbench merge results/pilot node1/pilot node2/pilot");
  const auto options = std::make_shared<MergeOptions>();
  AddStoreFolder(command, options->folder, "folder of a session, campaign or optimisation");
  command.AddOption("others", options->others, "folders of the same result on other disks",
                    "OTHER..");
  command
      .AddOption("--set-aside", options->aside,
                 "journal of DIR to ignore and keep aside, for example journal/2of7-0.jsonl",
                 "FILE")
      ->OneValueEach();
  AddJsonOption(command, options->json, "print summary and machines as one JSON object");
  command.SetAction([options] { return Merge(*options); });
}
}  // namespace graspbench
