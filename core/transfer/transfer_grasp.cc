#include "core/transfer/transfer_grasp.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/error.h"
#include "core/base/text/text.h"
#include "core/base/units.h"
#include "core/develop/hand_pads.h"
#include "core/develop/propose_grasps.h"
#include "core/grasp/placement.h"
#include "core/grasp/predict_grasp.h"
#include "core/transfer/place_pads.h"

namespace graspbench {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double kMostDepth = 0.003;   ///< of links other than fingertips, at contact [m]
constexpr double kOpenRoom = 0.011;    ///< clearance from the object at its nominal pose [m]
constexpr double kOpenLength = 0.004;  ///< tolerated deviation of an open pad [m]
/** Draws move the object by kPlacementOffset in x and y. With less clearance an open digit would
meet it at its nominal pose. Fingertips may brush it in other draws, as in placement.h. */
constexpr double kBrush = 1.4142 * kPlacementOffset;
constexpr double kGripMargin = 2.0;  ///< multiple of the smallest forces that bear the weight
constexpr double kLeastGrip = 2.0;   ///< force of the opposing digit [N]
constexpr double kGravity = 9.81;    ///< [m/s^2]
constexpr int kNumShares = 100;

bool Grasps(const Grasp& grasp, const std::string& digit) {
  return std::count(grasp.digits.begin(), grasp.digits.end(), digit) > 0;
}

/** Returns the standard grasp of these digits, otherwise the first that shares most digits with
them. */
const Grasp& FindStandard(const Hand& hand, const std::vector<Grasp>& standard,
                          const std::vector<PadGoal>& goals) {
  const Grasp* best = &standard.front();
  int most = std::numeric_limits<int>::min();
  for (const Grasp& grasp : standard) {
    int same = 0;
    for (const Digit& digit : hand.digits) {
      const bool is_goal = std::any_of(goals.begin(), goals.end(), [&](const PadGoal& goal) {
        return hand.digits[static_cast<size_t>(goal.digit)].id == digit.id;
      });
      same += is_goal == Grasps(grasp, digit.id) ? 1 : -1;
    }
    if (same <= most) continue;
    most = same;
    best = &grasp;
  }
  return *best;
}

/** Distance of the first pad from the mean of the others. */
double CalcWidth(const std::vector<Vector3d>& pads) {
  Vector3d mean = Vector3d::Zero();
  for (size_t k = 1; k < pads.size(); ++k) mean += pads[k] / static_cast<double>(pads.size() - 1);
  return (mean - pads[0]).norm();
}

std::vector<Vector3d> ListPads(const Hand& hand, const std::vector<PadGoal>& goals,
                               const VectorXd& q) {
  const std::vector<Pose> X_HL = CalcLinkPoses(hand, q);
  std::vector<Vector3d> pads;
  for (const PadGoal& goal : goals) {
    const Digit& digit = hand.digits[static_cast<size_t>(goal.digit)];
    pads.push_back(X_HL[static_cast<size_t>(digit.distal_link)] * digit.p_LPad);
  }
  return pads;
}

/** Closes the standard grasp until its pads are as far apart as the goals. Digits without a goal
stay open. */
VectorXd CloseStandard(const Hand& hand, const Grasp& grasp, const std::vector<PadGoal>& goals) {
  std::vector<Vector3d> places;
  std::vector<std::string> names;
  for (const PadGoal& goal : goals) {
    places.push_back(goal.p_O);
    names.push_back(hand.digits[static_cast<size_t>(goal.digit)].id);
  }
  const double width = CalcWidth(places);
  VectorXd best = grasp.q_pre;
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k <= kNumShares; ++k) {
    const VectorXd q = CalcClosingPosture(hand, grasp, static_cast<double>(k) / kNumShares);
    const double miss = std::abs(CalcWidth(ListPads(hand, goals, q)) - width);
    if (miss >= least) continue;
    least = miss;
    best = q;
  }
  VectorXd q = grasp.q_pre;
  for (const int joint : FindGraspJoints(hand, names)) q[joint] = best[joint];
  ApplyCoupling(hand, q);
  return q;
}

/** The closing parameter at which the pads are nearest to their goals. */
double FindClosingAtContact(const Hand& hand, const std::vector<PadGoal>& goals, const Grasp& grasp,
                            const Pose& X_OH) {
  double best = 1.0, least = std::numeric_limits<double>::infinity();
  for (int k = 0; k <= kNumShares; ++k) {
    const double s = static_cast<double>(k) / kNumShares;
    const std::vector<Vector3d> pads = ListPads(hand, goals, CalcClosingPosture(hand, grasp, s));
    double sum = 0.0;
    for (size_t g = 0; g < goals.size(); ++g) sum += (X_OH * pads[g] - goals[g].p_O).squaredNorm();
    if (sum >= least) continue;
    least = sum;
    best = s;
  }
  return best;
}

