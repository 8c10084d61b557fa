#include "core/grasp/placement.h"
#include "core/optimise/spaces/grasp_space.h"

namespace graspbench {
namespace {

constexpr double kShiftPerRadian = 0.04;  // [m/rad]: what an angle moves a pad 40 mm away

class HandPoseSpace : public GraspSpace {
 public:
  explicit HandPoseSpace(const GraspSpaceStart& start) : start_(start) {
    for (const char* axis : {"x", "y", "z"}) {
      Add({std::string("hand_") + axis, "m", kShiftPerRadian});
    }
    for (const char* axis : {"x", "y", "z"}) Add({std::string("hand_turn_") + axis, "rad"});
  }

  Grasp MakeGrasp(const Eigen::VectorXd& genome) const override {
    Grasp grasp = start_.grasp;
    grasp.placement = MovePlacement(start_.hand, grasp, start_.object,
                                    kShiftPerRadian * genome.head<3>(), genome.tail<3>());
    return grasp;
  }

 private:
  void Add(const GraspCoordinate& coordinate) {
    AddCoordinate(coordinate, -kLargestChange, 0.0, kLargestChange);
  }

  GraspSpaceStart start_;
};

}  // namespace

GraspSpaceRow HandPoseSpaceRow() {
  return {"hand-pose", "the hand's pose to the object",
          [](const GraspSpaceStart& start) -> std::unique_ptr<GraspSpace> {
            return std::make_unique<HandPoseSpace>(start);
          }};
}

}  // namespace graspbench
