#include "core/optimise/spaces/grasp_space.h"

#include <algorithm>
#include <utility>

#include "core/base/error.h"
#include "core/hand/coupling.h"

namespace graspbench {
namespace {

constexpr double kFirstStep = RadFromDeg(8.0);

const std::vector<GraspSpaceRow>& ListSpaceRows() {
  static const std::vector<GraspSpaceRow> rows = {
#define GRASPBENCH_GRASP_SPACE(Class) Class##Row(),
#include "core/optimise/spaces/grasp_space_list.inc"
#undef GRASPBENCH_GRASP_SPACE
  };
  return rows;
}

class TargetSpace : public GraspSpace {
 public:
  TargetSpace(const GraspSpaceStart& start, std::vector<int> joints)
      : start_(start), joints_(std::move(joints)) {
    for (const int joint : joints_) {
      const TargetRange range = FindTargetRange(start, joint);
      AddCoordinate({start.hand.joints[static_cast<size_t>(joint)].name, "rad"}, range.lower,
                    start.grasp.q_target[joint], range.upper);
    }
  }

  Grasp MakeGrasp(const Eigen::VectorXd& genome) const override {
    Grasp grasp = start_.grasp;
    for (size_t i = 0; i < joints_.size(); ++i) {
      grasp.q_target[joints_[i]] = genome[static_cast<Eigen::Index>(i)];
    }
    ApplyCoupling(start_.hand, grasp.q_target);
    return grasp;
  }

 private:
  GraspSpaceStart start_;
  std::vector<int> joints_;
};

}  // namespace

void GraspSpace::AddCoordinate(const GraspCoordinate& coordinate, double lower, double start,
                               double upper) {
  coordinates_.push_back(coordinate);
  const auto size = static_cast<Eigen::Index>(coordinates_.size());
  for (auto [all, value] : {std::pair(&box_.lower, lower), std::pair(&box_.start, start),
                            std::pair(&box_.upper, upper)}) {
    all->conservativeResize(size);
    (*all)[size - 1] = value;
  }
  box_.step = kFirstStep;
}

const std::vector<std::string>& ListGraspSpaces() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const GraspSpaceRow& row : ListSpaceRows()) all.push_back(row.name);
    return all;
  }();
  return names;
}

const GraspSpaceRow& FindGraspSpace(const std::string& name) {
  for (const GraspSpaceRow& row : ListSpaceRows()) {
    if (name == row.name) return row;
  }
  throw Error(ErrorKind::kNotFound,
              "no search space \"" + name + "\"" + SuggestNames(name, ListGraspSpaces()));
}

std::unique_ptr<GraspSpace> MakeGraspSpace(const std::string& name, const GraspSpaceStart& start) {
  return FindGraspSpace(name).make(start);
}

TargetRange FindTargetRange(const GraspSpaceStart& start, int joint) {
  const HandJoint& limits = start.hand.joints[static_cast<size_t>(joint)];
  const double angle = start.grasp.q_target[joint];
  return {std::max(limits.lower, angle - kLargestChange),
          std::min(limits.upper, angle + kLargestChange)};
}

std::vector<int> FindGraspingJoints(const GraspSpaceStart& start) {
  std::vector<int> joints;
  for (const std::string& id : start.grasp.digits) {
    for (const Digit& digit : start.hand.digits) {
      if (digit.id != id) continue;
      const std::vector<int> of_digit = FindDrivenJoints(start.hand, digit);
      joints.insert(joints.end(), of_digit.begin(), of_digit.end());
    }
  }
  return joints;
}

std::unique_ptr<GraspSpace> MakeTargetSpace(const GraspSpaceStart& start, std::vector<int> joints) {
  return std::make_unique<TargetSpace>(start, std::move(joints));
}

}  // namespace graspbench
