#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>

#include "core/base/units.h"
#include "objects/catalogue.h"
#include "objects/check_mesh_file.h"
#include "objects/load_mesh.h"
#include "reports/format.h"
#include "workbench/commands/command.h"
#include "workbench/text_table.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

Json MakeObjectJson(const GraspObject& object) {
  return {{"id", object.id},
          {"name", object.name},
          {"mass_kg", object.mass_properties.mass},
          {"size_m", JsonVector(object.size)},
          {"size_of_sight_m", JsonVector(object.size_of_sight)},
          {"centre_of_mass_m", JsonVector(object.mass_properties.p_OOcm)},
          {"friction_static", object.friction_static},
          {"friction_dynamic", object.friction_dynamic},
          {"best_grasp", object.best_grasp},
          {"triangles", object.mesh.num_triangles()}};
}

std::string FormatSize(const Eigen::Vector3d& size) {
  return FormatFixed(MmFromM(size.x()), 1) + " x " + FormatFixed(MmFromM(size.y()), 1) + " x " +
         FormatFixed(MmFromM(size.z()), 1);
}

std::string FormatBestGrasps(const GraspObject& object) {
  std::string text;
  for (const auto& [hand, grasp] : object.best_grasp) {
    text += (text.empty() ? "" : ", ") + hand + " " + grasp;
  }
  return text;
}

void ListObjectsCommand(bool json) {
  Json list = Json::array();
  TextTable table({"id", "mass [g]", "length x width x height [mm]", "mu_s", "mu_d", "best grasp"});
  for (const std::string& id : ListObjects()) {
    const auto object = LoadObject(id);
    list.push_back(MakeObjectJson(*object));
    table.AddRow({id, FormatFixed(GFromKg(object->mass_properties.mass), 1),
                  FormatSize(object->size), FormatFixed(object->friction_static, 2),
                  FormatFixed(object->friction_dynamic, 2), FormatBestGrasps(*object)});
  }
  if (json) {
    PrintJson({{"objects", list}});
  } else {
    std::cout << table.Format();
  }
}

void ShowObject(const std::string& id, bool json) {
  const auto object = LoadObject(id);
  if (json) {
    PrintJson(MakeObjectJson(*object));
    return;
  }
  const MassProperties& solid = object->mass_properties;
  std::cout << object->name << " (" << object->id << ")\n\nmass            "
            << FormatFixed(GFromKg(solid.mass), 1) << " g\nsize of grasp   "
            << FormatSize(object->size) << " mm\nsize of sight   "
            << FormatSize(object->size_of_sight) << " mm\ncentre of mass  ("
            << FormatFixed(MmFromM(solid.p_OOcm.x()), 1) << ", "
            << FormatFixed(MmFromM(solid.p_OOcm.y()), 1) << ", "
            << FormatFixed(MmFromM(solid.p_OOcm.z()), 1) << ") mm from the centre\nfriction        "
            << FormatFixed(object->friction_static, 2) << " static, "
            << FormatFixed(object->friction_dynamic, 2) << " dynamic\nbest grasp      "
            << FormatBestGrasps(*object) << "\nmesh            " << object->mesh.num_triangles()
            << " triangles\n";
}

void PrintMeshReport(const std::string& path, const MeshReport& report) {
  for (const std::string& warning : report.warnings) std::cout << "warning: " << warning << '\n';
  if (!report.problems.empty()) std::cout << FormatProblems(report) << '\n';
  std::cout << path << ": " << FormatCount(report.num_triangles, "triangle") << ", "
            << (report.is_closed ? "closed" : FormatCount(report.num_open_edges, "open edge"))
            << ", " << FormatSize(report.extent) << " mm; "
            << (report.problems.empty() ? "can be used\n" : "cannot be used\n");
}

void PrintRepair(const std::string& path, const MeshFileRepair& repair) {
  for (const std::string& action : repair.actions) std::cout << "repair: " << action << '\n';
  if (repair.is_written) {
    PrintMeshReport(path, repair.report);
  } else if (repair.actions.empty()) {
    std::cout << "repair: nothing could be repaired without guessing; no file written\n";
  } else {
    std::cout << FormatProblems(repair.report)
              << "\nrepair: the result could not be used either; no file written\n";
  }
}

