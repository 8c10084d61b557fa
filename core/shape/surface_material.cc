#include "core/shape/surface_material.h"

#include <map>

#include "core/base/text/yaml.h"

namespace graspbench {

std::vector<FileKey> ListSurfaceKeys(Needed friction, const std::string& prefix) {
  static const std::map<std::string, const char*> meanings = {
      {"friction_static", "coefficient of friction with the other surface, sticking"},
      {"friction_dynamic", "the same, sliding; at most the static one"},
      {"contact_stiffness_n_per_m", "of one contact point; else as the session has it"},
      {"torsion_radius_m", "of a soft surface: resists turning on the spot"}};
  std::vector<FileKey> rows;
  SurfaceMaterial surface;
  surface.Visit([&](const std::string& key, double&, double least, double most) {
    const bool is_needed = friction == Needed::kYes && key.rfind("friction", 0) == 0;
    rows.push_back({prefix + key, is_needed ? kRequired : "", meanings.at(key),
                    is_needed ? kAboveZero : least, most});
  });
  return rows;
}

void ReadSurface(YamlMap& map, Needed friction, SurfaceMaterial& surface) {
  surface.Visit([&](const char* key, double& value, double, double) {
    const bool is_friction =
        &value == &surface.friction_static || &value == &surface.friction_dynamic;
    map.Read(key, value, is_friction ? friction : Needed::kNo);
  });
  if (friction == Needed::kNo && map.Has("friction_static") != map.Has("friction_dynamic")) {
    map.Fail("friction_static", "give friction_static and friction_dynamic, or neither");
  } else if (surface.friction_dynamic > surface.friction_static) {
    map.Fail("friction_dynamic", "is larger than friction_static; swap the two?");
  }
}

}  // namespace graspbench
