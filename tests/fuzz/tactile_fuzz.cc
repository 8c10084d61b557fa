// Any bytes as tactile.yaml of the Shadow Hand: problems, or a skin whose every point has an
// element and which shares a force out whole.

#include <cmath>
#include <cstdint>
#include <numeric>
#include <string>

#include "core/base/error.h"
#include "core/hand/load_hand.h"
#include "core/hand/tactile_yaml.h"
#include "core/trial/touch_sensors.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size);

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace graspbench;
  static const Hand hand = LoadHand("shadow");
  Diagnostics problems;
  const TactileSkin skin = ParseTactile(std::string(reinterpret_cast<const char*>(data), size),
                                        "tactile.yaml", hand, problems);
  if (problems.num_errors() > 0) return 0;
  for (const SensedSurface& surface : skin.surfaces) {
    for (const SurfacePoint& point : surface.points) {
      GRASPBENCH_DEMAND(point.element >= 0, "a point without an element");
    }
    std::vector<double> forces(skin.elements.size(), 0.0);
    SpreadForce(surface, surface.points.front().p_L, 2.0, 0.004, forces);
    const double sum = std::accumulate(forces.begin(), forces.end(), 0.0);
    GRASPBENCH_DEMAND(std::abs(sum - 2.0) < 1e-9, std::to_string(sum));
  }
  for (const TactileElement& element : skin.elements) {
    GRASPBENCH_DEMAND(std::abs(element.normal_L.norm() - 1.0) < 1e-9, "a normal is not unit");
  }
  return 0;
}
