#pragma once
/** @file
The result of a trial. */

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "core/arm/arm_record.h"
#include "core/base/enum_table.h"
#include "core/base/pose.h"
#include "core/base/text/json.h"
#include "core/base/text/json_cursor.h"
#include "core/base/text/record_fields.h"
#include "core/base/units.h"
#include "core/grasp/contact_timing.h"
#include "core/grasp/strategy.h"
#include "core/trial/grip/grip_record.h"
#include "core/trial/measures/contact_events.h"
#include "core/trial/measures/diagnosis.h"
#include "core/trial/measures/opposition.h"
#include "core/trial/measures/stability.h"
#include "core/trial/outcome.h"
#include "core/trial/policy/policy_record.h"
#include "core/trial/touch_sensors.h"

namespace graspbench {

/** Moments of a trial at which the posture is stored, for images and numbers. Each represents a
phase of the strategy: the pre-grasp at the object, the end of stabilisation, the end of the
trial. */
enum class Moment { kPreGrasp, kClosed, kLifted };
struct MomentRow {
  Moment value;
  const char* name;  ///< in records
  Phase phase;       ///< provides its name in options and headings
};
inline constexpr MomentRow kMoments[] = {{Moment::kPreGrasp, "pregrasp", Phase::kPreGrasp},
                                         {Moment::kClosed, "closed", Phase::kStabilisation},
                                         {Moment::kLifted, "lifted", Phase::kHold}};

/** Name of its phase. */
inline const char* NameOf(Moment moment) { return NameOf(RowOf(kMoments, moment).phase); }

inline Json ToJson(Moment moment) { return RowOf(kMoments, moment).name; }
/** @throws Error(kFormat). */
inline void ReadJson(const Json& json, Moment& moment) {
  moment = RowFromName(kMoments, json.get<std::string>(), "moment").value;
}

/** Posture of the whole scene, for images. */
struct SceneSnapshot {
  Moment moment = Moment::kClosed;
  double time = 0.0;  ///< since the start of placing [s]
  Pose X_WH = Pose::Identity();
  Pose X_WO = Pose::Identity();
  Eigen::VectorXd q;  ///< (num_joints) [rad]

  template <class V>
  static void ListFields(V&& field) {
    field("name", &SceneSnapshot::moment);
    field("time_s", &SceneSnapshot::time);
    field("X_WH", &SceneSnapshot::X_WH);
    field("X_WO", &SceneSnapshot::X_WO);
    field("q_rad", &SceneSnapshot::q);
  }
};

/** How a grasping digit touched the object. */
struct DigitTouch {
  double closing = kUnset;       ///< s of the closing law at its first touch; NaN: never touched
  Eigen::VectorXd q;             ///< joints of the hand at that time (num_joints) [rad], or empty
  double smallest_gap = kUnset;  ///< from the object up to lift-off; 0 after a touch [m]; NaN: no
                                 ///< closure

  template <class V>
  static void ListFields(V&& field) {
    field("closing", &DigitTouch::closing);
    field("q_rad", &DigitTouch::q);
    field("smallest_gap_m", &DigitTouch::smallest_gap);
  }
};

struct PhaseStart {
  std::string name;   ///< "placing", "closure", ...
  double time = 0.0;  ///< since the start of closure [s]

  template <class V>
  static void ListFields(V&& field) {
    field("name", &PhaseStart::name);
    field("time_s", &PhaseStart::time);
  }
};

/** @param where  name of the record's field in the message.
@throws Error(kFormat) if several digits oppose the others. */
void CheckOneThumb(const std::vector<DigitContact>& contacts, const char* where);

/** A motion of the object. */
struct Displacement {
  double shift = kUnset;  ///< [m]
  double turn = kUnset;   ///< [rad], in [0, pi]

