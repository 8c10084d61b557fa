#include <memory>
#include <string>
#include <vector>

#include "core/base/files/files.h"
#include "core/base/text/text.h"
#include "core/hand/import/fenced_import.h"
#include "core/hand/import/write_hand.h"
#include "core/hand/load_hand.h"
#include "workbench/command.h"
#include "workbench/experiments/output_folder.h"
#include "workbench/tables/hand_tables.h"
#include "workbench/terminal/terminal.h"

namespace graspbench {
namespace {

struct HandImportOptions {
  std::string file, out, palm, unit, mesh_unit, angle;
  std::vector<double> palm_normal;
  std::vector<std::string> package_path;
  bool coarse_contact = false;
  bool replace = false;
};

/** [m]; 0: to be inferred. */
double ParseUnit(const std::string& name) {
  return name == "m"    ? 1.0
         : name == "dm" ? 0.1
         : name == "cm" ? 0.01
         : name == "mm" ? 0.001
         : name == "in" ? 0.0254
                        : 0.0;
}

ExitCode ImportHandCommand(const HandImportOptions& options, bool json) {
  namespace fs = std::filesystem;
  const fs::path file = options.file;
  StagedFolder staged({options.out, "hand", options.replace, {file}});
  HandSource source;
  source.file = options.file;
  source.folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  source.package_path.assign(options.package_path.begin(), options.package_path.end());
  source.unit = ParseUnit(options.unit);
  source.mesh_unit = ParseUnit(options.mesh_unit);
  if (!options.palm_normal.empty()) {
    source.palm_normal = Eigen::Vector3d(options.palm_normal.data());
    if (!source.palm_normal->allFinite() || source.palm_normal->norm() < 1e-6) {
      throw Error(ErrorKind::kUsage,
                  "--palm-normal has no direction; expected three finite numbers X,Y,Z, not all 0");
    }
  }
  source.accepts_coarse_contact = options.coarse_contact;
  if (!options.angle.empty()) source.in_degrees = options.angle == "deg";
  Diagnostics problems;
  const ImportedFiles imported = ImportHandFile(source, options.palm, problems);
  for (const auto& [name, content] : imported.files) {
    MakeFolder((staged.path() / name).parent_path());
    WriteFile(staged.path() / name, content);
  }
  if (problems.num_errors() == 0) {
    Diagnostics found;
    const std::string folder = staged.path().string();
    CheckHand(folder, found);
    for (const Diagnostic& entry : found.entries()) {  // by the folder that the user named
      const bool is_within = entry.file.rfind(folder, 0) == 0;
      const std::string at =
          is_within ? options.out + entry.file.substr(folder.size()) : entry.file;
      entry.severity == Severity::kError ? problems.Fail(at, entry.line, entry.text)
                                         : problems.Warn(at, entry.line, entry.text);
    }
  }
  const bool is_usable = problems.num_errors() == 0;
  if (is_usable) staged.Commit();
  if (json) {
    PrintJson({{"usable", is_usable},
               {"problems", MakeJson(problems)},
               {"digits", imported.num_digits},
               {"joints", imported.num_joints},
               {"driven", imported.num_driven},
               {"contact", MakeContactJson(imported.fits)}});
  } else {
    PrintFindings(problems);
    PrintResult(options.file + ": " + (is_usable ? "imported" : "cannot be imported") +
                FormatFindingCounts(problems) + "\n");
    if (is_usable) {
      PrintResult(options.out + ": " + FormatCount(imported.num_digits, "digit") + ", " +
                  FormatCount(imported.num_joints, "joint") + ", " +
                  std::to_string(imported.num_driven) +
                  " driven; review the lines marked \"guess\" in hand.yaml\n" +
                  FormatContact(imported.fits));
    }
  }
  return is_usable ? kExitOk : kExitBadInput;
}

}  // namespace

void AddHandImportCommand(Command& program) {
  const auto import = std::make_shared<HandImportOptions>();
  const auto json = std::make_shared<bool>(false);
  Command& command =
      AddSubcommand(program.Subcommand("hand"), "import",
                    "Import a hand from URDF or MJCF; report repairs, assumptions and contact fit.",
                    "  graspbench hand import allegro_hand_right.urdf --out allegro\n"
                    "  graspbench hand import urdf/svh.urdf --package-path ~/ros/src --out svh\n"
                    "  graspbench hand import shadow_hand/right_hand.xml --out shadow-mjcf");
  command.AddRequired("file", import->file, "description: URDF or MuJoCo model", "FILE");
  command.AddRequired("--out", import->out, "folder for the hand; new or empty", "DIR");
  command
      .AddOption("--package-path", import->package_path,
                 "folder of the packages named in mesh paths; may be repeated", "DIR")
      ->OneValueEach();
  const auto add_unit = [&](const char* name, std::string& unit, const char* description) {
    command.AddOption(name, unit, description, "m|dm|cm|mm|in")
        ->OneOf({"m", "dm", "cm", "mm", "in"});
  };
  add_unit("--unit", import->unit, "unit of lengths (default: inferred and reported)");
  add_unit("--mesh-unit", import->mesh_unit, "unit of mesh files (default: inferred and reported)");
  command
      .AddOption("--angle", import->angle, "unit of its joint limits (MJCF: of all angles)",
                 "deg|rad")
      ->OneOf({"deg", "rad"});
  command.AddOption("--palm", import->palm,
                    "palm link, if it is not found or if a scene has several hands", "LINK");
  command
      .AddOption("--palm-normal", import->palm_normal,
                 "direction out of the palm in the palm frame, if it is not found", "X,Y,Z")
      ->NumValues(3, 3)
      ->SplitAtCommas();
  command.AddFlag(
      "--coarse-contact", import->coarse_contact,
      "accept contact shapes that deviate by more than 5 mm on the palmar side or a tip");
  AddReplaceOption(command, import->replace);
  AddJsonOption(command, *json);
  command.SetAction([import, json] { return ImportHandCommand(*import, *json); });
}

}  // namespace graspbench
