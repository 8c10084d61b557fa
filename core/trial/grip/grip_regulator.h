#pragma once
/** @file
Grip-force regulation of a hand (StrategyConfig::grip, force and margin). After every step the
normal force F_d of each digit is known, filtered with kFilterTime. It is either exact, or follows
from sensed touch: from the readings of the elements and, beside them, from the drive torques
(unfelt_force.h). A digit for which neither gives a force is closed by posture and left out of the
sums.

Closing: at its first touch a digit takes back the lead of its command, then continues with
touch_speed while F_d is below its share a_d. Regulation begins when closure has ended and every
digit has its share or is at its target, or when the sum has reached its setpoint. From then on all
digits are shifted together by the error of the sum,

    ds_d/dt = (a_d / G_d) (A - S) / (A kShiftTime),    A = sum a_d,  S = sum F_d

where G_d = dF/ds is the closing stiffness (grip_statics.h). This keeps the sides in balance, while
separate integrators per digit would let them drift against each other. With saturating drives the
digits continue to close. The torques of those that touch are limited to c times the torques that
hold their shares, where dc/dt = c (A - S) / (A kShiftTime). Regulation continues to the end of the
trial and in the judge. An error below kDeadShare of A has no effect. No digit continues against a
drive at its limit, or beyond s = kMostClosing. The target posture is where a digit without contact
stops. A pressing digit may be commanded beyond it, since a spring presses in proportion to its
lead. A power grasp may not exceed it: it holds by enclosing in its target posture, and further
pressing pushes the object out.

Two digits that both oppose a third are also shifted against each other, by the difference of their
forces relative to their shares. Four digits are not: equal shares of four on a rigid body are more
than statics allow.

Shares: each digit that does not oppose the others has the setpoint F. The opposing digit, and the
rest of the hand if it touches, have the forces that balance them (grip_statics.h). F is grip_force.
Under margin it is grip_margin times the smallest force with which the contacts bear the weight
(holding_force.h), and at least grip_force. Until that force is known, the one of two opposed sides
is used, m g / (2 mu). The controller is given the object's weight and dynamic friction and the
positions of the contacts. Under sensed touch it does not know their forces: parts are taken to push
along their normals, and the palm bears what balances the digits. */

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "core/grasp/closing_law.h"
#include "core/trial/grip/grip_record.h"
#include "core/trial/grip/grip_statics.h"
#include "core/trial/touch_sensors.h"
#include "core/trial/trial_setup.h"

namespace graspbench {

/** A value type: saved and restored with the trial. */
class GripRegulator {
 public:
  /** @param digits  grasping digits, as indices into Hand::digits. */
  GripRegulator(const TrialSetup& setup, const std::vector<int>& digits);

  /** Takes over from a firm grip during a closure: returns a regulator that starts from the current
  commands. The closing of each digit is the share of its path from pre-grasp to target posture.
  @param asked  drive setpoints, without their errors (num_joints). */
  GripRegulator TakeOver(GripMode mode, const Eigen::VectorXd& asked) const;

  /** Call after every step. @param phase  phase of the step.  @param command  its command.
  @param sensors  null: touch is exact.  @param duration  of the step [s]. */
  void Observe(Phase phase, World& world, const WorldCommand& command,
               const std::vector<HandContact>& contacts, const TouchSensors* sensors,
               double duration);
  /** Computes the next command. Digits follow the grasp's course, if it is set, from the start of
  placing. @param phase  in which the step begins.  @param duration  of it [s]. */
  void Advance(Phase phase, double duration);
  /** Writes the digits' setpoints into a command. */
  void Command(WorldCommand& command) const;

  /** Whether all digits have touched, as far as the hand can tell. */
  bool have_all_touched() const {
    return std::all_of(digits_.begin(), digits_.end(), [](const auto& d) { return d.has_touched; });
  }
  double closing(size_t digit) const { return digits_[digit].CalcClosing(); }
  /** Time since the start of placing with the grasp's course [s]. */
  double course_time() const { return course_time_; }
  bool is_regulated() const { return mode_ != GripMode::kPosture; }
  bool is_in_band() const { return in_band_since_ <= time_ - kBandTime; }
  /** Whether a digit was still closing towards its share in the last step. */
  bool is_closing() const { return is_regulated() && is_closing_; }
  /** Time from the start of closure to the target posture of the slowest digit [s]. */
  double CalcClosureTime() const;
  /** @pre is_regulated() */
  GripRecord MakeRecord() const;

