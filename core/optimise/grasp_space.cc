#include "core/optimise/grasp_space.h"

#include <Eigen/SVD>
#include <algorithm>
#include <utility>

#include "core/base/enum_table.h"
#include "core/base/units.h"
#include "core/grasp/placement.h"
#include "core/hand/hand.h"

namespace graspbench {
namespace {

constexpr double kFirstStep = RadFromDeg(8.0);
constexpr double kLargestChange = RadFromDeg(25.0);  // of a coordinate, in either direction

/** Range of a target angle about the start's [rad]. */
struct TargetRange {
  double lower, upper;
};
TargetRange FindTargetRange(const GraspSpaceStart& start, int joint) {
  const HandJoint& limits = start.hand.joints[joint];
  const double angle = start.grasp.q_target[joint];
  return {std::max(limits.lower, angle - kLargestChange),
          std::min(limits.upper, angle + kLargestChange)};
}

/** Driven joints of the grasping digits, digit by digit as in the grasp. */
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

/** Space of these joints' target angles, one coordinate each. */
class TargetSpace : public GraspSpace {
 public:
  TargetSpace(const GraspSpaceStart& start, std::vector<int> joints)
      : start_(start), joints_(std::move(joints)) {
    for (const int joint : joints_) {
      const TargetRange range = FindTargetRange(start, joint);
      AddCoordinate({start.hand.joints[joint].name, "rad"}, range.lower,
                    start.grasp.q_target[joint], range.upper);
    }
  }

  Grasp MakeGrasp(const Eigen::VectorXd& genome) const override {
    Grasp grasp = start_.grasp;
    for (size_t i = 0; i < joints_.size(); ++i) {
      grasp.q_target[joints_[i]] = genome[i];
    }
    ApplyCoupling(start_.hand, grasp.q_target);
    return grasp;
  }

 private:
  GraspSpaceStart start_;
  std::vector<int> joints_;
};

constexpr double kShiftPerRadian = 0.04;  // [m/rad]: an angle moves a pad at 40 mm by this

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

constexpr size_t kFewestPostures = 4;
constexpr double kVarianceShare = 0.95;  // that the selected components explain
constexpr double kNoVariance = 1e-6;     // [rad], root of the sum of squares

/** Pre-grasps and targets of the hand's standard grasps in which all digits of the start grasp, one
row each. Other digits are not included. */
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

/** Principal components in columns, the most important first. The largest element of each is 1, so
that a coordinate is the angle of the joint that moves most. */
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
      const double by = change[i];
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
      if (genome[d] == box().start[d]) {
        continue;  // the start reproduces the grasp bit by bit
      }
      ClosingSchedule schedule = FindSchedule(grasp.digits[d]);
      schedule.delay = kDelayPerRadian * genome[d];
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

template <class Space>
std::unique_ptr<GraspSpace> Make(const GraspSpaceStart& start) {
  return std::make_unique<Space>(start);
}

constexpr GraspSpaceRow kSpaces[] = {
    {kThumbSpace, "the target angles of the thumb",
     [](const GraspSpaceStart& start) -> std::unique_ptr<GraspSpace> {
       const int opposing = FindOpposingDigit(start.hand, start.grasp);
       const Digit& digit = start.hand.digits[opposing];
       return std::make_unique<TargetSpace>(start, FindDrivenJoints(start.hand, digit));
     }},
    {"hand-pose", "the hand's pose to the object", Make<HandPoseSpace>},
    {"all-digits", "the target angles of all grasping digits",
     [](const GraspSpaceStart& start) -> std::unique_ptr<GraspSpace> {
       return std::make_unique<TargetSpace>(start, FindGraspingJoints(start));
     }},
    {"synergy", "the target angles of all grasping digits along the hand's synergies",
     Make<SynergySpace>},
    {"closing", "when each digit begins to close", Make<ClosingSpace>},
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
  static const std::vector<std::string> names = ListNames(kSpaces);
  return names;
}

const GraspSpaceRow& FindGraspSpace(const std::string& name) {
  if (const GraspSpaceRow* row = FindRow(kSpaces, name)) return *row;
  throw Error(ErrorKind::kNotFound,
              "no search space \"" + name + "\"" + SuggestNames(name, ListGraspSpaces()));
}

std::unique_ptr<GraspSpace> MakeGraspSpace(const std::string& name, const GraspSpaceStart& start) {
  return FindGraspSpace(name).make(start);
}

}  // namespace graspbench
