#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>

#include "core/base/text.h"
#include "datasets/campaign/campaign_progress.h"
#include "datasets/journal/store_kind.h"
#include "datasets/session/worker_log.h"
#include "workbench/commands/command.h"
#include "workbench/experiments/shell_quote.h"
#include "workbench/progress_tables.h"

namespace graspbench {
namespace {

struct StatusOptions {
  std::filesystem::path folder;
  double stale_after = 600.0;  // [s]; the longest trials of a benchmark take a second
  bool json = false;
};

void PrintUnchecked(const std::set<std::string>& labels) {
  if (!labels.empty()) PrintMessage("note: " + DescribeUnchecked(labels));
}

void PrintStatus(const std::filesystem::path& folder, const SessionProgress& progress) {
  PrintResult(folder.string() + ": " + std::to_string(progress.num_finished) + " of " +
              FormatCount(progress.num_trials, "trial") + " finished\n" +
              FormatShards(progress.shards, "trials"));
  if (progress.judge) {
    PrintResult("\n" + std::to_string(progress.judge->num_judged) + " of " +
                FormatCount(progress.judge->num_held, "held grasp") + " judged\n" +
                FormatShards(progress.judge->shards, "held grasps"));
  }
  PrintUnchecked(progress.unchecked);
  if (progress.num_foreign_lines > 0) {
    PrintMessage("note: " + FormatCount(progress.num_foreign_lines, "record is", "records are") +
                 " of trials that the plan does not have; nobody reads them");
  }
}

void FailOnDamage(const std::filesystem::path& folder, const std::vector<Damage>& damages,
                  int num_bad_lines) {
  if (damages.empty() && num_bad_lines == 0) return;
  const std::string lines =
      num_bad_lines > 0
          ? FormatCount(num_bad_lines, "damaged line is", "damaged lines are") + " left out"
          : "\"" + folder.string() + "\" is damaged";
  throw Error(ErrorKind::kFormat, lines + "; see graspbench verify " +
                                      QuoteForShell(folder.string()) + FormatDamage(damages));
}
void FailOnDamage(const std::filesystem::path& folder, const SessionProgress& progress) {
  FailOnDamage(folder, progress.damages, progress.num_bad_lines);
}
void FailOnDamage(const std::filesystem::path& folder, const CampaignProgress& progress) {
  FailOnDamage(folder, progress.damages, 0);
  if (progress.benchmark) FailOnDamage(folder / "benchmark", *progress.benchmark);
}

void PrintStatus(const std::filesystem::path& folder, const CampaignProgress& progress) {
  PrintResult(folder.string() + ": " + std::to_string(progress.num_finished) + " of " +
              FormatCount(progress.num_scenes, "scene") + " finished" +
              (progress.num_searches > 0
                   ? "; " + FormatCount(progress.num_searches, "search", "searches") + " begun"
                   : "") +
              "\n" + FormatShards(progress.shards, "scenes"));
  PrintUnchecked(progress.unchecked);
  if (progress.benchmark) PrintStatus(folder / "benchmark", *progress.benchmark);
}

void ShowStatus(const StatusOptions& options) {
  const StoreKind* kind = FindStoreKind(options.folder);
  const auto show = [&options](const auto& progress) {
    if (options.json) {
      PrintJson(MakeStatusJson(progress));
    } else {
      PrintStatus(options.folder, progress);
    }
    FailOnDamage(options.folder, progress);
  };
  if (kind == &kCampaignStore)
    return show(ReadCampaignProgress(options.folder, options.stale_after));
  if (kind != &kSceneStore) return show(ReadProgress(options.folder, options.stale_after));
  const SceneProgress scene = ReadSceneProgress(options.folder);
  if (options.json) {
    PrintJson({{"answers", scene.num_answers},
               {"finished", scene.is_finished},
               {"age_s", scene.age ? Json(*scene.age) : Json(nullptr)}});
  } else {
    PrintResult(options.folder.string() + ": " + (scene.is_finished ? "" : "not ") + "finished, " +
                FormatCount(scene.num_answers, "evaluation") + " kept" +
                (scene.age ? ", the last " + FormatFixed(*scene.age, 0) + " s ago" : "") + "\n");
  }
}

}  // namespace

void AddStatusCommand(CLI::App& program, ExitCode&) {
  CLI::App& command = AddSubcommand(
      program, "status", "Show how far the shards of a session or campaign are, by its journals.",
      "  graspbench status results/pilot\n"
      "  graspbench status results/pilot --stale-after 3600 --json");
  const auto options = std::make_shared<StatusOptions>();
  AddStoreFolder(command, options->folder, "folder of a session, campaign or optimisation");
  AddSecondsOption(command, "--stale-after", options->stale_after,
                   "seconds without a new line after which an unfinished shard is stale");
  command.add_flag("--json", options->json, "print one JSON object");
  command.callback([options] { ShowStatus(*options); });
}

}  // namespace graspbench
