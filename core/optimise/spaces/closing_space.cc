#include <algorithm>

#include "core/optimise/spaces/grasp_space.h"

namespace graspbench {
namespace {

constexpr double kDelayPerRadian = 0.5;  // [s/rad]: 25 deg are 0.22 s, a fifth of a closure

class ClosingSpace : public GraspSpace {
 public:
  explicit ClosingSpace(const GraspSpaceStart& start) : start_(start) {
    for (const std::string& digit : start.grasp.digits) {
      const double delay = FindSchedule(digit).delay / kDelayPerRadian;
      AddCoordinate({"closing_" + digit, "s", kDelayPerRadian}, 0.0, delay,
                    std::max(delay, kLargestChange));
    }
  }

  Grasp MakeGrasp(const Eigen::VectorXd& genome) const override {
    Grasp grasp = start_.grasp;
    for (size_t d = 0; d < grasp.digits.size(); ++d) {
      if (genome[static_cast<Eigen::Index>(d)] == box().start[static_cast<Eigen::Index>(d)]) {
        continue;  // the start is the grasp to the bit
      }
      ClosingSchedule schedule = FindSchedule(grasp.digits[d]);
      schedule.delay = kDelayPerRadian * genome[static_cast<Eigen::Index>(d)];
      grasp.closing[grasp.digits[d]] = schedule;
    }
    return grasp;
  }

 private:
  ClosingSchedule FindSchedule(const std::string& digit) const {
    const auto own = start_.grasp.closing.find(digit);
    return own == start_.grasp.closing.end() ? ClosingSchedule() : own->second;
  }

  GraspSpaceStart start_;
};

}  // namespace

GraspSpaceRow ClosingSpaceRow() {
  return {"closing", "when each digit begins to close",
          [](const GraspSpaceStart& start) -> std::unique_ptr<GraspSpace> {
            return std::make_unique<ClosingSpace>(start);
          }};
}

}  // namespace graspbench
