#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <memory>

#include "core/base/files.h"
#include "core/base/text.h"
#include "datasets/session/session_store.h"
#include "workbench/commands/command.h"
#include "workbench/experiments/numerics_check.h"
#include "workbench/numerics_tables.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

struct CheckOptions {
  std::string folder;
  int trials = 1;
  int num_workers = 1;
  std::string out;
  bool json = false;
};

void CheckNumerics(const CheckOptions& options) {
  const Session session = LoadSession(options.folder);
  if (!session.findings.entries().empty()) std::cerr << session.findings.Format() << '\n';
  const SessionInputs inputs = LoadSessionInputs(session.config);
  CheckSameSession(session, session.config, MakePlan(session.config, inputs));
  const std::vector<TrialRecord> trials = ChooseTrials(session.records, options.trials);
  if (trials.empty()) {
    throw Error(ErrorKind::kUsage, "the session in \"" + options.folder +
                                       "\" has no finished trial; graspbench run --resume --out " +
                                       options.folder + " runs them");
  }

  std::vector<NumericsComparison> comparisons;
  std::vector<NumericsSummary> summaries;
  for (const NumericsVariant& variant : ListNumericsVariants(session.config.sim)) {
    const std::vector<TrialRecord> covered = FindCovered(trials, variant, inputs);
    std::cerr << variant.id << ": " << FormatCount(static_cast<int>(covered.size()), "trial")
              << '\n';
    const std::vector<TrialResult> results =
        RerunTrials(covered, variant, session.config, inputs, options.num_workers);
    for (size_t i = 0; i < covered.size(); ++i) {
      comparisons.push_back({variant.id, covered[i], results[i]});
    }
    summaries.push_back(SummariseNumerics(variant.id, comparisons));
  }

  const fs::path out = options.out.empty() ? fs::path(options.folder) / "check" / "numerics.csv"
                                           : fs::path(options.out);
  if (out.has_parent_path()) MakeFolder(out.parent_path());
  WriteFileAtomically(out, FormatNumericsCsv(comparisons));
  if (options.json) {
    Json json = MakeNumericsJson(summaries, comparisons);
    json["session"] = options.folder;
    json["data"] = out.string();
    PrintJson(json);
  } else {
    std::cout << FormatNumericsTables(summaries, comparisons) << "\ndata     " << out.string()
              << '\n';
  }
}

}  // namespace

void AddCheckNumericsCommand(CLI::App& program, ExitCode&) {
  CLI::App& command =
      AddSubcommand(program, "check-numerics",
                    "Runs trials again with other numerics and lists the verdicts that flip.",
                    "  graspbench check-numerics results/benchmark-1a2b3c4d\n"
                    "  graspbench check-numerics results/pilot --trials 10 --json");
  const auto options = std::make_shared<CheckOptions>();
  command.add_option("folder", options->folder, "folder of the session")
      ->required()
      ->option_text("DIR");
  command
      .add_option("--trials", options->trials,
                  "finished trials of each hand, object, grasp to take (default 1)")
      ->check(CLI::Range(1, 100000))
      ->option_text("N");
  AddJobsOption(command, options->num_workers);
  command
      .add_option("--out", options->out,
                  "table of all comparisons (default: check/numerics.csv in the session)")
      ->option_text("FILE");
  command.add_flag("--json", options->json, "one JSON object");
  command.callback([options] { CheckNumerics(*options); });
}

}  // namespace graspbench
