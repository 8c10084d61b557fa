#include "core/shape/surface_material.h"

#include <cmath>
#include <cstdio>

#include "core/base/yaml.h"

namespace graspbench {

void ReadSurface(YamlMap& map, Needed friction, SurfaceMaterial& surface) {
  surface.Visit([&](const char* key, double& value, double least, double most) {
    const bool is_friction =
        &value == &surface.friction_static || &value == &surface.friction_dynamic;
    map.Read(key, value, is_friction ? friction : Needed::kNo);
    if (!(value < least) && !(value > most)) return;
    char text[80];
    std::snprintf(text, sizeof text, "expected %g to %g, found %g", least, most, value);
    map.Fail(key, text);
  });
  if (friction == Needed::kNo && map.Has("friction_static") != map.Has("friction_dynamic")) {
    map.Fail("friction_static", "give friction_static and friction_dynamic, or neither");
  } else if (surface.friction_dynamic > surface.friction_static) {
    map.Fail("friction_dynamic", "is larger than friction_static; swap the two?");
  }
}

}  // namespace graspbench
