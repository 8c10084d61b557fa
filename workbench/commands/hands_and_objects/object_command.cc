#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "objects/catalogue.h"
#include "objects/check_mesh_file.h"
#include "objects/load_mesh.h"
#include "objects/object_file.h"
#include "workbench/command.h"
#include "workbench/experiments/output_folder.h"
#include "workbench/tables/hand_tables.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

const std::vector<std::string> kUnits = {NameOf(LengthUnit::kM), NameOf(LengthUnit::kMm)};

struct MeshCheckOptions {
  std::string path;
  std::string unit;  // empty: inferred
  bool repair = false;
  bool json = false;
};

/** A folder is a whole object (object.yaml and mesh), anything else a mesh file. */
CheckedMeshFile CheckFileOrFolder(const MeshCheckOptions& options) {
  if (fs::is_directory(options.path)) {
    LoadObject(options.path, FieldUse::kLater);  // its other faults
    const fs::path folder = options.path;
    const ObjectFile file = LoadObjectFile(folder / "object.yaml");
    return CheckMeshFile(folder / file.mesh, file.mesh_unit, PartsApartOf(file));
  }
  std::optional<LengthUnit> unit;
  if (!options.unit.empty())
    unit = options.unit == NameOf(LengthUnit::kMm) ? LengthUnit::kMm : LengthUnit::kM;
  return CheckMeshFile(options.path, unit);
}

ExitCode ReportMesh(const MeshCheckOptions& options) {
  const CheckedMeshFile file = CheckFileOrFolder(options);
  MeshReport report = file.report;
  Json json = FormatMeshReport(report);
  json["unit"] = NameOf(file.unit);
  json["unit_inferred"] = file.is_unit_inferred;
  json["mended"] = file.actions;
  if (!options.json) {
    if (file.is_unit_inferred) {
      PrintResult(std::string("unit: ") + NameOf(file.unit) +
                  ", inferred from the size; --unit overrides it\n");
    }
    std::string text;
    for (const std::string& action : file.actions) text += "mended: " + action + "\n";
    text += FormatMeshSummary(options.path, report);
    if (options.repair && report.problems.empty()) text += "repair: not needed; no file written\n";
    PrintResult(text);
  }
  if (options.repair && !report.problems.empty()) {
    const fs::path path(options.path);
    const std::string repaired = (path.parent_path() / (path.stem().string() + "-repaired.obj"));
    CheckOutputFile(repaired);
    const MeshFileRepair repair = RepairMeshFile(file, repaired);
    report = repair.report;
    json["repair"] = {{"file", repair.is_written ? Json(repaired) : Json(nullptr)},
                      {"actions", repair.actions},
                      {"result", FormatMeshReport(report)}};
    if (!options.json) PrintResult(FormatRepair(repaired, repair));
  }
  if (options.json) PrintJson(json);
  return report.problems.empty() ? kExitOk : kExitBadInput;
}

/** With --json the answer is JSON also when there is a fault. */
template <class Answer>
ExitCode AnswerInJson(bool json, const Answer& answer) {
  if (!json) return answer();
  try {
    return answer();
  } catch (const Error& error) {
    PrintJson({{"usable", false}, {"problems", {error.what()}}});
    return ExitCodeOf(error.kind());
  }
}

}  // namespace

void AddObjectCommand(Command& program) {
  Command& group = AddSubcommand(program, "object", "Show and check objects.",
                                 "  graspbench object list\n"
                                 "  graspbench object check mug.stl --unit mm");
  group.RequireSubcommand();
  const auto id = std::make_shared<std::string>();
  const auto json = std::make_shared<bool>(false);

  Command& list = AddSubcommand(group, "list", "List the catalogue's objects.",
                                "  graspbench object list\n"
                                "  graspbench object list --json");
  AddJsonOption(list, *json);
  list.SetAction([json] {
    const DescribedObjects objects = DescribeObjects();
    *json ? PrintJson(objects.json) : PrintResult(objects.table);
  });

  Command& show = AddSubcommand(group, "show", "Show sizes, mass and friction of an object.",
                                "  graspbench object show can\n"
                                "  graspbench object show my_object/ --json");
  show.AddRequired("object", *id, "id, or folder with object.yaml and a mesh", "OBJECT");
  AddJsonOption(show, *json);
  show.SetAction([id, json] {
    return AnswerInJson(*json, [&] {
      const auto object = LoadObject(*id);
      *json ? PrintJson(MakeObjectJson(*object)) : PrintResult(FormatObject(*object));
      return kExitOk;
    });
  });

  Command& check =
      AddSubcommand(group, "check", "Check whether a mesh is usable and report why not.",
                    "  graspbench object check mug.stl --unit mm\n"
                    "  graspbench object check mug.stl --unit mm --repair");
  const auto options = std::make_shared<MeshCheckOptions>();
  const std::string what =
      "mesh file (" + ListMeshFormats() + "), or folder with object.yaml and a mesh";
  check.AddRequired("path", options->path, what, "PATH");
  check
      .AddOption("--unit", options->unit, "length unit of the mesh file: " + ListNames(kUnits),
                 "UNIT")
      ->OneOf(kUnits)
      ->ShowDefault("by the size");
  check.AddFlag("--repair", options->repair,
                "repair an unusable mesh; write NAME-repaired.obj if the repair succeeds");
  AddJsonOption(check, options->json);
  check.SetAction(
      [options] { return AnswerInJson(options->json, [&] { return ReportMesh(*options); }); });
}

}  // namespace graspbench
