#include "workbench/tables/object_tables.h"

#include "core/base/text/text.h"
#include "core/base/units.h"
#include "objects/catalogue.h"
#include "workbench/tables/text_table.h"

namespace graspbench {
namespace {

std::string FormatBestGrasps(const GraspObject& object) {
  std::string text;
  for (const auto& [hand, grasp] : object.best_grasp) {
    text += (text.empty() ? "" : ", ") + hand + " " + grasp;
  }
  return text;
}

}  // namespace

Json MakeObjectJson(const GraspObject& object) {
  return {{"id", object.id},
          {"name", object.name},
          {"mass_kg", object.mass_properties.mass},
          {"size_m", JsonVector(object.size)},
          {"size_of_sight_m", JsonVector(object.size_of_sight)},
          {"centre_of_mass_m", JsonVector(object.mass_properties.p_OOcm)},
          {"friction_static", object.surface.friction_static},
          {"friction_dynamic", object.surface.friction_dynamic},
          {"best_grasp", object.best_grasp},
          {"triangles", object.mesh.num_triangles()},
          {"turned_to_rest_deg", DegFromRad(object.turned_to_rest)}};
}

DescribedObjects DescribeObjects() {
  Json list = Json::array();
  TextTable table({"id", "mass [g]", "length x width x height [mm]", "mu_s", "mu_d", "best grasp"});
  for (const std::string& id : ListObjects()) {
    const auto object = LoadObject(id);
    list.push_back(MakeObjectJson(*object));
    table.AddRow({id, FormatFixed(GFromKg(object->mass_properties.mass), 1),
                  FormatSizeInMm(object->size, 1), FormatFixed(object->surface.friction_static, 2),
                  FormatFixed(object->surface.friction_dynamic, 2), FormatBestGrasps(*object)});
  }
  return {Json{{"objects", list}}, table.Format()};
}

namespace {

/** Nothing of an object that lies as it rests. */
std::string FormatRest(const GraspObject& object) {
  if (object.turned_to_rest == 0.0) return "";
  return "rest            turned by " + FormatFixed(DegFromRad(object.turned_to_rest), 2) +
         " deg from how its mesh lies; sizes are those at rest\n";
}

}  // namespace

std::string FormatObject(const GraspObject& object) {
  const MassProperties& solid = object.mass_properties;
  return object.name + " (" + object.id + ")\n\nmass            " +
         FormatFixed(GFromKg(solid.mass), 1) + " g\nsize of grasp   " +
         FormatSizeInMm(object.size, 1) + " mm\nsize of sight   " +
         FormatSizeInMm(object.size_of_sight, 1) + " mm\ncentre of mass  (" +
         FormatFixed(MmFromM(solid.p_OOcm.x()), 1) + ", " +
         FormatFixed(MmFromM(solid.p_OOcm.y()), 1) + ", " +
         FormatFixed(MmFromM(solid.p_OOcm.z()), 1) + ") mm from the centre\nfriction        " +
         FormatFixed(object.surface.friction_static, 2) + " static, " +
         FormatFixed(object.surface.friction_dynamic, 2) + " dynamic\nbest grasp      " +
         FormatBestGrasps(object) + "\nmesh            " +
         std::to_string(object.mesh.num_triangles()) + " triangles\n" + FormatRest(object);
}

std::string FormatMeshSummary(const std::string& path, const MeshReport& report) {
  std::string text;
  for (const std::string& warning : report.warnings) text += "warning: " + warning + "\n";
  if (!report.problems.empty()) text += FormatProblems(report) + "\n";
  return text + path + ": " + FormatCount(report.num_triangles, "triangle") + ", " +
         (report.is_closed ? "closed" : FormatCount(report.num_open_edges, "open edge")) + ", " +
         FormatSizeInMm(report.extent, 1) + " mm; " +
         (report.problems.empty() ? "can be used\n" : "cannot be used\n");
}

std::string FormatRepair(const std::string& path, const MeshFileRepair& repair) {
  std::string text;
  for (const std::string& action : repair.actions) text += "repair: " + action + "\n";
  if (repair.is_written) {
    text += FormatMeshSummary(path, repair.report);
  } else if (repair.actions.empty()) {
    text += "repair: nothing could be repaired without guessing; no file written\n";
  } else {
    text += FormatProblems(repair.report) +
            "\nrepair: the result could not be used either; no file written\n";
  }
  return text;
}

}  // namespace graspbench