 private:
  static constexpr double kBandTime = 0.2;     // [s]
  static constexpr double kMostClosing = 3.0;  // s of a pressing digit, except in power grasps

  struct DigitGrip {
    int digit;
    bool opposes;
    bool is_late;  // delayed relative to its schedule: it closes in any phase
    std::vector<int> joints;
    ClosingLaw law;
    double beyond = 0.0;  // closing beyond the target posture, in s
    bool has_touched = false;
    bool is_known = true;             // its force is known; else it is closed by posture
    double force = 0.0, asked = 0.0;  // filtered force and setpoint [N]
    double stiffness = kLeastStiffness;
    Eigen::VectorXd torque = {};  // torques that hold a unit force (num_dofs)
    double pressed = 0.0;         // true force, filtered [N]
    double closed = kUnset, held_sum = 0.0, asked_sum = 0.0, pressed_sum = 0.0;
    std::pair<GripFault, int> fault = {GripFault::kNone, -1};  // at the start of lift-off

    double CalcClosing() const { return law.closing() + beyond; }
    void Shift(double by, double most) {
      const double closing = std::min(CalcClosing() + by, most);
      law.MoveTo(closing);
      beyond = std::max(0.0, closing - 1.0);
    }
  };

  void FollowTouches(const World& world, const std::vector<HandContact>& contacts,
                     const TouchSensors* sensors);
  std::vector<HandContact> EstimateForces(World& world, const WorldCommand& command,
                                          const std::vector<HandContact>& contacts,
                                          const TouchSensors& sensors);
  void FindSmallest(const World& world, const std::vector<HandContact>& contacts);
  void ShareForce(const std::vector<PartLoad>& loads, double duration);
  void ShareWithinSide(double duration);
  /** Closing s of a digit in a posture. @param way  displacement of a joint from the pre-grasp. */
  template <class Way>
  double FindClosing(const DigitGrip& digit, Way way) const;
  double CalcCommand(const DigitGrip& digit, int joint) const;
  void TakeBack(DigitGrip& digit, const World& world) const;
  bool IsAtLimit(const DigitGrip& digit, int joint, double share) const;
  bool IsAtLimit(const DigitGrip& digit) const;
  bool IsStopped(const DigitGrip& digit) const;
  int FindFullDrive(const DigitGrip& digit) const;
  double CalcSharedTorque(const DigitGrip& digit, int joint) const;
  std::pair<GripFault, int> FindFault(const DigitGrip& digit, double asked, double reached,
                                      double pressed) const;
  double CalcAskedForce() const;
  void NoteHold(Phase phase, double duration);

  std::shared_ptr<const TrialSetup> setup_;  // shared by copies
  GripMode mode_;
  bool is_saturating_;
  double most_closing_;     // largest s of a pressing digit
  Eigen::VectorXd way_;     // q_target - q_pre
  Eigen::VectorXd offset_;  // offset of the posture from that line; empty: none
  std::vector<int> parts_;  // by link: index of its digit in digits_, or digits_.size()
  std::vector<DigitGrip> digits_;
  double rest_force_ = 0.0, rest_asked_ = 0.0;  // force and setpoint of the rest of the hand,
                                                // filtered [N]
  double told_weight_, told_friction_;
  std::optional<double> smallest_;
  bool regulates_ = false, is_closing_ = false;
  double course_time_ = 0.0;
  double torque_share_ = 1.0;  // c
  double time_ = 0.0, in_band_since_ = kUnset, next_look_ = 0.0;
  double asked_ = 0.0, sum_ = 0.0;  // A, S
  double peak_ = 0.0, closed_ = kUnset, held_sum_ = 0.0, held_asked_ = 0.0;
  double rest_held_sum_ = 0.0, rest_held_asked_ = 0.0;
  bool was_in_band_ = false;
  double held_time_ = 0.0;  // duration of the hold so far [s]
  Phase phase_ = Phase::kPlacing;
  Eigen::VectorXd drive_positions_;  // in the last step (num_joints)
  std::vector<int> dofs_;            // by joint
  std::vector<bool> is_stopped_;     // by joint: at the stop towards which it closes
};

}  // namespace graspbench