/** Performs one transfer, step by step. */
class Transfer {
 public:
  Transfer(const Hand& hand, const std::vector<Grasp>& standard, const PersonGrasp& person,
           const GraspObject& object)
      : hand_(hand),
        standards_(standard),
        person_(person),
        object_(object),
        placer_(hand, object) {}

  TransferredGrasp Run(bool reverse) {
    goals_ = PairDigits(hand_, person_, object_, reverse);
    standard_ = &FindStandard(hand_, standards_, goals_);
    if (PlaceContact() && MakePostures()) FindWay();
    return std::move(result_);
  }

 private:
  /** Line of closing for all joints, with the s at which it should meet the contact. */
  struct ClosingLine {
    VectorXd q_pre, q_target;
    double s = 1.0;
  };

  bool Fail(const std::string& reason) {
    result_.not_transferable = reason;
    return false;
  }

  PadTask MakeTask() const {
    PadTask task;
    task.goals = goals_;
    task.q_standard = CloseStandard(hand_, *standard_, goals_);
    return task;
  }

  /** Removes unreachable digits one by one. */
  bool PlaceContact() {
    std::vector<PadMiss> left;
    for (;;) {
      PadTask task = MakeTask();
      if (person_.p_OPalm) {
        Vector3d middle = Vector3d::Zero();
        for (const PadGoal& goal : goals_) {
          middle += goal.p_O / static_cast<double>(goals_.size());
        }
        task.palm_O = (*person_.p_OPalm - middle).normalized();
      }
      met_ = placer_.PlaceAnywhere(task);
      result_.pads = placer_.CalcMisses(goals_, met_);
      const auto worst = std::max_element(
          result_.pads.begin(), result_.pads.end(),
          [](const PadMiss& a, const PadMiss& b) { return a.distance < b.distance; });
      const bool is_reached = worst->is_reached();
      const auto place = worst - result_.pads.begin();
      if (!is_reached && goals_.size() > 2) {
        // The thumb stays, since nothing is opposed without it.
        const auto leaves = place == 0 ? static_cast<std::ptrdiff_t>(goals_.size()) - 1 : place;
        left.push_back(result_.pads[static_cast<size_t>(leaves)]);
        goals_.erase(goals_.begin() + leaves);
        continue;
      }
      const std::string unreachable = worst->digit + " stays " +
                                      FormatFixed(MmFromM(worst->distance), 1) +
                                      " mm from the contact of the person's " + worst->person;
      result_.pads.insert(result_.pads.end(), left.begin(), left.end());
      if (!is_reached) return Fail(unreachable);
      const std::string collision = placer_.FindCollision(goals_, met_, kMostDepth);
      return collision.empty() || Fail("at contact " + collision);
    }
  }

  bool MakePostures() {
    Grasp& grasp = result_.grasp;
    grasp.type = standard_->type;
    grasp.approach_distance = standard_->approach_distance;
    grasp.alpha = standard_->alpha;
    grasp.tilt = standard_->tilt;
    grasp.object = object_.id;
    grasp.palm_may_touch = standard_->palm_may_touch;
    grasp.palm_gap = standard_->palm_gap;
    result_.standard = standard_->id;
    for (const Digit& digit : hand_.digits) {
      for (const PadGoal& goal : goals_) {
        if (&hand_.digits[static_cast<size_t>(goal.digit)] == &digit) {
          grasp.digits.push_back(digit.id);
        }
      }
    }
    PadTask open = MakeTask();
    open.moves_hand = false;
    open.room = kOpenRoom;
    open.pad_length = kOpenLength;
    open.q_standard = standard_->q_pre;
    for (PadGoal& goal : open.goals) goal.p_O += goal.opening_O;
    constexpr int kCalls = 1500;
    double cost = 0.0;
    grasp.q_pre = placer_.Place(open, met_, kCalls, cost).q;
    for (const Digit& digit : hand_.digits) {
      if (Grasps(grasp, digit.id)) continue;
      for (const int joint : FindDrivenJoints(hand_, digit)) met_.q[joint] = grasp.q_pre[joint];
    }
    ApplyCoupling(hand_, met_.q);
    result_.q_contact = met_.q;
    for (const PadGoal& goal : goals_) inwards_.push_back(-object_.field->Query(goal.p_O).gradient);
    const Vector3d approach_H = met_.X_OH.linear().transpose() * ListApproaches().front();
    const double weight = object_.mass_properties.mass * kGravity;
    const double grip =
        std::max(kLeastGrip, kGripMargin * weight / (2.0 * object_.surface.friction_static));
    grasp.q_target = CalcSqueeze(hand_, grasp.digits, CloseOn(), approach_H, grip);
    // Alternatives: shifted as a whole onto the contact; straight on from the opening; straight on
    // from the opening of the standard grasp.
    const double s = FindClosingAtContact(hand_, goals_, grasp, met_.X_OH);
    const VectorXd beside = CalcClosingPosture(hand_, grasp, s) - met_.q;
    const double beyond = (grasp.q_target - met_.q).norm();
    lines_ = {{grasp.q_pre - beside, grasp.q_target - beside, s},
              MakeLineFrom(grasp.q_pre, beyond),
              MakeLineFrom(OpenAsStandard(), beyond)};
    result_.undetermined = placer_.FindUndetermined(goals_, met_);
    return true;
  }

