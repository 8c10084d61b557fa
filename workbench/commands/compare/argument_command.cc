#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/base/files/files.h"
#include "datasets/analysis/argument/argument_evidence.h"
#include "reports/kind_pages.h"
#include "workbench/command.h"
#include "workbench/experiments/output_folder.h"
#include "workbench/result_page.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

struct ArgumentOptions {
  std::vector<std::string> folders;
  std::string out;
  bool replace = false, json = false;
};

void ShowArgument(const ArgumentOptions& options) {
  const std::vector<fs::path> folders(options.folders.begin(), options.folders.end());
  const ArgumentSources sources = LoadArgumentSources(folders);
  const std::vector<ArgumentClaim> claims = MakeArgument(sources);
  Json json = ToJson(claims);
  json["read"] = sources.Describe();
  if (!options.out.empty()) {
    StagedFolder staged({options.out, "argument", options.replace, folders,
                         "graspbench argument FOLDER.. --out DIR"});
    WriteFile(staged.path() / "argument.json", FormatJson(json, 2) + "\n");
    WriteFile(staged.path() / "index.html", MakeArgumentPage(claims, sources.Describe()));
    staged.Commit();
  }
  if (options.json) return PrintJson(json);
  PrintMessage("read: " + sources.Describe());
  PrintResult(FormatArgument(claims));
  if (options.out.empty()) return;
  PrintResult(
      FormatPlaces(fs::path(options.out) / "index.html", fs::path(options.out) / "argument.json"));
}

}  // namespace

void AddArgumentCommand(Command& program) {
  Command& command = AddSubcommand(
      program, "argument", "Report the evidence of finished results for the thesis's five claims.",
      "  graspbench argument results --out argument     every result below the folder\n  "
      "graspbench argument study map campaign         five lines, without a page\nNothing is "
      "simulated. Missing evidence is listed with its command.");
  const auto options = std::make_shared<ArgumentOptions>();
  command.AddRequired(
      "folders", options->folders,
      "results of study run, map, optimise, campaign, run, or folders with such results", "DIR..");
  command.AddOption("--out", options->out, "folder for the page and argument.json", "DIR");
  AddReplaceOption(command, options->replace);
  AddJsonOption(command, options->json);
  command.SetAction([options] { ShowArgument(*options); });
}

}  // namespace graspbench
