#include <algorithm>
#include <cmath>

#include "core/base/text/text.h"
#include "core/base/units.h"
#include "core/hand/closing.h"
#include "core/hand/import/checks/find_implausible.h"
#include "core/hand/import/foreign_hand.h"
#include "core/hand/import/guess_hand.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

constexpr double kMostEffort = 3.0;   // [N m], plausible for any finger's drive
constexpr double kMostForce = 200.0;  // [N], likewise for a slide's drive
/** The strongest electric grippers hold with 235 N between two tips, fingers of hands with less
than 100 N, pneumatic grippers with less than 1 kN per kilogram of their mass. */
constexpr double kMostTipForce = 250.0, kMostFingerForce = 100.0, kMostForceByMass = 1000.0,
                 kMostForceOfAny = 5000.0;
/** Largest published stiffness that is plausible for a finger; [N m/rad], [N/m]. */
constexpr double kStiffest = 50.0, kStiffestSlide = 50000.0;
/** Largest sag of a plausible drive under the links that it moves [rad], [m]. */
constexpr double kMostSag = 0.25, kMostSlideSag = 0.005;
/** Limits of damping over stiffness [s]: below, the finger oscillates; above, it creeps. */
constexpr double kDampingTime = 0.02, kMostDampingTime = 0.1;
constexpr int kMostEqual = 3;       // most drives with the same round effort; more: a placeholder
constexpr double kBears = 0.5;      // of the weight that a drive moves
constexpr double kFarBeyond = 3.0;  // times the value used, to be reported

class DriveGuesser {
 public:
  DriveGuesser(const std::string& file, ImportedHand& imported, Diagnostics& problems)
      : file_(file), imported_(imported), hand_(imported.hand), problems_(problems) {}

  void Guess() {
    SetDrives();
    TellEfforts();
    TellWeakEfforts();
    TellGains();
    TellDamping();
  }

 private:
  /** Value of a joint without a published one: at most that of the weakest joint of its digit. */
  template <class IsBelieved>
  double GuessDrive(int joint, double ForeignDrive::*value, double otherwise,
                    IsBelieved&& is_believed) const {
    const HandJoint& own = hand_.joints[joint];
    for (int k = 0; k < hand_.num_joints(); ++k) {
      const HandJoint& other = hand_.joints[k];
      const bool is_neighbour =
          other.coupled_to < 0 && other.is_prismatic == own.is_prismatic &&
          hand_.FindDigitOfLink(other.link) == hand_.FindDigitOfLink(own.link);
      if (!is_neighbour || !is_believed(k)) continue;
      otherwise = std::min(otherwise, imported_.drives[static_cast<size_t>(k)].*value);
    }
    return otherwise;
  }

  /** Whether the hand still moves with this stiffness. */
  bool IsStiffnessBelieved(int joint) const {
    const double stiffness = imported_.drives[static_cast<size_t>(joint)].stiffness;
    const bool slides = hand_.joints[joint].is_prismatic;
    return stiffness > 0.0 && stiffness <= (slides ? kStiffestSlide : kStiffest) &&
           stiffness * (slides ? kMostSlideSag : kMostSag) >= CalcLoad(joint);
  }

  /** Largest plausible effort [N m], [N]. */
  double CalcMostEffort(int joint) const {
    if (hand_.joints[joint].is_prismatic) {
      double mass = 0.0;
      for (const HandLink& link : hand_.links) mass += link.mass;
      return std::clamp(kMostForceByMass * mass, kMostForce, kMostForceOfAny);
    }
    const double at_tip = hand_.digits.size() > 2 ? kMostFingerForce : kMostTipForce;
    return std::max(kMostEffort, at_tip * CalcLongestDigit(hand_));
  }

  /** Exporters write 10, 100 or 1000 as placeholders. */
  bool IsEffortBelieved(int joint) const {
    const double effort = imported_.drives[static_cast<size_t>(joint)].effort;
    if (effort <= (hand_.joints[joint].is_prismatic ? kMostForce : kMostEffort))
      return effort > 0.0;
    const double digits = std::log10(effort);
    const bool is_round = std::abs(digits - std::round(digits)) < 1e-9;
    int num_equal = 0;
    for (int k = 0; k < hand_.num_joints(); ++k) {
      num_equal += hand_.joints[k].coupled_to < 0 &&
                   imported_.drives[static_cast<size_t>(k)].effort == effort;
    }
    return effort <= CalcMostEffort(joint) && !(is_round && num_equal > kMostEqual);
  }

  /** Load on the joint by the weight of all that it moves, stretched out [N m], [N]. */
  double CalcLoad(int joint) const {
    constexpr double kGravity = 9.81;
    const std::vector<Pose> X_HL = CalcLinkPoses(hand_, CalcClosedPosture(hand_, {}, 0.0));
    const int moved = hand_.joints[joint].link;
    double load = 0.0;
    for (int link = 0; link < static_cast<int>(hand_.links.size()); ++link) {
      int at = link;
      while (at >= 0 && at != moved) at = hand_.links[at].parent;
      if (at < 0) continue;
      const Vector3d arm = X_HL[link] * hand_.links[link].p_LLcm - X_HL[moved].translation();
      load +=
          kGravity * hand_.links[link].mass * (hand_.joints[joint].is_prismatic ? 1.0 : arm.norm());
    }
    return load;
  }