  /** Straight through the contact and on by `beyond`. */
  ClosingLine MakeLineFrom(const VectorXd& q_pre, double beyond) const {
    const double further = beyond / std::max((met_.q - q_pre).norm(), 1e-6);
    return {q_pre, met_.q + further * (met_.q - q_pre), 1.0 / (1.0 + further)};
  }

  /** Grasping digits as the standard grasp opens them. */
  VectorXd OpenAsStandard() const {
    VectorXd q = result_.grasp.q_pre;
    for (const int joint : FindGraspJoints(hand_, result_.grasp.digits)) {
      q[joint] = standard_->q_pre[joint];
    }
    ApplyCoupling(hand_, q);
    return q;
  }

  /** Sets both ends of the closing, adjusted to the limits so that it meets the contact at s. */
  void CloseThroughContact(const VectorXd& q_pre, const VectorXd& q_target, double s) {
    Grasp& grasp = result_.grasp;
    grasp.q_pre = q_pre;
    grasp.q_target = q_target;
    for (Eigen::Index j = 0; j < q_pre.size(); ++j) {
      const HandJoint& joint = hand_.joints[static_cast<size_t>(j)];
      const auto limit = [&](double angle) { return std::clamp(angle, joint.lower, joint.upper); };
      const double met = met_.q[j];
      double &pre = grasp.q_pre[j], &target = grasp.q_target[j];
      target = limit(target);
      if (s < 1.0) pre = limit((met - s * target) / (1.0 - s));
      if (s > 0.0) target = limit((met - (1.0 - s) * pre) / s);
    }
    ApplyCoupling(hand_, grasp.q_pre);
    ApplyCoupling(hand_, grasp.q_target);
  }

  /** Continues from the opening through the contact until every pad has the required depth. */
  VectorXd CloseOn() const {
    constexpr int kMostSteps = 20;
    constexpr double kStep = 0.1;  // share of the distance from the opening to the contact
    VectorXd q = met_.q;
    for (int k = 1; k <= kMostSteps; ++k) {
      q = met_.q + k * kStep * (met_.q - result_.grasp.q_pre);
      ClampToLimits(q);
      const std::vector<Vector3d> pads = ListPads(hand_, goals_, q);
      double least = std::numeric_limits<double>::infinity();
      for (size_t g = 0; g < goals_.size(); ++g) {
        const Vector3d inside = met_.X_OH * pads[g] - goals_[g].p_O;
        least = std::min(least, inside.dot(inwards_[g]));
      }
      if (least >= kPlacementOffset) break;
    }
    return q;
  }

  /** Possible approach directions, horizontal or downwards: that of the person, that of the palm,
  and that from the palm to the pads. */
  std::vector<Vector3d> ListApproaches() const {
    Vector3d middle = Vector3d::Zero();
    for (const PadGoal& goal : goals_) middle += goal.p_O / static_cast<double>(goals_.size());
    const Matrix3d& R_OH = met_.X_OH.linear();
    const Vector3d candidates[] = {person_.approach_O,
                                   R_OH * CalcApproachDirection(hand_, standard_->tilt),
                                   (middle - met_.X_OH * hand_.p_HCentre).normalized(),
                                   R_OH * CalcApproachDirection(hand_, 0.5 * kPi)};
    std::vector<Vector3d> approaches;
    for (Vector3d approach : candidates) {
      approach.z() = std::min(approach.z(), 0.0);
      if (approach.norm() > 0.5) approaches.push_back(approach.normalized());
    }
    return approaches;
  }