  template <class V>
  static void ListFields(V&& field) {
    field("shift_m", &Displacement::shift);
    field("turn_rad", &Displacement::turn);
  }
};

/** Value of TrialResult::sight_grasp if the camera did not find the object. */
inline constexpr const char* kNotSeenGrasp = "not seen";

struct TrialResult;
/** Contacts and touches of the grasping digits, one JSON object per digit. */
Json DigitsToJson(const TrialResult& result);
void ReadDigits(const Json& json, TrialResult& result);
void ReadDigitsText(JsonCursor& text, TrialResult& result);

/** To add a field, add a member, a line in ListFields, and the code that computes it. */
struct TrialResult {
  Outcome outcome = Outcome::kNotRun;
  std::string reason;                  ///< one sentence; empty for a success
  std::optional<Diagnosis> diagnosis;  ///< of a failure with contact of hand and object
  std::vector<DigitContact> contacts;  ///< of the grasping digits; times since the start of closure
  std::vector<DigitTouch> touches;     ///< of the same digits
  ContactTiming timing;                ///< with t0 = 0 at the start of closure
  double lift_height = 0.0;            ///< of the object's centre at the end, above rest [m]
  double hold_slip = kUnset;           ///< motion relative to the palm during the hold [m]
  /** Motion in the palm's frame in the second half of the hold: that of the centre of mass plus the
  rotation times the object's radius [m]; NaN: not held to the end. */
  double hold_creep = kUnset;
  double end_speed = 0.0;   ///< relative to the hand at the end, including rotation [m/s]
  double grip_force = 0.0;  ///< sum of normal forces on the object before lift-off [N]
  /** Motion of the object's centre of mass from the first touch to the end of stabilisation [m]:
  rise relative to the palm, displacement in the palm's frame, and distance that it slid through all
  links that touched it at once. NaN: not lifted. See measures/object_in_hand.h. */
  double closure_rise = kUnset, closure_displacement = kUnset, closure_slide = kUnset;
  double object_height = kUnset;       ///< from its lowest to its highest point at the start [m]
  double weight = kUnset;              ///< of the object [N]
  double worst_penetration = 0.0;      ///< deepest finger contact of the whole trial [m]
  double steady_penetration = kUnset;  ///< deepest finger contact at the end of the hold [m]
  Stability stability;
  std::vector<PhaseStart> phases;            ///< those that were reached, in order
  std::vector<ContactEvent> contact_events;  ///< times since the start of closure
  /** If the camera chooses the grasp: id of the grasp chosen, or kNotSeenGrasp. */
  std::optional<std::string> sight_grasp;
  /** Object pose that the hand assumed [m], [rad], in the coordinates of the draw; NaN: the nominal
  pose. The session's positioning tells how it was obtained. */
  double believed_x = kUnset, believed_y = kUnset, believed_yaw = kUnset;
  std::optional<Opposition> opposition;  ///< at the end, if the object is held
  std::optional<ArmRecord> arm;          ///< if there is an arm
  std::optional<GripRecord> grip;        ///< if the grip is regulated
  std::optional<PolicyRecord> policy;    ///< if there is a controller
  std::optional<TouchRecord> touch;      ///< if the trial uses sensed touch
  std::optional<Displacement> closing;   ///< until the last digit touched; only on request
  /** Only on request: the smallest of six pulls that take the held object out of the hand while its
  grip is regulated further (judge.h). Negative for a lost object: m g times the share of lift-off
  and hold in which the hand no longer touched it [N]. */
  std::optional<double> strength;
  double energy_residual = 0.0;  ///< unexplained energy of the whole trial [J]
  int num_steps = 0;
  int num_unconverged = 0;      ///< steps whose solve did not reach its tolerance
  double simulated_time = 0.0;  ///< [s]
  std::vector<SceneSnapshot> snapshots;

  template <class V>
  static void ListFields(V&& field) {
    using R = TrialResult;
    field("outcome", &R::outcome);
    field("reason", &R::reason);
    field("diagnosis", &R::diagnosis);
    field("contacts", &DigitsToJson, &ReadDigits, &ReadDigitsText);
    field("lift_height_m", &R::lift_height,
          FieldColumn{"m", "height of the object's centre above rest at the end"});
    field("hold_slip_m", &R::hold_slip,
          FieldColumn{"m", "motion of the object relative to the palm while held"});
    field("hold_creep_m", &R::hold_creep,
          FieldColumn{"m",
                      "motion of the object in the palm's frame in the second half of the hold"});
    field("end_speed_m_per_s", &R::end_speed,
          FieldColumn{"m/s", "speed of the object against the hand at the end, turning included"});
    field("grip_force_n", &R::grip_force,
          FieldColumn{"N",
                      "true sum of the hand's normal forces on the object before lift-off, "
                      "whatever its elements feel"});
    field("closure_rise_m", &R::closure_rise, FieldMayMiss{},
          FieldColumn{"m",
                      "rise of the object in the hand from the first touch to the end of "
                      "stabilisation"});
    field("closure_displacement_m", &R::closure_displacement, FieldMayMiss{},
          FieldColumn{"m", "in-hand displacement of the object in the same time"});
    field("closure_slide_m", &R::closure_slide, FieldMayMiss{},
          FieldColumn{"m",
                      "how far the object slid through all links that touched it at once, in the "
                      "same time"});
    field("object_height_m", &R::object_height, FieldMayMiss{},
          FieldColumn{"m", "height of the object at the start"});
    field("weight_n", &R::weight, FieldMayMiss{}, FieldColumn{"N", "weight of the object"});
    field("worst_penetration_m", &R::worst_penetration,
          FieldColumn{"m", "deepest finger contact of the whole trial"});
    field("steady_penetration_m", &R::steady_penetration,
          FieldColumn{"m", "deepest finger contact at the end of the hold"});
    field("stability", &R::stability);
    field("phases", &R::phases);
    field("contact_events", &R::contact_events);
    field("sight_grasp", &R::sight_grasp);
    field("believed_x_m", &R::believed_x, FieldMayMiss{});
    field("believed_y_m", &R::believed_y, FieldMayMiss{});
    field("believed_yaw_rad", &R::believed_yaw, FieldMayMiss{});
    field("opposition_type", &R::opposition);
    field("arm", &R::arm);
    field("grip", &R::grip);
    field("policy", &R::policy);
    field("touch", &R::touch);
    field("closing_displacement", &R::closing);
    field("strength_n", &R::strength);
    field("energy_residual_j", &R::energy_residual,
          FieldColumn{"J", "energy of the whole trial that nothing explains"});
    field("num_steps", &R::num_steps, FieldColumn{"", "simulation steps"});
    field("num_unconverged", &R::num_unconverged,
          FieldColumn{"", "steps whose solve did not reach its tolerance"});
    field("simulated_time_s", &R::simulated_time, FieldColumn{"s", "length of the trial"});
    field("snapshots", &R::snapshots);
  }
};

/** Order of the first contacts. The motion within a step is only interpolated, so contacts less
than a step of the physics apart are tied. */
ContactOrder FindContactOrder(const TrialResult& result);

Json ToJson(const TrialResult& result);
TrialResult TrialResultFromJson(const Json& json);
/** Reads the result from its JSON text; errors as in record_fields.h. */
TrialResult ReadTrialResultText(JsonCursor& text);

}  // namespace graspbench
