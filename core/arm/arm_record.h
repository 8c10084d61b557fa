#pragma once
/** @file
What a trial with an arm says of it. */

#include <Eigen/Core>
#include <string>

#include "core/base/text/record_fields.h"
#include "core/base/units.h"

namespace graspbench {

/** Of the course that was chosen (arm_course.h); where there is none, of what prevents it. */
struct ArmRecord {
  std::string joint;       ///< nearest its limit on the course, or that binds; empty: no joint does
  double margin = kUnset;  ///< of that joint to its limit [rad]; negative: so far beyond
  double speed_share = kUnset;    ///< largest joint speed on the straight parts, over its limit
  double dexterity = kUnset;      ///< smallest on the course (Arm::CalcDexterity)
  double reach_time = kUnset;     ///< of the gross motion to the pre-grasp pose [s]
  double reach_path = kUnset;     ///< path of the hand's frame H in it [m]
  double straight_time = kUnset;  ///< of placing and lift [s]
  double straight_path = kUnset;  ///< [m]
  Eigen::VectorXd q;              ///< at the grasp [rad]; empty: there is none
  /** Largest distance and turn of the hand from its commanded pose in the trial, by which the joints
  gave way. */
  double deflection = kUnset, deflection_angle = kUnset;  ///< [m], [rad]
  double torque_share = kUnset;  ///< largest torque of a joint, weights included, over its limit
  std::string torque_joint;      ///< of that joint; empty: there is no course

  template <class V>
  static void ListFields(V&& field) {
    using R = ArmRecord;
    field("joint", &R::joint);
    field("margin_rad", &R::margin, FieldMayMiss{});
    field("speed_share", &R::speed_share, FieldMayMiss{});
    field("dexterity", &R::dexterity, FieldMayMiss{});
    field("reach_time_s", &R::reach_time, FieldMayMiss{});
    field("reach_path_m", &R::reach_path, FieldMayMiss{});
    field("straight_time_s", &R::straight_time, FieldMayMiss{});
    field("straight_path_m", &R::straight_path, FieldMayMiss{});
    field("q_rad", &R::q);
    field("deflection_m", &R::deflection, FieldMayMiss{});
    field("deflection_rad", &R::deflection_angle, FieldMayMiss{});
    field("torque_share", &R::torque_share, FieldMayMiss{});
    field("torque_joint", &R::torque_joint);
  }
};

}  // namespace graspbench
