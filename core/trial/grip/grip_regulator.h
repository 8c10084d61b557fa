#pragma once
/** @file
A hand that regulates its grip (StrategyConfig::grip, force and margin). After every step it knows
the normal force F_d of each digit, filtered with kFilterTime: exactly, or by sensed touch as its
elements feel it and, beside them, as its drives' torques say (unfelt_force.h). A digit of which
neither says anything is closed by posture, and is no part of the sums.

Closing: at its first touch a digit takes back what its command was ahead of it, then goes on with
touch_speed while F_d is below its share a_d. Once closure has ended and every digit has its share
or stands at its target, or the sum has its own, all digits are shifted together by its error,

    ds_d/dt = (a_d / G_d) (A - S) / (A kShiftTime),    A = sum a_d,  S = sum F_d

with G_d = dF/ds the closing stiffness (grip_statics.h), so that the sides stay in balance: an
integrator for each digit would let them drift against each other. With saturating drives digits
close on, and the torques of those that touch are limited to c times what holds their shares, with
the error of the sum as dc/dt = c (A - S) / (A kShiftTime). That goes on to the end of the
trial and in the judge. An error below kDeadShare of A moves nothing; no digit goes on against a
drive at its limit, or beyond s = kMostClosing: the target posture is where a digit that has found
nothing stops; one that presses may be commanded beyond it, since a spring presses by what it is
ahead. In a power grasp it may not: that holds by enclosing, in its target posture, and pressing on
pushes the object out of it.

Two digits that both oppose a third are shifted against each other, too, by the difference of their
forces over their shares; four are not: equal shares of four on a rigid body are more than statics
allow.

Shares: each digit that does not oppose the others is asked for the force F; the opposing one, and
the rest of the hand where it touches, for what balances them (grip_statics.h). F is grip_force;
under margin grip_margin times the smallest force with which the contacts bear the weight
(holding_force.h), and at least grip_force; before that is known, the same of two opposed sides, m g
/ (2 mu). The hand is told the object's weight and dynamic friction, and where its contacts are. By
sensed touch it is told nothing of their forces: which way its parts push is that of their normals,
and the palm has what balances the digits. */

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

/** A value: it is saved and restored with the trial. */
class GripRegulator {
 public:
  /** @param digits  those that grasp, indices into Hand::digits. */
  GripRegulator(const TrialSetup& setup, const std::vector<int>& digits);

  /** Of a firm grip in the midst of a closure: one that regulates from here on. Its digits go on
  from where they are asked to be, each by its part of the way from pre-grasp to target posture.
  @param asked  of the drives, without their errors (num_joints). */
  GripRegulator TakeOver(GripMode mode, const Eigen::VectorXd& asked) const;

  /** After a step. @param phase  it was in.  @param command  its own.
  @param sensors  null: it feels the contacts.  @param duration  of the step [s]. */
  void Observe(Phase phase, World& world, const WorldCommand& command,
               const std::vector<HandContact>& contacts, const TouchSensors* sensors,
               double duration);
  /** The next command. @param phase  in which the step begins.  @param duration  of the step [s]. */
  void Advance(Phase phase, double duration);
  /** Puts the digits' part into a command for a common closing. */
  void Command(WorldCommand& command) const;

  /** As far as the hand knows. */
  bool have_all_touched() const {
    return std::all_of(digits_.begin(), digits_.end(), [](const auto& d) { return d.has_touched; });
  }
  double closing(size_t digit) const { return digits_[digit].CalcClosing(); }
  bool is_regulated() const { return mode_ != GripMode::kPosture; }
  bool is_in_band() const { return in_band_since_ <= time_ - kBandTime; }
  /** A digit still closed towards its share in the last step. */
  bool is_closing() const { return is_regulated() && is_closing_; }
  /** From the start of closure to the target posture of the slowest digit [s]. */
  double CalcClosureTime() const;
  /** @pre is_regulated() */
  GripRecord MakeRecord() const;

 private:
  static constexpr double kBandTime = 0.2;     // [s]
  static constexpr double kMostClosing = 3.0;  // s of a digit that presses, but for power grasps

  struct DigitGrip {
    int digit;
    bool opposes;
    bool is_late;  // against its schedule: it closes on whatever the phase
    std::vector<int> joints;
    ClosingLaw law;
    double beyond = 0.0;  // the target posture, in s
    bool has_touched = false;
    bool is_known = true;             // its force: else it is closed by posture
    double force = 0.0, asked = 0.0;  // filtered [N]
    double stiffness = kLeastStiffness;
    Eigen::VectorXd torque = {};  // that holds a unit of force (num_dofs)
    double pressed = 0.0;         // what it presses with in truth, filtered [N]
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
  /** Of a posture the part of a digit's way [s]. @param way  of a joint, from the pre-grasp. */
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
  double most_closing_;     // s of a digit that presses
  Eigen::VectorXd way_;     // q_target - q_pre
  Eigen::VectorXd offset_;  // of a posture beside that way; empty: none
  std::vector<int> parts_;  // of each link: a digit's place in digits_, or the rest's
  std::vector<DigitGrip> digits_;
  double rest_force_ = 0.0, rest_asked_ = 0.0;  // of the rest of the hand, filtered [N]
  double told_weight_, told_friction_;
  std::optional<double> smallest_;
  bool regulates_ = false, is_closing_ = false;
  double torque_share_ = 1.0;  // c
  double time_ = 0.0, in_band_since_ = kUnset, next_look_ = 0.0;
  double asked_ = 0.0, sum_ = 0.0;  // A, S
  double peak_ = 0.0, closed_ = kUnset, held_sum_ = 0.0, held_asked_ = 0.0;
  double rest_held_sum_ = 0.0, rest_held_asked_ = 0.0;
  bool was_in_band_ = false;
  double held_time_ = 0.0;  // of the hold [s]
  Phase phase_ = Phase::kPlacing;
  Eigen::VectorXd drive_positions_;  // of the last step (num_joints)
  std::vector<int> dofs_;            // of each joint
  std::vector<bool> is_stopped_;     // by joint: at the stop towards which it closes
};

}  // namespace graspbench