  /** Returns why the closing hand touches the table; empty if it is clear. */
  std::string FindTableFault(const Grasp& grasp) const {
    for (int k = 0; k <= kNumShares; ++k) {
      const double s = grasp.placement->closing_at_contact * k / kNumShares;
      const double room = placer_.CalcTableRoom({met_.X_OH, CalcClosingPosture(hand_, grasp, s)});
      if (room >= 0.0) continue;
      return "as it closes it is " + FormatFixed(-MmFromM(room), 1) + " mm inside the table";
    }
    return "";
  }

  /** Returns the approach with the largest clearance for the unchanged grasp. */
  Placement FindPlacement(double s) {
    Grasp& grasp = result_.grasp;
    const Vector3d p_WO(0.0, 0.0, 0.5 * object_.size.z());
    Placement best;
    result_.room = -std::numeric_limits<double>::infinity();
    for (const Vector3d& approach : ListApproaches()) {
      grasp.placement = {MakePose(p_WO) * met_.X_OH, approach, s, true};
      const double room = PredictGrasp(hand_, grasp, object_).room;
      if (room <= result_.room) continue;
      result_.room = room;
      best = *grasp.placement;
    }
    return best;
  }

  /** Checks the open hand at its start and at the grasp, and the path between. */
  std::string FindOpenFault() const {
    const Grasp& grasp = result_.grasp;
    for (const double back : {0.0, grasp.approach_distance}) {
      Pose X_OH = met_.X_OH;
      X_OH.translation() -= back * grasp.placement->approach_W;
      const std::string collision = placer_.FindCollision({}, {X_OH, grasp.q_pre}, 0.0);
      if (!collision.empty()) return "open, " + collision;
    }
    if (result_.room >= -kBrush) return FindTableFault(grasp);
    return "its open digits come " + FormatFixed(-MmFromM(result_.room), 1) +
           " mm too near to the object on their way, draws included";
  }

  /** Opens the pre-grasp, along its line with the target, until nothing is in the way. */
  bool FindWay() {
    constexpr int kOpenings = 10;
    std::string first_fault;
    for (const ClosingLine& line : lines_) {
      for (int k = 0; k <= kOpenings; ++k) {
        const double wider = static_cast<double>(k) / kOpenings;
        const double s = (line.s + wider) / (1.0 + wider);
        CloseThroughContact(line.q_pre + wider * (line.q_pre - line.q_target), line.q_target, s);
        result_.grasp.placement = FindPlacement(s);
        const std::string fault = FindOpenFault();
        if (fault.empty()) return true;
        if (first_fault.empty()) first_fault = fault;
      }
    }
    return Fail(first_fault);
  }

  void ClampToLimits(VectorXd& q) const {
    for (size_t j = 0; j < hand_.joints.size(); ++j) {
      double& angle = q[static_cast<Eigen::Index>(j)];
      angle = std::clamp(angle, hand_.joints[j].lower, hand_.joints[j].upper);
    }
    ApplyCoupling(hand_, q);
  }

  const Hand& hand_;
  const std::vector<Grasp>& standards_;
  const PersonGrasp& person_;
  const GraspObject& object_;
  PadPlacer placer_;
  const Grasp* standard_ = nullptr;
  std::vector<PadGoal> goals_;
  std::vector<Vector3d> inwards_;  // at the goals, unit
  PlacedPosture met_;
  std::vector<ClosingLine> lines_;  // tested one after the other
  TransferredGrasp result_;
};

}  // namespace

TransferredGrasp TransferGrasp(const Hand& hand, const std::vector<Grasp>& standard,
                               const PersonGrasp& person, const GraspObject& object) {
  constexpr size_t kMostReversible = 2;  // fingers that may exchange their roles
  TransferredGrasp failed;
  failed.not_transferable = FindPersonFault(person, object);
  if (hand.digits.size() < 2 || standard.empty()) {
    failed.not_transferable = "the hand has no two digits or no standard grasp to go towards";
  }
  if (!failed.not_transferable.empty()) return failed;
  const int of_person = FindHandedness(person);
  const int of_hand = FindHandedness(hand, standard.front());
  const bool differ = of_person * of_hand < 0;
  if (differ && hand.digits.size() > kMostReversible + 1) {
    const auto name = [](int side) { return side > 0 ? "left" : "right"; };
    failed.not_transferable =
        std::string("by thumb, fingers and wrist the person's is a ") + name(of_person) +
        " hand, and the robot's is a " + name(of_hand) +
        " one: choose the other hand, or check for mirrored axes and exchanged markers";
    return failed;
  }
  return Transfer(hand, standard, UseLandmarks(person, object), object).Run(differ);
}

}  // namespace graspbench
