#include "core/hand/import/close_loops.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>

#include "core/base/text/text.h"
#include "core/base/units.h"
#include "core/hand/import/foreign_hand.h"

namespace graspbench {
namespace {

using Eigen::VectorXd;

constexpr int kCourseSamples = 33;     // of the drive's range
constexpr double kClosure = 1e4;       // weight of a point's distance [1/m]
constexpr double kSpring = 1.0;        // weight of the stiffest spring's angle [1/rad]
constexpr double kStay = 0.01;         // weight of the motion of a joint without spring [1/rad]
constexpr double kLargestGap = 0.001;  // gap of a loop that counts as closed [m]
constexpr double kStill = 0.01;        // ratio below which a joint does not move with the drive

int LeaderOf(const ForeignHand& hand, int joint) {
  const auto& mimic = hand.joints[static_cast<size_t>(joint)].mimic;
  return mimic ? mimic->joint : joint;
}

/** Moving joints from a link up to the root. */
std::vector<int> JointsAbove(const ForeignHand& hand, int link) {
  std::vector<int> above;
  for (size_t j = hand.joints.size(); j-- > 0;) {  // children follow their parents
    if (hand.joints[j].child != link) continue;
    if (hand.joints[j].kind != ForeignJoint::Kind::kFixed) above.push_back(static_cast<int>(j));
    link = hand.joints[j].parent;
  }
  return above;
}

/** Poses of all links in the root, for positions of joints that follow no other. */
std::vector<Pose> CalcPoses(const ForeignHand& hand, const std::map<int, double>& q) {
  std::vector<Pose> X_RL(hand.links.size(), Pose::Identity());
  for (size_t j = 0; j < hand.joints.size(); ++j) {
    const ForeignJoint& joint = hand.joints[j];
    const auto own = q.find(LeaderOf(hand, static_cast<int>(j)));
    double position = own == q.end() ? 0.0 : own->second;
    if (joint.mimic) position = joint.mimic->offset + joint.mimic->ratio * position;
    Pose& X = X_RL[static_cast<size_t>(joint.child)];
    X = X_RL[static_cast<size_t>(joint.parent)] * joint.X_PJ;
    if (joint.kind == ForeignJoint::Kind::kPrismatic) X.translate(position * joint.axis);
    if (joint.kind == ForeignJoint::Kind::kRevolute) {
      X.rotate(Eigen::AngleAxisd(position, joint.axis));
    }
  }
  return X_RL;
}

/** The loops of one drive. */
class Linkage {
 public:
  Linkage(const ForeignHand& hand, int drive, std::vector<int> passive,
          const std::vector<LoopPoint>& points)
      : hand_(hand), drive_(drive), passive_(std::move(passive)), points_(points) {
    const std::vector<Pose> X_RL = CalcPoses(hand, {});
    for (const LoopPoint& point : points) {
      p_BP_.push_back(X_RL[static_cast<size_t>(point.link_B)].inverse() *
                      (X_RL[static_cast<size_t>(point.link_A)] * point.p_AP));
    }
    for (const int j : passive_) {
      stiffest_ = std::max(stiffest_, hand.joints[static_cast<size_t>(j)].spring_stiffness);
    }
  }

  /** Solves for the passive joints, with the drive at `q_drive`, from a nearby solution. */
  VectorXd Solve(double q_drive, const VectorXd& start) const;
  double CalcLargestGap(double q_drive, const VectorXd& q) const {
    return CalcResiduals(q_drive, q, q).head(3 * num_points()).cwiseAbs().maxCoeff() / kClosure;
  }
  const ForeignJoint& passive(Eigen::Index i) const {
    return hand_.joints[static_cast<size_t>(passive_[static_cast<size_t>(i)])];
  }

 private:
  Eigen::Index num_points() const { return static_cast<Eigen::Index>(points_.size()); }
  VectorXd CalcResiduals(double q_drive, const VectorXd& q, const VectorXd& start) const;

