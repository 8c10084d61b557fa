#pragma once
/** @file
Record of a trial's regulated grip: setpoints, measured forces, and why a digit never reached its
setpoint. Forces are sums of normal forces; those of the hold are means over it. */

#include <optional>
#include <string>
#include <vector>

#include "core/base/enum_table.h"
#include "core/base/text/json.h"
#include "core/base/text/record_fields.h"
#include "core/base/units.h"

namespace graspbench {

/** Why a digit's force differs from its setpoint by more than kGripTolerance. */
enum class GripFault {
  kNone,
  kNoTouch,   ///< the digit never touched
  kNotFelt,   ///< elements and drives give no force, or one that is wrong by more than the
              ///< tolerance
  kPosture,   ///< the digit is at its target posture
  kLimit,     ///< one of its drives is at its torque limit
  kStop,      ///< a driven joint is at its stop, which bears the torque of its drive
  kCoupling,  ///< a coupled joint is at its stop
  kBalance    ///< by statics, part of the force goes to other digits, or comes from them
};
inline constexpr NamedValue<GripFault> kGripFaults[] = {{GripFault::kNone, ""},
                                                        {GripFault::kNoTouch, "no touch"},
                                                        {GripFault::kNotFelt, "not felt"},
                                                        {GripFault::kPosture, "posture ends"},
                                                        {GripFault::kLimit, "limit"},
                                                        {GripFault::kStop, "joint stop"},
                                                        {GripFault::kCoupling, "coupling"},
                                                        {GripFault::kBalance, "balance"}};
inline const char* NameOf(GripFault fault) { return RowOf(kGripFaults, fault).name; }
inline Json ToJson(GripFault fault) { return NameOf(fault); }
/** @throws Json::exception or Error(kFormat). */
inline void ReadJson(const Json& json, GripFault& fault) {
  fault = RowFromName(kGripFaults, json.get<std::string>(), "grip fault").value;
}

inline constexpr double kGripTolerance = 0.2;  ///< share of the setpoint

struct DigitGripRecord {
  std::string digit;
  bool opposes = false;
  double asked = kUnset;    ///< setpoint [N]
  double closed = kUnset;   ///< force at the start of lift-off [N]
  double held = kUnset;     ///< mean force over the hold [N]; NaN: no hold
  double closing = kUnset;  ///< s at the end
  GripFault fault = GripFault::kNone;
  std::optional<std::string> joint;  ///< joint whose drive, stop or coupling causes `fault`

  template <class V>
  static void ListFields(V&& field) {
    using R = DigitGripRecord;
    field("digit", &R::digit);
    field("opposes", &R::opposes);
    field("asked_n", &R::asked);
    field("closed_n", &R::closed, FieldMayMiss{});
    field("held_n", &R::held, FieldMayMiss{});
    field("closing", &R::closing);
    field("fault", &R::fault);
    field("joint", &R::joint);
  }
};

struct GripRecord {
  double told_weight = 0.0;    ///< object weight given to the controller [N]
  double told_friction = 0.0;  ///< dynamic friction given to it, object and hand; 0: not given
  /** Smallest force of a digit that does not oppose the others with which the contacts bear the
  weight [N]; NaN: none was found, or it was not needed. */
  double smallest = kUnset;
  double force = 0.0;      ///< final setpoint of such a digit [N]
  double asked = kUnset;   ///< setpoint, summed over the hand [N]
  double closed = kUnset;  ///< force at the start of lift-off [N]; NaN: not reached
  double held = kUnset;    ///< mean force over the hold [N]; NaN: no hold
  /** Part of `asked` and `held` of links that touch but do not grasp, such as the palm; NaN:
  none. */
  double rest_asked = kUnset, rest_held = kUnset;
  double peak = 0.0;         ///< largest filtered total force of the trial [N]
  bool was_in_band = false;  ///< stabilisation ended in the band; otherwise by its maximum time
  std::vector<DigitGripRecord> digits;

  template <class V>
  static void ListFields(V&& field) {
    using R = GripRecord;
    field("told_weight_n", &R::told_weight);
    field("told_friction", &R::told_friction);
    field("smallest_n", &R::smallest, FieldMayMiss{});
    field("force_n", &R::force);
    field("asked_n", &R::asked);
    field("closed_n", &R::closed, FieldMayMiss{});
    field("held_n", &R::held, FieldMayMiss{});
    field("rest_asked_n", &R::rest_asked, FieldMayMiss{});
    field("rest_held_n", &R::rest_held, FieldMayMiss{});
    field("peak_n", &R::peak);
    field("was_in_band", &R::was_in_band);
    field("digits", &R::digits);
  }
};

}  // namespace graspbench
