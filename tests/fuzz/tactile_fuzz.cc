// Any bytes as tactile.yaml of the Shadow Hand: problems, or a skin whose every point has an
// element and which shares a force out whole.

#include <cmath>
#include <numeric>
#include <string>

#include "core/hand/load_hand.h"
#include "core/hand/tactile.h"
#include "core/trial/touch_sensors.h"
#include "tests/fuzz/fuzz_target.h"

namespace graspbench {

void FuzzInput(const std::string& bytes) {
  static const Hand hand = LoadHand("shadow");
  Diagnostics problems;
  const TactileSkin skin = ParseTactile(bytes, "tactile.yaml", hand, problems);
  if (problems.num_errors() > 0) return;
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
}

}  // namespace graspbench
