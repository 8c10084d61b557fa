#include <memory>
#include <string>

#include "core/base/text/text.h"
#include "datasets/judged_grasps/grasp_store.h"
#include "datasets/judged_grasps/profile_file.h"
#include "reports/kind_pages.h"
#include "reports/page/layout.h"
#include "workbench/command.h"
#include "workbench/commands/options/foreign_grasp_options.h"
#include "workbench/experiments/judge_grasps.h"
#include "workbench/tables/foreign_grasp_tables.h"
#include "workbench/terminal/terminal_observer.h"

namespace graspbench {
namespace {

struct JudgeGraspsOptions {
  GraspInputOptions inputs;
  std::vector<std::string> profiles = {"dexgraspbench-fc"};
  JudgeGraspsRequest request;
  std::string shard;  ///< empty: all
  bool json = false;
};

struct MergeGraspsOptions {
  std::vector<std::filesystem::path> parts;
  std::filesystem::path out;
  bool json = false;
};

void PrintUnread(const std::vector<UnreadFile>& unread) {
  constexpr size_t kMostPrinted = 10;
  for (size_t i = 0; i < unread.size() && i < kMostPrinted; ++i) {
    PrintMessage("warning: not judged: " + unread[i].name + ": " + unread[i].reason);
  }
  if (unread.size() <= kMostPrinted) return;
  PrintMessage("warning: " + std::to_string(unread.size() - kMostPrinted) +
               " more are not judged; the report names them");
}

void ShowJudged(const std::filesystem::path& folder, size_t num_unread, bool as_json) {
  const Json config = LoadGraspConfig(folder);
  const std::vector<JudgedGrasp> judged = LoadJudgedGrasps(folder);
  const JudgedSummary summary = SummariseJudged(judged, FindLimits(config));
  const std::filesystem::path report =
      WriteReportPage(folder, MakeGraspsPage(config, judged, summary));
  if (as_json) {
    return PrintJson({{"folder", folder.string()},
                      {"report", report.string()},
                      {"grasps", summary.num_grasps},
                      {"not_judged", num_unread},
                      {"profiles", MakeJson(summary)}});
  }
  PrintResult(FormatJudged(summary) + "\ntable    " + (folder / kGraspTable).string() +
              "\nreport   " + report.string() + "\n");
}

/** Files or grasps that could not be judged do not stop the others, but scripts shall see them. */
ExitCode Judge(const JudgeGraspsOptions& options) {
  JudgeGraspsRequest request = options.request;
  request.profiles = LoadProfiles(options.profiles);
  if (!options.shard.empty()) request.shard = ParseShard(options.shard);
  const GraspInputs inputs = options.inputs.Load(request.profiles);
  PrintUnread(inputs.unread);
  TerminalObserver observer([&](const Stage& stage) {
    return request.out.string() + ": " + DescribeTasks(stage) + " of " +
           FormatCount(static_cast<int>(inputs.grasps.size()), "grasp") + " on " +
           FormatCount(request.num_workers, "worker");
  });
  DemandFinished(JudgeGrasps(request, inputs, observer));
  ShowJudged(request.out, inputs.unread.size(), options.json);
  return inputs.unread.empty() ? kExitOk : kExitBadInput;
}

}  // namespace

void AddGraspsJudgeCommand(Command& program) {
  const auto options = std::make_shared<JudgeGraspsOptions>();
  Command& command = AddSubcommand(
      program.Subcommand("grasps"), "judge",
      "Judge external grasps under published or own profiles.",
      "  graspbench grasps judge downloaded/ --objects meshes --out judged\n"
      "  graspbench grasps judge downloaded/ --objects meshes --profile dexgraspbench-fc,own "
      "--jitter 20 --out judged");
  options->inputs.AddTo(command);
  AddListOption(command, "--profile", options->profiles,
                "profiles by name (datasets/profiles) or file", "P,P..");
  command
      .AddOption(
          "--jitter", options->request.jitter,
          "number of repetitions per grasp with the root moved by 1 mm and turned by 1 degree", "N")
      ->Within(0, 1000)
      ->ShowDefault();
  AddJobsOption(command, options->request.num_workers, "grasps");
  command.AddRequired("--out", options->request.out,
                      "folder for verdicts and report; repeat the command to continue", "DIR");
  command.AddOption(
      "--shard", options->shard,
      "judge only every Nth grasp, starting with the Kth; grasps merge joins the folders", "K/N");
  AddJsonOption(command, options->json);
  command.SetAction([options] { return Judge(*options); });

  const auto merged = std::make_shared<MergeGraspsOptions>();
  Command& merge = AddSubcommand(
      program.Subcommand("grasps"), "merge", "Join the shards of a judgement into one folder.",
      "  graspbench grasps judge downloaded/ --objects meshes --shard 1/2 --out part1\n"
      "  graspbench grasps judge downloaded/ --objects meshes --shard 2/2 --out part2\n"
      "  graspbench grasps merge part1 part2 --out judged");
  merge.AddRequired("parts", merged->parts, "folders of all shards", "DIRS..");
  merge.AddRequired("--out", merged->out, "new folder", "DIR");
  AddJsonOption(merge, merged->json);
  merge.SetAction([merged] {
    MergeJudgedGrasps(merged->parts, merged->out);
    ShowJudged(merged->out, LoadGraspConfig(merged->out).at("unread").size(), merged->json);
  });
}

}  // namespace graspbench
