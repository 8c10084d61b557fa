#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>

#include "core/base/files/files.h"
#include "core/base/text/text.h"
#include "datasets/analysis/basin_summary.h"
#include "reports/basin_page.h"
#include "workbench/commands/command.h"
#include "workbench/experiments/interrupt.h"
#include "workbench/experiments/machines/shell_quote.h"
#include "workbench/experiments/map_basin.h"
#include "workbench/experiments/output_folder.h"
#include "workbench/terminal/terminal_observer.h"

namespace graspbench {
namespace {

struct BasinOptions {
  BasinRequest request;
  std::string out;
  bool replace = false;
  int num_workers = 1;
};

/** For the page: without where it was written to. */
std::string FormatCommand(const BasinRequest& request) {
  return "graspbench basin --hand " + QuoteForShell(request.hand) + " --object " +
         QuoteForShell(request.object) + " --grasp " + QuoteForShell(request.grasp) +
         " --samples " + std::to_string(request.num_samples) + " --out DIR";
}

void Run(const BasinOptions& options) {
  StagedFolder staged({options.out,
                       "basin",
                       options.replace,
                       {options.request.hand, options.request.object, options.request.grasp}});
  const std::atomic<bool>& stop = CatchInterrupts();
  TerminalObserver observer({}, stop);
  const BasinMap map = MapBasin(options.request, options.num_workers, observer, stop);
  WriteFileAtomically(staged.path() / "basin.csv", FormatBasinCsv(map.samples));
  const std::filesystem::path page = std::filesystem::path("report") / "index.html";
  MakeFolder(staged.path() / page.parent_path());
  WriteFileAtomically(staged.path() / page,
                      MakeBasinPage({map.title, FormatCommand(options.request), map.samples}));
  staged.Commit();
  const BasinSummary summary = SummariseBasin(map.samples);
  PrintResult(map.title + ": basin radius " + FormatFixed(summary.radius, 2) + " (" +
              FormatFixed(MmFromM(summary.radius_offset), 1) + " mm, " +
              FormatFixed(DegFromRad(summary.radius_yaw), 1) + " deg)\nreport   " +
              (std::filesystem::path(options.out) / page).string() + "\n");
}

}  // namespace

void AddBasinCommand(CLI::App& program, ExitCode&) {
  CLI::App& command = AddSubcommand(
      program, "basin", "Map the placement error that a grasp tolerates.",
      "  graspbench basin --hand tum --object golf_ball --out ball_basin\n"
      "  graspbench basin --hand shadow --object can --grasp g3 --samples 400 --out can_basin");
  const auto options = std::make_shared<BasinOptions>();
  BasinRequest& request = options->request;
  command.add_option("--hand", request.hand, "hand by id or folder")
      ->required()
      ->option_text("HAND");
  command.add_option("--object", request.object, "object by id or folder")
      ->required()
      ->option_text("OBJECT");
  command.add_option("--grasp", request.grasp, "best, an id or a grasp file")
      ->option_text("GRASP")
      ->capture_default_str();
  command.add_option("--samples", request.num_samples, "offsets to try")
      ->check(CLI::Range(1, 100000))
      ->option_text("N")
      ->capture_default_str();
  AddJobsOption(command, options->num_workers);
  AddTrialTimeoutOption(command, request.trial_time_limit);
  command.add_option("--out", options->out, "folder for report and basin.csv")
      ->required()
      ->option_text("DIR");
  AddReplaceOption(command, options->replace);
  command.callback([options] { Run(*options); });
}

}  // namespace graspbench