  const ForeignHand& hand_;
  int drive_;
  std::vector<int> passive_;
  const std::vector<LoopPoint>& points_;
  std::vector<Eigen::Vector3d> p_BP_;
  double stiffest_ = 0.0;
};

VectorXd Linkage::CalcResiduals(double q_drive, const VectorXd& q, const VectorXd& start) const {
  std::map<int, double> positions = {{drive_, q_drive}};
  for (Eigen::Index i = 0; i < q.size(); ++i) positions[passive_[static_cast<size_t>(i)]] = q[i];
  const std::vector<Pose> X_RL = CalcPoses(hand_, positions);
  VectorXd residuals(3 * num_points() + q.size());
  for (Eigen::Index k = 0; k < num_points(); ++k) {
    const LoopPoint& point = points_[static_cast<size_t>(k)];
    residuals.segment<3>(3 * k) =
        kClosure * (X_RL[static_cast<size_t>(point.link_A)] * point.p_AP -
                    X_RL[static_cast<size_t>(point.link_B)] * p_BP_[static_cast<size_t>(k)]);
  }
  for (Eigen::Index i = 0; i < q.size(); ++i) {
    const double stiffness = passive(i).spring_stiffness;
    residuals[3 * num_points() + i] = stiffness > 0.0 ? kSpring * std::sqrt(stiffness / stiffest_) *
                                                            (q[i] - passive(i).spring_rest)
                                                      : kStay * (q[i] - start[i]);
  }
  return residuals;
}

VectorXd Linkage::Solve(double q_drive, const VectorXd& start) const {
  constexpr int kMostSteps = 300;
  constexpr double kDifference = 1e-6, kSmallStep = 1e-9;
  VectorXd q = start;
  double damping = 1e-6;
  for (int step = 0; step < kMostSteps; ++step) {
    const VectorXd r = CalcResiduals(q_drive, q, start);
    Eigen::MatrixXd J(r.size(), q.size());
    for (Eigen::Index i = 0; i < q.size(); ++i) {
      VectorXd moved = q;
      moved[i] += kDifference;
      J.col(i) = (CalcResiduals(q_drive, moved, start) - r) / kDifference;
    }
    const VectorXd downhill = -J.transpose() * r;
    for (Eigen::Index i = 0; i < q.size(); ++i) {  // joints that would leave their limits stay
      const bool at_upper = q[i] >= passive(i).upper && downhill[i] > 0.0;
      const bool at_lower = q[i] <= passive(i).lower && downhill[i] < 0.0;
      if (at_upper || at_lower) J.col(i).setZero();
    }
    Eigen::MatrixXd stacked(r.size() + q.size(), q.size());
    stacked << J, std::sqrt(damping) * Eigen::MatrixXd::Identity(q.size(), q.size());
    VectorXd wanted = VectorXd::Zero(stacked.rows());
    wanted.head(r.size()) = -r;
    VectorXd next = q + stacked.colPivHouseholderQr().solve(wanted);
    for (Eigen::Index i = 0; i < q.size(); ++i) {
      next[i] = std::clamp(next[i], passive(i).lower, passive(i).upper);
    }
    if (CalcResiduals(q_drive, next, start).squaredNorm() >= r.squaredNorm()) {
      damping *= 10.0;
      if (damping > 1e12) break;
      continue;
    }
    const double moved = (next - q).norm();
    q = next;
    damping = std::max(0.1 * damping, 1e-12);
    if (moved < kSmallStep) break;
  }
  return q;
}

struct Course {
  VectorXd q_drive;   // (kCourseSamples)
  Eigen::MatrixXd q;  // (kCourseSamples x passive)
  double gap = 0.0;   // largest [m]
};

Course FollowDrive(const Linkage& linkage, const ForeignJoint& drive, Eigen::Index num_passive) {
  Course course;
  course.q_drive = VectorXd::LinSpaced(kCourseSamples, drive.lower, drive.upper);
  course.q.resize(kCourseSamples, num_passive);
  Eigen::Index nearest = 0;  // position nearest to zero, where the loops are closed
  course.q_drive.cwiseAbs().minCoeff(&nearest);
  for (const int direction : {1, -1}) {
    VectorXd q = VectorXd::Zero(num_passive);
    for (Eigen::Index k = nearest; k >= 0 && k < kCourseSamples; k += direction) {
      q = linkage.Solve(course.q_drive[k], q);
      course.q.row(k) = q;
      course.gap = std::max(course.gap, linkage.CalcLargestGap(course.q_drive[k], q));
    }
  }
  return course;
}

/** Couples the passive joints to the drive by their best-fitting lines. */
void Tie(const Course& course, int drive, const std::vector<int>& passive, int line,
         const std::string& file, Diagnostics& problems, ForeignHand& hand) {
  Eigen::MatrixX2d basis(kCourseSamples, 2);
  basis << VectorXd::Ones(kCourseSamples), course.q_drive;
  for (size_t i = 0; i < passive.size(); ++i) {
    const VectorXd q = course.q.col(static_cast<Eigen::Index>(i));
    const Eigen::Vector2d fit = basis.colPivHouseholderQr().solve(q);
    const bool is_still = std::abs(fit[1]) < kStill;
    const double error = is_still ? (q.array() - q.mean()).abs().maxCoeff()
                                  : (basis * fit - q).cwiseAbs().maxCoeff();
    const ForeignJoint& joint = hand.joints[static_cast<size_t>(passive[i])];
    const bool slides = joint.kind == ForeignJoint::Kind::kPrismatic;
    problems.Warn(file, line,
                  "a loop of links is cut; its joint \"" + joint.name + "\" " +
                      (is_still ? "is fixed"
                                : "follows \"" + hand.joints[static_cast<size_t>(drive)].name +
                                      "\" " + FormatSignificant(fit[1], 3) + " times") +
                      ", as the loop has it with nothing touching, off by " +
                      (slides ? FormatFixed(MmFromM(error), 2) + " mm"
                              : FormatFixed(DegFromRad(error), 1) + " deg") +
                      " at most");
    if (is_still) {
      FixJoint(hand, passive[i], q.mean());
    } else {
      FollowJoint(hand, passive[i], drive, fit[1], fit[0]);
    }
  }
}

}  // namespace

void FollowJoint(ForeignHand& hand, int joint, int leader, double ratio, double offset) {
  for (ForeignJoint& follower : hand.joints) {
    if (!follower.mimic || follower.mimic->joint != joint) continue;
    follower.mimic->joint = leader;
    follower.mimic->offset += follower.mimic->ratio * offset;
    follower.mimic->ratio *= ratio;
  }
  ForeignMimic mimic;
  mimic.joint = leader;
  mimic.ratio = ratio;
  mimic.offset = offset;
  hand.joints[static_cast<size_t>(joint)].mimic = mimic;
}

void CloseLoops(const std::vector<LoopPoint>& points, const std::set<int>& driven,
                const std::string& file, Diagnostics& problems, ForeignHand& hand) {
  struct Group {
    std::vector<LoopPoint> points;
    std::set<int> passive;
  };
  std::map<int, Group> groups;  // by drive
  const auto cut = [&](const LoopPoint& point, const std::string& why) {
    problems.Warn(file, point.line,
                  "a loop of links is cut: " + why +
                      "; joints that nothing else ties get drives of their own");
  };
  for (const LoopPoint& point : points) {
    std::set<int> drives, passive;
    for (const int link : {point.link_A, point.link_B}) {
      for (const int j : JointsAbove(hand, link)) {
        const int leader = LeaderOf(hand, j);
        (driven.count(leader) != 0 ? drives : passive).insert(leader);
      }
    }
    if (drives.size() != 1 || passive.empty()) {
      cut(point, drives.size() == 1 ? "it has no joint without a drive" : "not one drive moves it");
      continue;
    }
    Group& group = groups[*drives.begin()];
    group.points.push_back(point);
    group.passive.insert(passive.begin(), passive.end());
  }
  for (const auto& [drive, group] : groups) {
    const std::vector<int> passive(group.passive.begin(), group.passive.end());
    const Linkage linkage(hand, drive, passive, group.points);
    const Course course = FollowDrive(linkage, hand.joints[static_cast<size_t>(drive)],
                                      static_cast<Eigen::Index>(passive.size()));
    if (course.gap > kLargestGap) {
      for (const LoopPoint& point : group.points) {
        cut(point, "within its limits it stays open by up to " +
                       FormatFixed(MmFromM(course.gap), 1) + " mm");
      }
    } else {
      Tie(course, drive, passive, group.points.front().line, file, problems, hand);
    }
  }
}

}  // namespace graspbench
