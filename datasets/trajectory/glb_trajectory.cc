#include "datasets/gltf/trial_gltf.h"
#include "datasets/trajectory/trajectory_form.h"

namespace graspbench {
namespace {

std::vector<TrajectoryFile> MakeGlbFiles(const TrialTrajectory& trajectory) {
  return {{".glb",
           MakeTrialGlb(*trajectory.hand, *trajectory.object, trajectory.traced, trajectory.rate)}};
}

}  // namespace

TrajectoryForm MakeGlbTrajectoryForm() {
  return {"glb", "an animated 3-D model for glTF 2.0 viewers", &MakeGlbFiles, nullptr};
}

}  // namespace graspbench
