#include "core/optimise/spaces/grasp_space.h"

namespace graspbench {

GraspSpaceRow ThumbSpaceRow() {
  return {kThumbSpace, "the target angles of the thumb", [](const GraspSpaceStart& start) {
            const int opposing = FindOpposingDigit(start.hand, start.grasp);
            const Digit& digit = start.hand.digits[static_cast<size_t>(opposing)];
            return MakeTargetSpace(start, FindDrivenJoints(start.hand, digit));
          }};
}

}  // namespace graspbench
