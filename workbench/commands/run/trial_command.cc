#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "datasets/session/explanation_store.h"
#include "datasets/session/find_trial.h"
#include "workbench/command.h"
#include "workbench/experiments/machines/shell_quote.h"
#include "workbench/experiments/output_folder.h"
#include "workbench/pictures/trial_picture.h"
#include "workbench/text/trial_text.h"
#include "workbench/trial_files.h"

namespace graspbench {
namespace {

constexpr double kCoarse = 0.01;  // interval of instants where nobody asks for every step [s]

struct TrialOptions {
  std::filesystem::path folder;
  std::string name;
  std::map<std::string, std::string> files;  // by the option that asks for them
  TrialFileOptions how;
  OnDamage on_damage = OnDamage::kRefuse;
  bool json = false;
};

/** A page names no place: of the session's folder its name alone, however it was typed. */
std::string NameFolder(const std::filesystem::path& folder) {
  std::error_code status;
  const std::filesystem::path place = std::filesystem::weakly_canonical(folder, status);
  return (place.has_filename() ? place : place.parent_path()).filename().string();
}

/** What was asked for, before anything is simulated. */
std::map<std::string, const TrialFile*> FindTrialFiles(const TrialOptions& options) {
  std::map<std::string, const TrialFile*> forms;
  for (const auto& [option, file] : options.files) {
    forms[file] = &FindTrialFile(option, file);
    CheckOutputFile(file);
  }
  if (!options.how.view.empty() && !options.files.count("--render") &&
      !options.files.count("--film")) {
    throw Error(ErrorKind::kUsage, "--camera requires --render or --film");
  }
  CheckInstantName(options.how.at);
  ParsePictureSize(options.how.size);
  ParseSceneView(options.how.view, "trial --help");
  return forms;
}

/** Says what takes long: remedies of a failure are tested, unless `explain` has tested them. */
void AnnounceRemedies(const Session& session, const PlannedTrial& planned) {
  const TrialRecord* record = FindRecord(session, planned);
  if (!record || !record->result.diagnosis || record->result.policy) return;
  const Explanations known = LoadExplanations(session.folder);
  const auto stored = known.find(planned.id);
  if (stored != known.end() && !stored->second.is_short()) return;
  PrintMessage("testing remedies of this failure: some 150 trials; graspbench explain " +
               QuoteForShell(session.folder.string()) + " --all stores them");
}

ExitCode ShowTrial(TrialOptions options) {
  options.how.folder = NameFolder(options.folder);
  const auto forms = FindTrialFiles(options);
  const Session session = LoadSession(options.folder, options.on_damage, RecordParts::kBrief);
  const PlannedTrial& planned = FindPlannedTrial(session, options.name);
  AnnounceRemedies(session, planned);
  const bool needs_all = std::any_of(
      forms.begin(), forms.end(), [](const auto& form) { return form.second->needs_every_step; });
  const ExaminedTrial trial = ExamineTrial(session, planned, needs_all ? 0.0 : kCoarse);
  std::map<std::string, std::string> contents;  // all of them, before the first is written
  for (const auto& [file, form] : forms) contents[file] = form->make(options.how, trial);
  const std::string folder = options.folder.string();
  options.json ? PrintJson(MakeTrialJson(trial, folder)) : PrintResult(FormatTrial(trial, folder));
  for (const auto& [file, content] : contents) {
    WriteOutputFile(file, content);
    PrintMessage(file);
  }
  return trial.difference ? kExitBadInput : kExitOk;
}

}  // namespace

void AddTrialCommand(Command& program) {
  Command& command = AddSubcommand(
      program, "trial", "Simulate one trial of a session again and report its course.",
      "  graspbench trial results/pilot tum-can-g2:3\n"
      "  graspbench trial results/pilot 3f2a --render trial.png --at 1.25s --camera free -60 20 "
      "1.5\n"
      "  graspbench trial results/pilot 3f2a --trace trial.csv --film trial.webp\n"
      "  graspbench trial results/pilot 3f2a --page trial.html\n"
      "  graspbench trial results/pilot 3f2a --json");
  const auto options = std::make_shared<TrialOptions>();
  AddStoreFolder(command, options->folder, "the session");
  command.AddRequired("trial", options->name,
                      "trial_id, its first letters, or hand-object-grasp:number", "ID|CONDITION:N");
  for (const TrialFile& form : ListTrialFiles()) {
    if (!*form.text) continue;  // another form of an option that is there
    command.AddOptionFunction<std::string>(
        form.option,
        [options, &form](const std::string& file) { options->files[form.option] = file; },
        form.text, form.hint);
  }
  const std::vector<Option*> of_picture =
      AddPictureOptions(command, options->how.at, options->how.view, options->how.size);
  of_picture.front()->Needs("--render");
  of_picture.back()->Needs("--render");  // between them the camera, also a film's
  AddAcceptDamageOption(command, options->on_damage);
  AddJsonOption(command, options->json);
  command.SetAction([options] { return ShowTrial(*options); });
}

}  // namespace graspbench
