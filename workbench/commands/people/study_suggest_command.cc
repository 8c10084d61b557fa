#include <memory>

#include "human_study/study/suggest/suggest_settings.h"
#include "workbench/commands/command.h"
#include "workbench/experiments/machines/shell_quote.h"
#include "workbench/text/study_text.h"

namespace graspbench {
namespace {

struct SuggestOptions {
  std::string study_file, data;
  std::vector<std::string> settings;
};

/** How to run the study under what is suggested. */
std::string MakeRunCommand(const SuggestOptions& options, const StudySuggestions& suggestions) {
  std::string command = "graspbench study run " + QuoteForShell(options.study_file);
  if (!options.data.empty()) command += " --data " + QuoteForShell(options.data);
  std::vector<std::string> settings = options.settings;
  for (const Suggestion& suggestion : suggestions.suggestions) {
    settings.insert(settings.end(), suggestion.settings.begin(), suggestion.settings.end());
  }
  for (const std::string& setting : settings) command += " --set " + QuoteForShell(setting);
  return command + " --out results/suggested";
}

void RunSuggest(const SuggestOptions& options) {
  const Study study = LoadStudy(options.study_file, options.data, options.settings);
  if (!study.warnings.entries().empty()) PrintMessage(study.warnings.Format());
  const StudySuggestions suggestions = SuggestSettings(study);
  PrintResult(FormatSuggestions(suggestions));
  if (suggestions.suggestions.empty()) return;
  PrintResult("try      " + MakeRunCommand(options, suggestions) +
              "\n         and what convinces you, write into " + options.study_file + "\n");
}

}  // namespace

void AddStudySuggestCommand(Command& program, ExitCode&) {
  const auto options = std::make_shared<SuggestOptions>();
  Command& suggest = AddSubcommand(
      program.Subcommand("study"), "suggest",
      "Propose settings that the data ask for, with reasons; changes nothing.",
      "  graspbench study suggest study.yaml\n"
      "  graspbench study suggest study.yaml --data /data/mocap --set contact.cutoff_hz=15");
  suggest.AddOption("study", options->study_file, "what was recorded and every choice")
      ->Require()
      ->ValueName("STUDY.YAML");
  suggest.AddOption("--data", options->data, "folder of the recordings")
      ->ValueName("DIR")
      ->ShowDefault("that of study.yaml");
  AddSettingsOption(suggest, options->settings, "contact.detector=surface");
  suggest.SetAction([options] { RunSuggest(*options); });
}

}  // namespace graspbench
