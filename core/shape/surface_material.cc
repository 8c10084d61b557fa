#include "core/shape/surface_material.h"

#include "core/base/text/yaml.h"

namespace graspbench {

FileKeys ListSurfaceKeys(Needed friction, const std::string& prefix) {
  FileKeys rows;
  SurfaceMaterial surface;
  surface.Visit([&](const std::string& key, double&, const KeyInfo& info) {
    const bool is_needed = friction == Needed::kYes && key.rfind("friction", 0) == 0;
    rows.push_back({prefix + key, is_needed ? kRequired : "", info.meaning,
                    is_needed ? kAboveZero : info.low, info.high});
  });
  return rows;
}

void ReadSurface(YamlMap& map, Needed friction, SurfaceMaterial& surface) {
  surface.Visit([&](const char* key, double& value, const KeyInfo&) {
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
