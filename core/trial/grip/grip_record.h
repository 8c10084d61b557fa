#pragma once
/** @file
What a trial says of its regulated grip: what was asked, what came of it, and why a digit never had
its force. Forces are sums of normal forces, those of the hold means over it. */

#include <optional>
#include <string>
#include <vector>

#include "core/base/enum_table.h"
#include "core/base/text/json.h"
#include "core/base/text/record_fields.h"
#include "core/base/units.h"

namespace graspbench {

/** Why a digit's force differs from what was asked by more than kGripTolerance. */
enum class GripFault {
  kNone,
  kNoTouch,   ///< it never touched
  kNotFelt,   ///< neither elements nor drives say its force, or say it wrongly by so much
  kPosture,   ///< it is at its target posture
  kLimit,     ///< a drive of it is at its torque limit
  kStop,      ///< a driven joint of it is at its stop, which bears what its drive gives
  kCoupling,  ///< a coupled joint of it is at its stop
  kBalance    ///< statics give the force to others, or others' to it
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

inline constexpr double kGripTolerance = 0.2;  ///< share of the force asked

struct DigitGripRecord {
  std::string digit;
  bool opposes = false;
  double asked = kUnset;    ///< [N]
  double closed = kUnset;   ///< at the start of lift-off [N]
  double held = kUnset;     ///< mean over the hold [N]; NaN: none
  double closing = kUnset;  ///< s at the end
  GripFault fault = GripFault::kNone;
  std::optional<std::string> joint;  ///< whose drive, stop or coupling `fault` means

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
  double told_weight = 0.0;    ///< of the object, as the hand is told [N]
  double told_friction = 0.0;  ///< dynamic, between it and the hand, likewise; 0: it is not told
  /** The smallest with which the contacts bear the weight, of a digit that does not oppose the
  others; NaN: none was found, or nobody asked [N]. */
  double smallest = kUnset;
  double force = 0.0;      ///< asked of such a digit in the end [N]
  double asked = kUnset;   ///< sum over the hand [N]
  double closed = kUnset;  ///< at the start of lift-off [N]; NaN: not reached
  double held = kUnset;    ///< mean over the hold [N]; NaN: none
  /** The part of `asked` and `held` of what does not grasp but touches, as the palm; NaN: none. */
  double rest_asked = kUnset, rest_held = kUnset;
  double peak = 0.0;         ///< of the filtered sum, of the whole trial [N]
  bool was_in_band = false;  ///< what ended stabilisation; else its longest time
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
