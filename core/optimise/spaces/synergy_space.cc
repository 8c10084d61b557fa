#include <Eigen/SVD>
#include <algorithm>

#include "core/base/error.h"
#include "core/hand/coupling.h"
#include "core/optimise/spaces/grasp_space.h"

namespace graspbench {
namespace {

constexpr size_t kFewestPostures = 4;
constexpr double kVarianceShare = 0.95;  // that the components explain together
constexpr double kNoVariance = 1e-6;     // [rad], root of the sum of squares

/** Pre-grasps and targets of the hand's standard grasps in which all digits of the start grasp, a
row each; what else the other digits do is no part of them. */
Eigen::MatrixXd ListPostures(const GraspSpaceStart& start, const std::vector<int>& joints) {
  std::vector<Eigen::VectorXd> postures;
  for (const Grasp& grasp : LoadStandardGrasps(start.hand)) {
    const bool grasp_all = std::all_of(
        start.grasp.digits.begin(), start.grasp.digits.end(), [&](const std::string& digit) {
          return std::count(grasp.digits.begin(), grasp.digits.end(), digit) > 0;
        });
    if (grasp_all) postures.insert(postures.end(), {grasp.q_pre, grasp.q_target});
  }
  if (postures.size() < kFewestPostures) {
    throw Error(ErrorKind::kUnsupported,
                "the synergies of \"" + start.hand.id + "\" need " +
                    std::to_string(kFewestPostures) +
                    " postures of its standard grasps in which the same digits grasp, it has " +
                    std::to_string(postures.size()) +
                    "; search another space, or develop more grasps (graspbench hand develop)");
  }
  Eigen::MatrixXd rows(postures.size(), joints.size());
  for (size_t r = 0; r < postures.size(); ++r) {
    for (size_t c = 0; c < joints.size(); ++c) {
      rows(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c)) = postures[r][joints[c]];
    }
  }
  return rows;
}

/** Principal components in columns, the most important first; the largest element of each is 1, so
that a coordinate tells the angle of the joint that moves most. */
Eigen::MatrixXd CalcSynergies(const GraspSpaceStart& start, const std::vector<int>& joints) {
  const Eigen::MatrixXd postures = ListPostures(start, joints);
  const Eigen::MatrixXd centred = postures.rowwise() - postures.colwise().mean();
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(centred, Eigen::ComputeThinV);
  const Eigen::VectorXd variances = svd.singularValues().array().square();
  if (svd.singularValues()[0] < kNoVariance) {
    throw Error(ErrorKind::kUnsupported, "the standard grasps of \"" + start.hand.id +
                                             "\" have all the same posture, so there are no "
                                             "synergies; search another space");
  }
  Eigen::Index count = 1;
  while (variances.head(count).sum() < kVarianceShare * variances.sum()) ++count;
  Eigen::MatrixXd synergies = svd.matrixV().leftCols(count);
  for (Eigen::Index k = 0; k < count; ++k) {
    Eigen::Index largest = 0;
    synergies.col(k).cwiseAbs().maxCoeff(&largest);
    synergies.col(k) /= synergies(largest, k);
  }
  return synergies;
}

class SynergySpace : public GraspSpace {
 public:
  explicit SynergySpace(const GraspSpaceStart& start)
      : start_(start),
        joints_(FindGraspingJoints(start)),
        synergies_(CalcSynergies(start, joints_)) {
    for (Eigen::Index k = 0; k < synergies_.cols(); ++k) {
      AddCoordinate({"synergy_" + std::to_string(k + 1), "rad"}, -kLargestChange, 0.0,
                    kLargestChange);
    }
  }

  Grasp MakeGrasp(const Eigen::VectorXd& genome) const override {
    Grasp grasp = start_.grasp;
    const Eigen::VectorXd change = synergies_ * genome;
    for (size_t i = 0; i < joints_.size(); ++i) {
      const TargetRange range = FindTargetRange(start_, joints_[i]);
      const double by = change[static_cast<Eigen::Index>(i)];
      double& angle = grasp.q_target[joints_[i]];
      if (by != 0.0) angle = std::clamp(angle + by, range.lower, range.upper);
    }
    ApplyCoupling(start_.hand, grasp.q_target);
    return grasp;
  }

 private:
  GraspSpaceStart start_;
  std::vector<int> joints_;
  Eigen::MatrixXd synergies_;
};

}  // namespace

GraspSpaceRow SynergySpaceRow() {
  return {"synergy", "the target angles of all grasping digits along the hand's synergies",
          [](const GraspSpaceStart& start) -> std::unique_ptr<GraspSpace> {
            return std::make_unique<SynergySpace>(start);
          }};
}

}  // namespace graspbench
