#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include "core/base/files.h"
#include "core/base/text.h"
#include "core/grasp/standard_grasp.h"
#include "core/hand/import/import_hand.h"
#include "core/hand/load_hand.h"
#include "objects/load_mesh.h"
#include "workbench/commands/command.h"
#include "workbench/diagnostics_output.h"
#include "workbench/experiments/output_folder.h"
#include "workbench/forward_kinematics.h"
#include "workbench/hand_tables.h"

namespace graspbench {
namespace {

ExitCode CheckHandCommand(const std::string& path, bool json) {
  Diagnostics problems;
  const Hand hand = CheckHand(path, problems);
  if (problems.num_errors() == 0) {
    try {
      LoadStandardGrasps(hand);
    } catch (const Error& error) {
      problems.Fail(path, 0, error.what());
    }
  }
  if (json) {
    PrintJson({{"usable", problems.num_errors() == 0}, {"problems", MakeJson(problems)}});
  } else {
    PrintFindings(problems);
    PrintResult(path + ": " + (problems.num_errors() == 0 ? "can be used" : "cannot be used") +
                FormatFindingCounts(problems) + "\n");
  }
  return problems.num_errors() == 0 ? kExitOk : kExitBadInput;
}

struct HandImportOptions {
  std::string file, out, palm;
  std::vector<std::string> package_path;
  bool replace = false;
};

ExitCode ImportHandCommand(const HandImportOptions& options, bool json) {
  namespace fs = std::filesystem;
  const fs::path file = options.file;
  StagedFolder staged({options.out, "hand", options.replace, {file}});
  HandSource source;
  source.file = options.file;
  source.folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  source.package_path.assign(options.package_path.begin(), options.package_path.end());
  source.load_mesh = &LoadPictureMesh;
  Diagnostics problems;
  const ImportedFiles imported = ImportHand(ReadFile(file), source, options.palm, problems);
  for (const auto& [name, content] : imported.files) {
    MakeFolder((staged.path() / name).parent_path());
    WriteFile(staged.path() / name, content);
  }
  if (problems.num_errors() == 0) CheckHand(staged.path().string(), problems);
  const bool is_usable = problems.num_errors() == 0;
  if (is_usable) staged.Commit();
  if (json) {
    PrintJson({{"usable", problems.num_errors() == 0},
               {"problems", MakeJson(problems)},
               {"digits", imported.num_digits},
               {"joints", imported.num_joints},
               {"driven", imported.num_driven}});
  } else {
    PrintFindings(problems);
    PrintResult(options.file + ": " + (is_usable ? "imported" : "cannot be imported") +
                FormatFindingCounts(problems) + "\n");
    if (is_usable) {
      PrintResult(options.out + ": " + FormatCount(imported.num_digits, "digit") + ", " +
                  FormatCount(imported.num_joints, "joint") + ", " +
                  std::to_string(imported.num_driven) +
                  " driven; look at the lines with \"guess\" in hand.yaml\n");
    }
  }
  return problems.num_errors() == 0 ? kExitOk : kExitBadInput;
}

}  // namespace

void AddHandCommand(CLI::App& program, ExitCode& exit_code) {
  CLI::App& group = AddSubcommand(program, "hand", "Show and check hands.",
                                  "  graspbench hand list\n"
                                  "  graspbench hand check my_hand/");
  group.require_subcommand(1);
  const auto id = std::make_shared<std::string>();
  const auto joints = std::make_shared<std::vector<std::string>>();
  const auto json = std::make_shared<bool>(false);
  const auto add = [&](const char* name, const char* description, const char* examples) {
    CLI::App& command = AddSubcommand(group, name, description, examples);
    command.add_flag("--json", *json, "print one JSON object");
    return &command;
  };
  const auto add_hand = [&](CLI::App* command) {
    command->add_option("hand", *id, "id, or folder with hand.urdf and hand.yaml")
        ->required()
        ->option_text("HAND");
  };

  CLI::App* list = add("list", "List the hands that come with the program.",
                       "  graspbench hand list\n"
                       "  graspbench hand list --json");
  list->callback([json] {
    const DescribedHands hands = DescribeHands();
    *json ? PrintJson(hands.json) : PrintResult(hands.table);
  });

  CLI::App* show = add("show", "Show joints, limits, drives and grasps of a hand.",
                       "  graspbench hand show shadow\n"
                       "  graspbench hand show my_hand/ --json");
  add_hand(show);
  show->callback([id, json] {
    const Hand hand = LoadHand(*id);
    *json ? PrintJson(MakeHandJson(hand)) : PrintResult(FormatHand(hand));
  });

  CLI::App* check = add("check", "Read a hand and list every problem with file and line.",
                        "  graspbench hand check my_hand/\n"
                        "  graspbench hand check my_hand/ --json");
  add_hand(check);
  check->callback([id, json, &exit_code] { exit_code = CheckHandCommand(*id, *json); });

  const auto import = std::make_shared<HandImportOptions>();
  CLI::App* import_command =
      add("import", "Make a hand of a URDF from elsewhere; repairs and guesses are told.",
          "  graspbench hand import allegro_hand_right.urdf --out allegro\n"
          "  graspbench hand import urdf/svh.urdf --package-path ~/ros/src --out svh");
  import_command->add_option("file", import->file, "the description: a URDF file")
      ->required()
      ->option_text("FILE");
  import_command->add_option("--out", import->out, "folder for the hand; new or empty")
      ->required()
      ->option_text("DIR");
  import_command
      ->add_option("--package-path", import->package_path,
                   "folder with the packages that mesh addresses name; may be repeated")
      ->allow_extra_args(false)
      ->option_text("DIR");
  import_command->add_option("--palm", import->palm, "link of the palm, where it is not found")
      ->option_text("LINK");
  import_command->add_flag("--replace", import->replace, "replace an earlier, unchanged import");
  import_command->callback(
      [import, json, &exit_code] { exit_code = ImportHandCommand(*import, *json); });

  CLI::App* fk =
      add("fk", "Calculate forward kinematics: the last link of each digit in the palm's frame.",
          "  graspbench hand fk shadow --joints FFJ3=30,FFJ2=45\n"
          "  graspbench hand fk shadow --joints THJ5=20,THJ4=40 --json");
  add_hand(fk);
  fk->add_option("--joints", *joints,
                 "joint angles in degrees; others are zero, coupled ones follow")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->option_text("NAME=DEG,..");
  fk->callback([id, joints, json] { PrintForwardKinematics(*id, *joints, *json); });
}

}  // namespace graspbench
