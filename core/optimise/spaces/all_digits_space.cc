#include "core/optimise/spaces/grasp_space.h"

namespace graspbench {

GraspSpaceRow AllDigitsSpaceRow() {
  return {"all-digits", "the target angles of all grasping digits",
          [](const GraspSpaceStart& start) {
            return MakeTargetSpace(start, FindGraspingJoints(start));
          }};
}

}  // namespace graspbench
