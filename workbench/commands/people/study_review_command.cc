#include <algorithm>
#include <memory>

#include "core/base/text/text.h"
#include "human_study/study/suggest/suggest_settings.h"
#include "reports/study/trial_figures.h"
#include "workbench/command.h"
#include "workbench/experiments/machines/shell_quote.h"
#include "workbench/experiments/output_folder.h"
#include "workbench/text/study_text.h"

namespace graspbench {
namespace {

struct ReviewOptions {
  std::string study_file, data, out;
  std::vector<std::string> trials;  ///< with pages; empty: all
  std::vector<std::string> settings;
  bool replace = false;
};

bool IsOfAll(const ReviewOptions& options) {
  return options.trials.empty() || options.trials == std::vector<std::string>{"all"};
}

void CheckAllFound(const ReviewOptions& options, const StudyResult& result) {
  std::vector<std::string> ids;
  for (const StudyTrial& trial : result.trials) ids.push_back(trial.id);
  if (IsOfAll(options)) return;
  for (const std::string& id : options.trials) {
    if (std::find(ids.begin(), ids.end(), id) == ids.end()) {
      throw Error(ErrorKind::kUsage,
                  "--trials: no trial \"" + id + "\" in this study" + SuggestNames(id, ids));
    }
  }
}

void RunReview(const ReviewOptions& options) {
  StagedFolder staged(
      {options.out, "study review", options.replace, {options.study_file, options.data}});
  const Study study = LeaveOutReport(LoadStudy(options.study_file, options.data, options.settings));
  ReviewPages pages(staged.path());
  int num_pages = 0;
  StudyWatch watch;
  watch.on_analysed = [&](const StudyTrial& trial, const ReachTrial& reach) {
    const bool is_wanted =
        IsOfAll(options) ||
        std::find(options.trials.begin(), options.trials.end(), trial.id) != options.trials.end();
    if (!is_wanted) return;
    pages.WriteTrial(trial, reach, study.factors, study.config.analysis);
    ++num_pages;
  };
  const StudyResult result = RunStudy(study, watch);
  CheckAllFound(options, result);
  pages.Finish(result);
  staged.Commit();
  const std::filesystem::path out = options.out;
  PrintResult("pages    " + std::to_string(num_pages) + ", " + (out / "index.html").string() +
              "\nverdicts " + (out / "reviews.csv").string() +
              ": fill it in, name it in study.yaml under reviews\n");
}

/** How to run the study under what is suggested. */
std::string MakeRunCommand(const ReviewOptions& options, const StudySuggestions& suggestions) {
  std::string command = "graspbench study run " + QuoteForShell(options.study_file);
  if (!options.data.empty()) command += " --data " + QuoteForShell(options.data);
  std::vector<std::string> settings = options.settings;
  for (const Suggestion& suggestion : suggestions.suggestions) {
    settings.insert(settings.end(), suggestion.settings.begin(), suggestion.settings.end());
  }
  for (const std::string& setting : settings) command += " --set " + QuoteForShell(setting);
  return command + " --out results/suggested";
}

void RunSuggest(const ReviewOptions& options) {
  const Study study = LoadStudy(options.study_file, options.data, options.settings);
  if (!study.warnings.entries().empty()) PrintMessage(study.warnings.Format());
  const StudySuggestions suggestions = SuggestSettings(study);
  PrintResult(FormatSuggestions(suggestions));
  if (suggestions.suggestions.empty()) return;
  PrintResult("try      " + MakeRunCommand(options, suggestions) +
              "\n         and, when convinced, copy into " + options.study_file + "\n");
}

void AddStudyOptions(Command& command, ReviewOptions& options) {
  command.AddRequired("study", options.study_file, "what was recorded and every choice",
                      "STUDY.YAML");
  command.AddOption("--data", options.data, "folder of the recordings", "DIR")
      ->ShowDefault("that of study.yaml");
}

}  // namespace

void AddStudyReviewCommand(Command& program) {
  const auto options = std::make_shared<ReviewOptions>();
  Command& review = AddSubcommand(
      program.Subcommand("study"), "review",
      "Write pages for reviewing every contact, and a table for verdicts that a run applies.",
      "  graspbench study review study.yaml --out review\n"
      "  graspbench study review study.yaml --trials P1-3,P2-1 --out review");
  AddStudyOptions(review, *options);
  review.AddRequired("--out", options->out, "folder for the pages", "DIR");
  review.AddOption("--trials", options->trials, "write pages of these trials only")
      ->SplitAtCommas()
      ->ShowDefault("all");
  AddSettingsOption(review, options->settings, "contact.detector=surface");
  AddReplaceOption(review, options->replace);
  review.SetAction([options] { RunReview(*options); });

  Command& suggest = AddSubcommand(
      program.Subcommand("study"), "suggest",
      "Propose settings from the data, with reasons; nothing is changed.",
      "  graspbench study suggest study.yaml\n"
      "  graspbench study suggest study.yaml --data /data/mocap --set contact.cutoff_hz=15");
  AddStudyOptions(suggest, *options);
  AddSettingsOption(suggest, options->settings, "contact.detector=surface");
  suggest.SetAction([options] { RunSuggest(*options); });
}

}  // namespace graspbench