struct MeshCheckOptions {
  std::string path;
  std::string unit;  // empty: inferred
  bool repair = false;
  bool json = false;
};

/** A folder is a whole object (object.yaml and mesh), anything else a mesh file. */
CheckedMeshFile CheckFileOrFolder(const MeshCheckOptions& options) {
  if (fs::is_directory(options.path)) {
    CheckedMeshFile file;
    file.mesh = LoadObject(options.path)->mesh;  // in metres, mended
    file.report = CheckMesh(file.mesh);
    return file;
  }
  std::optional<LengthUnit> unit;
  if (!options.unit.empty()) unit = options.unit == "mm" ? LengthUnit::kMm : LengthUnit::kM;
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
      std::cout << "unit: " << NameOf(file.unit)
                << ", inferred from the size; --unit says otherwise\n";
    }
    for (const std::string& action : file.actions) std::cout << "mended: " << action << '\n';
    PrintMeshReport(options.path, report);
    if (options.repair && report.problems.empty()) {
      std::cout << "repair: not needed; no file written\n";
    }
  }
  if (options.repair && !report.problems.empty()) {
    const fs::path path(options.path);
    const std::string repaired = (path.parent_path() / (path.stem().string() + "-repaired.obj"));
    const MeshFileRepair repair = RepairMeshFile(file, repaired);
    report = repair.report;
    json["repair"] = {{"file", repair.is_written ? Json(repaired) : Json(nullptr)},
                      {"actions", repair.actions},
                      {"result", FormatMeshReport(report)}};
    if (!options.json) PrintRepair(repaired, repair);
  }
  if (options.json) PrintJson(json);
  return report.problems.empty() ? kExitOk : kExitBadInput;
}

// With --json the answer is JSON also when the file cannot be read.
ExitCode CheckObject(const MeshCheckOptions& options) {
  if (!options.json) return ReportMesh(options);
  try {
    return ReportMesh(options);
  } catch (const Error& error) {
    PrintJson({{"usable", false}, {"problems", {error.what()}}});
    return ExitCodeOf(error.kind());
  }
}

}  // namespace

void AddObjectCommand(CLI::App& program, ExitCode& exit_code) {
  CLI::App& group = AddSubcommand(program, "object", "Shows and checks things to grasp.",
                                  "  graspbench object list\n"
                                  "  graspbench object check mug.stl --unit mm");
  group.require_subcommand(1);
  const auto id = std::make_shared<std::string>();
  const auto json = std::make_shared<bool>(false);

  CLI::App& list = AddSubcommand(group, "list", "Lists the catalogue's objects.",
                                 "  graspbench object list\n"
                                 "  graspbench object list --json");
  list.add_flag("--json", *json, "one JSON object");
  list.callback([json] { ListObjectsCommand(*json); });

  CLI::App& show = AddSubcommand(group, "show", "Shows sizes, mass and friction of an object.",
                                 "  graspbench object show can\n"
                                 "  graspbench object show my_object/ --json");
  show.add_option("object", *id, "id, or folder with object.yaml and a mesh")
      ->required()
      ->option_text("OBJECT");
  show.add_flag("--json", *json, "one JSON object");
  show.callback([id, json] { ShowObject(*id, *json); });

  CLI::App& check = AddSubcommand(group, "check", "Tells whether a mesh can be used, and why not.",
                                  "  graspbench object check mug.stl --unit mm\n"
                                  "  graspbench object check mug.stl --unit mm --repair");
  const auto options = std::make_shared<MeshCheckOptions>();
  check
      .add_option("path", options->path,
                  "mesh file (" + ListMeshFormats() + "), or folder with object.yaml and a mesh")
      ->required()
      ->option_text("PATH");
  check
      .add_option("--unit", options->unit,
                  "of the mesh file's numbers: m or mm (default: by the size)")
      ->check(CLI::IsMember({"m", "mm"}))
      ->option_text("UNIT");
  check.add_flag("--repair", options->repair,
                 "mend a mesh that cannot be used; writes NAME-repaired.obj if then it can");
  check.add_flag("--json", options->json, "one JSON object");
  check.callback([options, &exit_code] { exit_code = CheckObject(*options); });
}

}  // namespace graspbench
