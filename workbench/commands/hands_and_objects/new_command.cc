#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "core/base/files/files.h"
#include "workbench/commands/command.h"
#include "workbench/experiments/machines/shell_quote.h"
#include "workbench/experiments/output_folder.h"
#include "workbench/text/new_files.h"

namespace graspbench {
namespace {

/** How to go on with what was written. */
std::string FindNextCommand(const std::string& kind, const std::string& folder) {
  const std::string name = QuoteForShell(folder);
  if (kind == "session") return "run " + QuoteForShell(folder + "/session.yaml");
  if (kind == "sweep") return "sweep " + QuoteForShell(folder + "/sweep.yaml");
  if (kind == "object") return "object check " + name;
  if (kind == "hand") return "hand check " + name;
  if (kind == "trials") {
    return "campaign --resume --out CAMPAIGN --real " + QuoteForShell(folder + "/trials.csv");
  }
  return "study run " + QuoteForShell(folder + "/study.yaml") + " --out results/study";
}

void WriteNewFiles(const std::string& kind, const std::string& folder) {
  StagedFolder staged({folder, "", false, {}});
  std::string text;
  for (const auto& [name, content] : MakeNewFiles(kind)) {
    WriteFile(staged.path() / name, content);
    text += folder + "/" + name + "\n";
  }
  CheckNewFiles(kind, staged.path().string());
  staged.Commit();
  PrintResult(text + "next     graspbench " + FindNextCommand(kind, folder) + "\n");
}

}  // namespace

void AddNewCommand(CLI::App& program, ExitCode&) {
  CLI::App& command =
      AddSubcommand(program, "new", "Write a small example to start from, every key explained.",
                    "  graspbench new object my_object\n"
                    "  graspbench new session pilot");
  const auto kind = std::make_shared<std::string>();
  const auto folder = std::make_shared<std::string>();
  command.add_option("kind", *kind, ListNames(ListNewKinds()))
      ->required()
      ->check(CLI::IsMember(ListNewKinds()))
      ->option_text("KIND");
  command.add_option("folder", *folder, "new or empty")->required()->option_text("DIR");
  command.callback([kind, folder] { WriteNewFiles(*kind, *folder); });
}

}  // namespace graspbench
