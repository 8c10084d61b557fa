#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "core/base/text/text.h"
#include "datasets/judged_grasps/judged_summary.h"
#include "reports/grasps_page.h"
#include "reports/page/write_page.h"
#include "workbench/commands/command.h"
#include "workbench/commands/options/foreign_grasp_options.h"
#include "workbench/experiments/interrupt.h"
#include "workbench/experiments/judge_grasps.h"
#include "workbench/experiments/machines/shell_quote.h"
#include "workbench/tables/text_table.h"
#include "workbench/terminal/terminal_observer.h"

namespace graspbench {
namespace {

struct JudgeGraspsOptions {
  ForeignGraspOptions grasps;
  JudgeGraspsRequest request;
  std::string hand = "shadow";
  std::filesystem::path objects;
  bool json = false;
};

std::string FormatSummary(const JudgedSummary& summary) {
  TextTable table(
      {"profile", "grasps", "passed", "95 % interval", "agreement with labels", "most failed at"});
  for (const ProfileSummary& profile : summary.profiles) {
    const double kappa = profile.labels.num_pairs() > 0 ? CalcKappa(profile.labels) : kUnset;
    table.AddRow({profile.profile, std::to_string(profile.num_judged),
                  std::to_string(profile.num_passed),
                  FormatRateInterval(profile.num_passed, profile.num_judged) + " %",
                  std::isfinite(kappa) ? "kappa " + FormatFixed(kappa, 2) : "-",
                  profile.stages.empty() ? "-" : profile.stages.front().first});
  }
  return table.Format();
}

Json MakeJson(const JudgedSummary& summary) {
  Json profiles = Json::array();
  for (const ProfileSummary& profile : summary.profiles) {
    const Interval interval = CalcWilsonInterval(profile.num_passed, profile.num_judged);
    profiles.push_back({{"profile", profile.profile},
                        {"judged", profile.num_judged},
                        {"passed", profile.num_passed},
                        {"numerical_failures", profile.num_numerical},
                        {"interval_low", interval.low},
                        {"interval_high", interval.high},
                        {"labelled", profile.labels.num_pairs()},
                        {"kappa", JsonNumber(CalcKappa(profile.labels))},
                        {"jitter_share", JsonNumber(profile.jitter_share)}});
  }
  return profiles;
}

void PrintUnread(const std::vector<UnreadFile>& unread) {
  constexpr size_t kMostPrinted = 10;
  for (size_t i = 0; i < unread.size() && i < kMostPrinted; ++i) {
    PrintMessage("warning: not judged: " + unread[i].name + ": " + unread[i].reason);
  }
  if (unread.size() <= kMostPrinted) return;
  PrintMessage("warning: " + std::to_string(unread.size() - kMostPrinted) +
               " more are not judged; the report names them");
}

/** Files or grasps that could not be judged do not stop the others, but scripts shall see them. */
ExitCode Judge(const JudgeGraspsOptions& options) {
  const GraspInputs inputs = LoadGraspInputs(options.grasps.Read(), options.hand, options.objects);
  PrintUnread(inputs.unread);
  const JudgeGraspsRequest& request = options.request;
  const std::atomic<bool>& stop = CatchInterrupts();
  TerminalObserver observer(
      [&](const Stage& stage) {
        return request.out.string() + ": " + DescribeTasks(stage) + " of " +
               FormatCount(static_cast<int>(inputs.grasps.size()), "grasp") + " on " +
               FormatCount(request.num_workers, "worker");
      },
      stop);
  if (!JudgeGrasps(request, inputs, observer, stop)) {
    throw Error(ErrorKind::kInterrupted,
                "stopped; what was judged is kept. The same command again continues");
  }
  const std::vector<JudgedGrasp> judged = LoadJudgedGrasps(request.out);
  const Json config = LoadGraspConfig(request.out);
  const JudgedSummary summary = SummariseJudged(judged, FindLimits(config));
  const std::filesystem::path report =
      WriteReportPage(request.out, MakeGraspsPage(config, judged, summary));
  const ExitCode exit_code = inputs.unread.empty() ? kExitOk : kExitBadInput;
  if (options.json) {
    PrintJson({{"folder", request.out.string()},
               {"report", report.string()},
               {"grasps", inputs.grasps.size()},
               {"not_judged", inputs.unread.size()},
               {"profiles", MakeJson(summary)}});
    return exit_code;
  }
  PrintResult(FormatSummary(summary) + "\ntable    " + (request.out / "grasps.csv").string() +
              "\nreport   " + report.string() + "\n");
  return exit_code;
}

}  // namespace

void AddGraspsJudgeCommand(CLI::App& program, ExitCode& exit_code) {
  const auto options = std::make_shared<JudgeGraspsOptions>();
  CLI::App& command = AddSubcommand(
      *program.get_subcommand("grasps"), "judge", "Judge grasps that others made under profiles.",
      "  graspbench grasps judge downloaded/ --objects meshes --out judged\n"
      "  graspbench grasps judge downloaded/ --objects meshes --profile dexgraspbench-fc,own "
      "--jitter 20 --out judged");
  options->grasps.AddTo(command);
  command.add_option("--hand", options->hand, "hand by id or folder")
      ->option_text("HAND")
      ->capture_default_str();
  command
      .add_option("--objects", options->objects,
                  "folder of the meshes; a grasp's object is looked for by every end of its path")
      ->option_text("DIR");
  AddListOption(command, "--profile", options->request.profiles,
                "profiles by name (datasets/profiles) or file", "P,P..");
  command
      .add_option(
          "--jitter", options->request.jitter,
          "also judge each grasp so often with its root moved by 1 mm and turned by 1 degree")
      ->check(CLI::Range(0, 1000))
      ->option_text("N")
      ->capture_default_str();
  AddJobsOption(command, options->request.num_workers, "grasps");
  command
      .add_option("--out", options->request.out,
                  "folder for verdicts and report; the same command again continues it")
      ->required()
      ->option_text("DIR");
  AddJsonOption(command, options->json);
  command.callback([options, &exit_code] { exit_code = Judge(*options); });
}

}  // namespace graspbench