  void TellEfforts() {
    std::vector<std::string> joints;
    double largest = 0.0;
    for (int j = 0; j < hand_.num_joints(); ++j) {
      const HandJoint& joint = hand_.joints[j];
      const double effort = imported_.drives[static_cast<size_t>(j)].effort;
      if (joint.coupled_to >= 0 || effort <= 0.0 || IsEffortBelieved(j)) continue;
      if (hand_.FindDigitOfLink(joint.link) < 0) continue;  // a wrist
      joints.push_back(joint.name);
      largest = std::max(largest, effort);
    }
    if (joints.empty()) return;
    Warn("the effort of " + FormatCount(static_cast<int64_t>(joints.size()), "joint") + " (" +
         JoinSome(joints) + "), up to " + FormatSignificant(largest, 3) +
         ", is not that of a finger's drive: a placeholder, or more than 100 N at a tip, of a "
         "gripper 250 N, or 1 kN for each kilogram of the hand; guessed instead. If it is meant, "
         "write it into hand.yaml");
  }

  void TellWeakEfforts() {
    std::vector<std::string> weak;
    for (int j = 0; j < hand_.num_joints(); ++j) {
      const double effort = imported_.drives[static_cast<size_t>(j)].effort;
      if (hand_.joints[j].coupled_to >= 0 || effort <= 0.0) continue;
      if (effort < kBears * CalcLoad(j)) weak.push_back(hand_.joints[j].name);
    }
    if (weak.empty()) return;
    Warn("the effort of " + FormatCount(static_cast<int64_t>(weak.size()), "joint") + " (" +
         JoinSome(weak) +
         ") bears less than half of the weight of the links that it moves; is it in another unit?");
  }

  /** Reports the drives whose published stiffness is not used. */
  void TellGains() const {
    std::vector<std::string> told;
    for (int j = 0; j < hand_.num_joints(); ++j) {
      const HandJoint& joint = hand_.joints[j];
      const double published = imported_.drives[static_cast<size_t>(j)].stiffness;
      if (joint.coupled_to >= 0 || published <= 0.0 || published == joint.drive.stiffness) continue;
      told.push_back(joint.name + " " + FormatSignificant(published, 3));
    }
    if (told.empty()) return;
    problems_.Warn(
        file_, 0,
        "the stiffness of " + FormatCount(static_cast<int64_t>(told.size()), "drive") + " (" +
            JoinSome(told) +
            ") is not that of a finger's: above 50 N m/rad (50000 N/m), or the links that it moves "
            "sag by more than 0.25 rad (5 mm); guessed instead");
  }

  /** Reports the drives that would creep and thus get less damping than published. */
  void TellDamping() const {
    std::vector<std::string> told;
    for (int j = 0; j < hand_.num_joints(); ++j) {
      const HandJoint& joint = hand_.joints[j];
      const ForeignDrive& published = imported_.drives[static_cast<size_t>(j)];
      if (joint.coupled_to >= 0 || published.stiffness != joint.drive.stiffness) continue;
      if (published.damping <= kFarBeyond * joint.drive.damping) continue;
      told.push_back(joint.name + " " + FormatSignificant(published.damping, 3));
    }
    if (told.empty()) return;
    problems_.Warn(file_, 0,
                   "the damping of " + FormatCount(static_cast<int64_t>(told.size()), "drive") +
                       " (" + JoinSome(told) +
                       ") would let them crawl, more than 0.3 s by their stiffness; less is taken. "
                       "Is it in another unit?");
  }

  void SetDrives() {
    hand_.joint_accuracy = RadFromDeg(1.0);
    for (int j = 0; j < hand_.num_joints(); ++j) {
      HandJoint& joint = hand_.joints[j];
      const ForeignDrive& drive = imported_.drives[static_cast<size_t>(j)];
      const auto is_effort_known = [&](int k) {
        const double effort = imported_.drives[static_cast<size_t>(k)].effort;
        return effort > 0.0 && effort <= (joint.is_prismatic ? kMostForce : kMostEffort);
      };
      joint.drive.torque_limit = IsEffortBelieved(j)
                                     ? drive.effort
                                     : GuessDrive(j, &ForeignDrive::effort,
                                                  joint.is_prismatic ? 40.0 : 1.0, is_effort_known);
      const bool is_published = IsStiffnessBelieved(j);
      joint.drive.stiffness =
          is_published ? drive.stiffness
                       : GuessDrive(j, &ForeignDrive::stiffness, joint.is_prismatic ? 3000.0 : 3.0,
                                    [this](int k) { return IsStiffnessBelieved(k); });
      const double damping = kDampingTime * joint.drive.stiffness;
      joint.drive.damping = is_published ? std::clamp(drive.damping, damping,
                                                      kMostDampingTime * joint.drive.stiffness)
                                         : damping;
      if (joint.is_prismatic) hand_.slide_accuracy = 0.0005;
      if (joint.coupled_to < 0 && hand_.FindDigitOfLink(joint.link) < 0) {
        if (joint.lower > 0.0 || joint.upper < 0.0) {
          Warn("joint \"" + joint.name +
               "\" belongs to no digit and is held at zero, which its limits forbid; widened to "
               "zero");
          joint.lower = std::min(joint.lower, 0.0);
          joint.upper = std::max(joint.upper, 0.0);
        } else {
          Warn("joint \"" + joint.name + "\" belongs to no digit and is held at zero: a wrist");
        }
      }
    }
  }

  void Warn(const std::string& text) { problems_.Warn(file_, 0, text); }

  const std::string& file_;
  ImportedHand& imported_;
  Hand& hand_;
  Diagnostics& problems_;
};

}  // namespace

void GuessDrives(const std::string& file, ImportedHand& imported, Diagnostics& problems) {
  DriveGuesser(file, imported, problems).Guess();
}

}  // namespace graspbench
