#pragma once
/** @file
Loads on each part of a hand over a trial, every 10 ms, as the input of a diagnosis.

A part is a grasping digit or, as the last, the rest of the hand. Works on the object are relative
to the hand: with v_H(C) the velocity of the hand's base H at a contact C, and v_O(C) that of the
object,

    W_normal = sum dt N nhat . (v_O(C) - v_H(C))       likewise W_friction of the friction force
    W_gravity = sum dt m g . (v_O(Ocm) - v_H(Ocm))

Besides the hand only gravity and the table act on the object. The table's horizontal force is at
most its normal force times a friction of kTableFriction. The remainder of the momentum balance over
a sample is attributed to an external push:

    F_rest = m dv/dt - m g - F_hand
    push   = max(0, |F_rest,xy| - kTableFriction N_table) + |F_rest,z - N_table|

Before the hand first touches the object, the table can only hold back an object that was at rest,
so any motion is due to a push. The first term is then max(0, F_rest,xy v / |v|).

The balance is exact if forces are those at the end of an implicit step (ImplicitWorld). */

#include <memory>
#include <string_view>
#include <vector>

#include "core/physics/world.h"
#include "core/trial/trial_setup.h"

namespace graspbench {

struct PartSample {
  float force = 0.0f;  ///< sum of normal forces [N]
  /** Vector sum of its normal forces on the object [N]. */
  Eigen::Vector3f normal_W = Eigen::Vector3f::Zero();
  float normal_work = 0.0f;           ///< on the object, over the sample [J]
  float friction_work = 0.0f;         ///< likewise [J]
  bool is_at_limit = false;           ///< one of its drives is at its torque limit, in any
                                      ///< direction
  std::string_view limit_joint = {};  ///< joint of that drive; empty: unknown
};

struct LoadSample {
  double time = 0.0;          ///< since the start of placing [s]
  double shift = 0.0;         ///< of the object's centre of mass from rest, along the table [m]
  double push = 0.0;          ///< mean over the sample [N]
  double table_force = 0.0;   ///< mean normal force over the sample [N]
  double gravity_work = 0.0;  ///< over the sample [J]
  Eigen::Matrix3f R_HO = Eigen::Matrix3f::Identity();
  std::vector<PartSample> parts;  ///< grasping digits, then the rest of the hand
};

/** A value type: saved and restored with the trial. */
class LoadRecorder {
 public:
  /** @param digits  grasping digits, as indices into Hand::digits. */
  LoadRecorder(const TrialSetup& setup, const std::vector<int>& digits);

  /** Call after every step. */
  void Observe(double time, double duration, const World& world, const WorldCommand& command,
               const StepReport& report, const std::vector<HandContact>& contacts);

  const std::vector<LoadSample>& samples() const { return samples_; }

 private:
  void AddWork(double duration, const World& world, const std::vector<HandContact>& contacts);
  int FindFullDrive(size_t part, const World& world, const WorldCommand& command) const;

  std::shared_ptr<const Hand> hand_;
  Eigen::VectorXd way_;  // q_target - q_pre
  std::vector<int> part_of_link_;
  std::vector<std::vector<int>> joints_;  // joints that close each grasping digit
  std::vector<LoadSample> samples_;
  Eigen::Vector3d impulse_W_ = Eigen::Vector3d::Zero();  // of the hand, since the last sample [N s]
  double table_impulse_ = 0.0;                           // [N s]
  double gravity_work_ = 0.0;                            // since the last sample [J]
  std::vector<double> normal_work_, friction_work_;      // likewise, by part [J]
  bool has_touched_ = false;                             // whether the hand has touched the object
  double begun_ = kUnset;                                // start of the sample [s]
  Eigen::Vector3d v_begun_W_ = Eigen::Vector3d::Zero();  // of the object's centre of mass [m/s]
  Eigen::Vector2d rest_W_ = Eigen::Vector2d::Zero();     // [m]
};

}  // namespace graspbench
