#include <filesystem>
#include <memory>
#include <string>

#include "core/base/files/files.h"
#include "human_study/recording/importers/table_mapping.h"
#include "workbench/command.h"
#include "workbench/experiments/machines/shell_quote.h"
#include "workbench/experiments/output_folder.h"
#include "workbench/text/new_files.h"
#include "workbench/text/timed_grasp.h"
#include "workbench/transfer/study_grasps.h"

namespace graspbench {
namespace {

constexpr char kGrasp[] = "grasp";      // of a hand, so that it is no example of its own
constexpr char kMapping[] = "mapping";  // of a table, printed

struct NewOptions {
  std::string kind, folder, study, object;
  std::string from, trial;  ///< of people whose grasp is transferred
  std::string hand = "shadow", grasp = "g1";
};

std::vector<std::string> ListKinds() {
  std::vector<std::string> kinds = ListNewKinds();
  kinds.emplace_back(kGrasp);
  kinds.emplace_back(kMapping);
  return kinds;
}

/** How to go on with what was written. */
std::string FindNextCommand(const NewOptions& options) {
  const std::string &kind = options.kind, &folder = options.folder, name = QuoteForShell(folder);
  if (kind == "session") return "run " + QuoteForShell(folder + "/session.yaml");
  if (kind == "sweep") return "sweep " + QuoteForShell(folder + "/sweep.yaml");
  if (kind == "object") return "object check " + name;
  if (kind == "hand") return "hand check " + name;
  if (kind == "arm") return "run --arm " + name;
  if (kind == "trials") {
    return "campaign --resume --out CAMPAIGN --real " + QuoteForShell(folder + "/trials.csv");
  }
  if (kind == kGrasp) {
    return "run --hand " + QuoteForShell(options.hand) + " --grasp " +
           QuoteForShell(folder + "/grasp.yaml") +
           (options.object.empty() ? "" : " --object " + QuoteForShell(options.object));
  }
  if (kind == "profile") {
    return "grasps judge FILES --profile " + QuoteForShell(folder + "/profile.yaml") +
           " --out judged";
  }
  return "study run " + QuoteForShell(folder + "/study.yaml") + " --out results/study";
}

void WriteNewFiles(const NewOptions& options) {
  std::vector<NewFile> files;
  std::string text;
  if (options.kind == kGrasp) {
    const TimedGrasp timed =
        MakeTimedGrasp({options.hand, options.grasp, options.study, options.object});
    files = {{"grasp.yaml", timed.file}};
    if (!timed.summary.empty()) text = "contacts on " + timed.summary + "\n";
  } else {
    files = MakeNewFiles(options.kind);
  }
  StagedFolder staged({options.folder, "", false, {options.study}});
  for (const auto& [name, content] : files) {
    WriteFile(staged.path() / name, content);
    text += options.folder + "/" + name + "\n";
  }
  if (options.kind != kGrasp) CheckNewFiles(options.kind, staged.path().string());
  staged.Commit();
  if (options.kind == "study") text += "edit     markers and the rows of trials.csv\n";
  PrintResult(text + "next     graspbench " + FindNextCommand(options) + "\n");
}

/** A person's grasp, with its object where that is not of the catalogue. */
ExitCode WriteTransfer(NewOptions options) {
  StagedFolder staged({options.folder, "", false, {options.from}});
  const NewTransfer made = MakeNewTransfer(
      {options.from, "", options.hand, options.trial, options.object}, staged.path());
  if (made.file.empty()) {
    PrintResult(made.summary);
    return kExitFailed;
  }
  WriteFile(staged.path() / "grasp.yaml", made.file);
  const bool is_written = std::filesystem::exists(staged.path() / made.object);
  staged.Commit();
  options.object = is_written ? options.folder + "/" + made.object : made.object;
  PrintResult(made.summary + options.folder + "/grasp.yaml\nnext     graspbench " +
              FindNextCommand(options) + "\n");
  return kExitOk;
}

}  // namespace

void AddNewCommand(Command& program) {
  Command& command =
      AddSubcommand(program, "new", "Write a small example file with every key explained.",
                    "  graspbench new object my_object\n"
                    "  graspbench new session pilot\n"
                    "  graspbench new mapping p01_1.csv > study/columns.yaml\n"
                    "      from the table's heading\n"
                    "  graspbench new grasp timed --timing results/study --object golf_ball\n"
                    "      as people close their hands\n"
                    "  graspbench new grasp like_people --from study.yaml --object cup --hand tum\n"
                    "      where people's digits touched");
  const auto options = std::make_shared<NewOptions>();
  command.AddRequired("kind", options->kind, ListNames(ListKinds()), "KIND")->OneOf(ListKinds());
  command.AddRequired("folder", options->folder, "new or empty folder; for a mapping, the table",
                      "DIR|FILE");
  std::vector<Option*> of_grasp = {
      command.AddOption("--timing", options->study,
                        "for a grasp: study that supplies the contact times", "STUDY"),
      command.AddOption("--from", options->from,
                        "for a grasp: study that supplies the contact positions", "STUDY.YAML"),
      command.AddOption(
          "--trial", options->trial,
          "with --from: use this trial only (default: median of all trials on --object)", "ID"),
      command.AddOption("--object", options->object,
                        "with --timing: object for which the contact times hold (default: only the "
                        "closing delays are set); with --from: object of the study",
                        "ID"),
      command.AddOption("--hand", options->hand, "of a grasp", "HAND")->ShowDefault(),
      command
          .AddOption("--grasp", options->grasp, "standard grasp of the hand to start from", "ID")
          ->ShowDefault()};
  for (const int other : {0, 5}) of_grasp[1]->Excludes(of_grasp[other]);  // contacts decide
  of_grasp[2]->Needs(of_grasp[1]);
  command.SetAction([options, of_grasp] {
    for (const Option* option : of_grasp) {
      if (options->kind == kGrasp || !option->IsGiven()) continue;
      throw Error(ErrorKind::kUsage, option->name() + " is for a grasp, and \"" + options->kind +
                                         "\" is not; leave it out");
    }
    if (!options->object.empty() && options->study.empty() && options->from.empty()) {
      throw Error(ErrorKind::kUsage, "--object needs --timing STUDY or --from STUDY");
    }
    if (!options->from.empty()) return WriteTransfer(*options);
    if (options->kind == kMapping) {
      PrintResult(ProposeMapping(options->folder));
    } else {
      WriteNewFiles(*options);
    }
    return kExitOk;
  });
}

}  // namespace graspbench
