#include <algorithm>
#include <memory>
#include <string>

#include "core/base/text/text.h"
#include "datasets/plan/scene_names.h"
#include "reports/kind_pages.h"
#include "reports/page/layout.h"
#include "workbench/command.h"
#include "workbench/experiments/machines/shell_quote.h"
#include "workbench/experiments/rehearse_objects.h"
#include "workbench/result_page.h"
#include "workbench/tables/text_table.h"
#include "workbench/terminal/terminal_observer.h"

namespace graspbench {
namespace {

constexpr int kNumPostures = 300;  ///< some 30 s of processor time
constexpr int kLeastDraws = 12;    ///< one of so many postures holds four draws by chance

struct RehearseOptions {
  SessionConfig scene;
  std::vector<std::string> settings;
  RehearsalConfig config;
  RehearseRequest request;
  std::string shard;  ///< empty: all
  bool posture = false, plan_only = false, json = false;
};

std::string FormatRehearsed(const std::vector<RehearsedPair>& pairs) {
  TextTable table({"hand", "object", "chosen", "held", "95 % interval", "tried", "trials"});
  for (const RehearsedPair& pair : pairs) {
    const RehearsedCandidate& choice = pair.result.choice();
    table.AddRow({pair.hand, pair.object, Describe(choice.candidate), choice.FormatHeld(),
                  choice.FormatInterval(), std::to_string(pair.result.tried.size()),
                  std::to_string(pair.result.num_trials)});
  }
  return table.Format() + "on new draws, expect a share in the lower half of the interval\n";
}

Json MakeJson(const std::vector<RehearsedPair>& pairs) {
  Json rows = Json::array();
  for (const RehearsedPair& pair : pairs) {
    rows.push_back({{"hand", pair.hand},
                    {"object", pair.object},
                    {"hash", pair.hash},
                    {"robust", pair.result.is_robust()},
                    {"held", pair.result.choice().CountHeld()},
                    {"candidates", pair.result.tried.size()},
                    {"trials", pair.result.num_trials},
                    {"choice", RecordToJson(pair.result.choice().candidate)}});
  }
  return rows;
}

void PlanRehearsals(const RehearseOptions& options) {
  const auto num_pairs = static_cast<int>(options.request.tasks.size());
  const RehearsalTime time = EstimateRehearsalTime(options.request.tasks);
  if (options.json) {
    return PrintJson({{"pairs", num_pairs},
                      {"candidates", options.config.num_candidates},
                      {"postures", options.config.num_postures},
                      {"draws", options.config.num_draws},
                      {"seconds", time.candidates},
                      {"posture_seconds", time.postures}});
  }
  const std::string tried =
      options.request.types_only
          ? "the standard grasps"
          : "at most " + FormatCount(options.config.num_candidates, "candidate");
  const std::string postures = "if no candidate holds all draws, " + std::to_string(kNumPostures) +
                               " postures more: about " + FormatFixed(time.postures, 0) +
                               " s if that is so for all pairs\n";
  PrintResult(
      FormatCount(num_pairs, "pair") + " of hand and object, " + tried + " with " +
      FormatCount(options.config.num_draws, "draw") + " each\nabout " +
      FormatFixed(time.candidates, 0) +
      " s of one processor for the remaining pairs, estimated from the first pair of each hand\n" +
      (options.posture ? postures : ""));
}

void RunRehearse(RehearseOptions options) {
  options.scene.objects = ExpandObjects(options.scene.objects);
  for (const std::string& setting : options.settings) ApplySetting(setting, options.scene);
  RehearseRequest& request = options.request;
  if (options.posture) options.config.num_postures = kNumPostures;
  if (options.posture) options.config.num_draws = std::max(options.config.num_draws, kLeastDraws);
  request.tasks = ListRehearsalTasks(options.scene, options.config);
  for (RehearsalTask& task : request.tasks) {
    if (request.types_only) task = MakeTypeTask(task, options.config.num_draws);
  }
  if (!options.shard.empty()) request.shard = ParseShard(options.shard);
  if (options.plan_only) return PlanRehearsals(options);
  TerminalObserver observer(
      [&](const Stage& stage) { return request.out.string() + ": " + DescribeTasks(stage); });
  RehearsalPageData data = {options.config, request.tasks, RehearseObjects(request, observer)};
  const auto report = WriteReportPage(request.out, MakeRehearsalPage(data));
  if (options.json) {
    return PrintJson({{"folder", request.out.string()},
                      {"report", report.string()},
                      {"pairs", MakeJson(data.pairs)}});
  }
  PrintResult(FormatRehearsed(data.pairs) + FormatPlaces(report, request.out / kCandidateTable) +
              "grasps   " + (request.out / "grasps").string() + "\n");
}

}  // namespace

void AddRehearseCommand(Command& program) {
  Command& command = AddSubcommand(
      program, "rehearse", "Choose the grasp of each object by imagined trials of many candidates.",
      "  graspbench rehearse --hand tum --object can,cup --out results/rehearsed\n  graspbench "
      "rehearse --object my/mug --candidates 80 --draws 8 --out results/mug\nRepeat the command to "
      "continue.");
  const auto options = std::make_shared<RehearseOptions>();
  AddSceneOptions(command, options->scene);
  command
      .AddOption("--candidates", options->config.num_candidates,
                 "maximum number of candidates per pair of hand and object", "N")
      ->Within(1, 1000)
      ->ShowDefault();
  command
      .AddOption("--draws", options->config.num_draws,
                 "number of sampled initial poses that a grasp must hold to be chosen at once", "K")
      ->Within(1, 100)
      ->ShowDefault();
  command.AddFlag("--posture", options->posture,
                  "if no candidate holds all draws, also search the target angles of the digits: " +
                      std::to_string(kNumPostures) + " postures, at least " +
                      std::to_string(kLeastDraws) + " draws");
  command.AddFlag("--types", options->request.types_only,
                  "rehearse only the standard grasps at the rule's placement and write types.json; "
                  "--candidates has no effect");
  AddSettingsOption(command, options->settings, "model.friction_scale=0.8");
  AddJobsOption(command, options->request.num_workers, "pairs");
  command.AddRequired("--out", options->request.out,
                      "folder for grasps and report; repeat the command to continue", "DIR");
  command.AddOption("--shard", options->shard,
                    "rehearse only every Nth pair, starting with the Kth", "K/N");
  AddListOption(command, "--from", options->request.parts,
                "folders of shards or other rehearsals whose results are reused", "DIR,..");
  command.AddFlag("--plan-only", options->plan_only,
                  "print the number of candidates and seconds; write nothing to --out");
  AddJsonOption(command, options->json);
  command.SetAction([options] { RunRehearse(*options); });
}

}  // namespace graspbench
