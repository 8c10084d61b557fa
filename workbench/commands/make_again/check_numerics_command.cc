#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "core/base/files/files.h"
#include "core/base/text/text.h"
#include "workbench/commands/command.h"
#include "workbench/experiments/interrupt.h"
#include "workbench/experiments/numerics_check.h"
#include "workbench/experiments/output_folder.h"
#include "workbench/tables/numerics_tables.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

struct NumericsOptions {
  std::string folder;
  int trials = 1;
  int num_workers = 1;
  std::string out;
  bool json = false;
};

/** A line before each variant; its few trials need no more. */
class VariantLines : public Observer {
 public:
  void BeginStage(const Stage& stage) override {
    PrintMessage(stage.variant + ": " + FormatCount(stage.num_all, "trial"));
  }
};

void Check(const NumericsOptions& options) {
  if (!options.out.empty()) CheckOutputFile(options.out);
  const Session session = LoadSession(options.folder);
  if (!session.findings.entries().empty()) PrintMessage(session.findings.Format());
  VariantLines observer;
  const NumericsCheck check = CheckNumerics(options.folder, session, options.trials,
                                            options.num_workers, observer, CatchInterrupts());
  const fs::path out = options.out.empty() ? fs::path(options.folder) / "check" / "numerics.csv"
                                           : fs::path(options.out);
  if (out.has_parent_path()) MakeFolder(out.parent_path());
  WriteFileAtomically(out, FormatNumericsCsv(check.comparisons));
  if (options.json) {
    Json json = MakeNumericsJson(check.summaries, check.comparisons);
    json["session"] = options.folder;
    json["data"] = out.string();
    PrintJson(json);
  } else {
    PrintResult(FormatNumericsTables(check.summaries, check.comparisons) + "\ndata     " +
                out.string() + "\n");
  }
}

}  // namespace

void AddCheckNumericsCommand(CLI::App& program, ExitCode&) {
  CLI::App& command =
      AddSubcommand(program, "check-numerics",
                    "Run trials again with other numerics and list the verdicts that flip.",
                    "  graspbench check-numerics results/benchmark-1a2b3c4d\n"
                    "  graspbench check-numerics results/pilot --trials 10 --json");
  const auto options = std::make_shared<NumericsOptions>();
  command.add_option("folder", options->folder, "folder of the session")
      ->required()
      ->option_text("DIR");
  command
      .add_option("--trials", options->trials,
                  "finished trials of each hand, object, grasp to take")
      ->check(CLI::Range(1, 100000))
      ->option_text("N")
      ->capture_default_str();
  AddJobsOption(command, options->num_workers);
  command.add_option("--out", options->out, "table of all comparisons")
      ->option_text("FILE")
      ->default_str("check/numerics.csv in the session");
  command.add_flag("--json", options->json, "print one JSON object");
  command.callback([options] { Check(*options); });
}

}  // namespace graspbench
