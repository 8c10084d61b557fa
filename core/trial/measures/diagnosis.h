#pragma once
/** @file
How a failed trial lost its object: a mechanism with its time and works, stored in the trial's
record. One function formats it as text (diagnosis_text.h), so that all pages and commands agree.

Two parts of the hand, digits or the rest of it, oppose each other if their summed normal forces are
at least 0.05 N each and more than 110 degrees apart, for 20 ms or longer. Runs interrupted by less
than 30 ms are merged. The object is lost at the end of the last run. Works on the object, relative
to the hand, are summed over the last 150 ms of that run (load_recorder.h). If the parts still
oppose each other at the end of the trial, they are summed since lift-off. The mechanism is the
first of these that applies (all limits proposed by graspbench):

    arm at limit    the outcome is "arm overloaded"
    outside push    a force beyond table and hand above 0.2 N and half the weight; for an object
                    that was lifted, while the hand still touched it
    pushed          the object moved by more than 5 mm along the table before two parts opposed, and
                    none did for half a second afterwards; dated to the first touch of the part that
                    pressed most until then
    not reached     no two parts ever opposed
    drive at limit  some, but not all, of the digits had a drive at its limit in most of the 150 ms,
                    and the object sagged or slid as below, or one of these digits gave way: its
                    normal work is negative, and at least half of the work that the other parts'
                    normal forces and gravity did
    squeezed out    the normal forces did more work than gravity and than the hand's friction, and
                    at least the work of a fall by 0.2 mm
    sagged, slid    gravity did more work than the normal forces and than the hand's friction;
                    sagged if the object turned in the hand by more than 15 degrees since two parts
                    first opposed (or since lift-off, if they did until then), otherwise slid
    cause not identified   none of these, e.g. friction dragged the object along */

#include <optional>
#include <string>
#include <vector>

#include "core/base/enum_table.h"
#include "core/base/text/json.h"
#include "core/base/text/record_fields.h"
#include "core/base/units.h"

namespace graspbench {

struct LoadSample;
struct TrialResult;

enum class Mechanism {
  kNotReached,
  kPushed,
  kSqueezedOut,
  kSagged,
  kSlid,
  kDriveAtLimit,
  kArmAtLimit,
  kOutsidePush,
  kNotIdentified,
};
inline constexpr NamedValue<Mechanism> kMechanisms[] = {
    {Mechanism::kNotReached, "not reached"},
    {Mechanism::kPushed, "pushed"},
    {Mechanism::kSqueezedOut, "squeezed out"},
    {Mechanism::kSagged, "sagged"},
    {Mechanism::kSlid, "slid"},
    {Mechanism::kDriveAtLimit, "drive at limit"},
    {Mechanism::kArmAtLimit, "arm at limit"},
    {Mechanism::kOutsidePush, "outside push"},
    {Mechanism::kNotIdentified, "cause not identified"}};
inline const char* NameOf(Mechanism mechanism) { return RowOf(kMechanisms, mechanism).name; }
inline Json ToJson(Mechanism mechanism) { return NameOf(mechanism); }
/** @throws Json::exception or Error(kFormat). */
inline void ReadJson(const Json& json, Mechanism& mechanism) {
  mechanism = RowFromName(kMechanisms, json.get<std::string>(), "mechanism").value;
}

/** Work of a part that touched within the window. */
struct PartWork {
  std::string part;            ///< a digit, or "palm" for the rest of the hand
  double force = 0.0;          ///< largest sum of its normal forces [N]
  double normal_work = 0.0;    ///< [J]
  double friction_work = 0.0;  ///< [J]

  template <class V>
  static void ListFields(V&& field) {
    using P = PartWork;
    field("part", &P::part);
    field("force_n", &P::force);
    field("normal_work_j", &P::normal_work);
    field("friction_work_j", &P::friction_work);
  }
};

struct Diagnosis {
  Mechanism mechanism = Mechanism::kNotIdentified;
  /** The part that did not touch, pushed or gave way. For "squeezed out" the one with the most
  normal work; for "sagged" and "slid" the one along which most friction work was lost; empty:
  none. */
  std::string part;
  /** Joint whose drive is at its limit, of the hand or, for "arm at limit", of the robot arm;
  empty: unknown, or another mechanism. */
  std::string joint;
  std::string phase;  ///< phase in which the object was lost, one of kPhases
  /** Time of the loss since the start of placing [s]. For "pushed" and "outside push" it is their
  beginning; for "sagged" and still in the hand, when the object had turned by the limit. */
  double time = kUnset;
  double opposed_since = kUnset;  ///< when two parts first opposed, likewise [s]; NaN: never
  double shift = kUnset;          ///< largest motion along the table until then, or in all [m]
  double turn = kUnset;           ///< rotation in the hand, see "sagged" [rad]
  double table_share = kUnset;    ///< mean share of the weight on the table in the window
  double push = kUnset;           ///< external force [N]
  double gravity_work = 0.0;      ///< in the window [J]
  std::vector<PartWork> parts;    ///< in the order of digits, palm last

  double CalcNormalWork() const;    ///< of all parts [J]
  double CalcFrictionWork() const;  ///< of all parts [J]

  template <class V>
  static void ListFields(V&& field) {
    using D = Diagnosis;
    field("mechanism", &D::mechanism);
    field("part", &D::part);
    field("joint", &D::joint);
    field("phase", &D::phase);
    field("time_s", &D::time, FieldMayMiss{});
    field("opposed_since_s", &D::opposed_since, FieldMayMiss{});
    field("shift_m", &D::shift, FieldMayMiss{});
    field("turn_rad", &D::turn, FieldMayMiss{});
    field("table_share", &D::table_share, FieldMayMiss{});
    field("push_n", &D::push, FieldMayMiss{});
    field("gravity_work_j", &D::gravity_work);
    field("parts", &D::parts);
  }
};

/** Returns nullopt for a success, and for outcomes that need no diagnosis (unreachable, not seen,
..).
@param result  as known to TableLift::End, with phases, contacts, touches and weight; times since
the start of closure.   @param samples  of the whole trial.
@param closure_start  since the start of placing [s]; NaN: not reached.
@param window  over which works are summed [s]. */
std::optional<Diagnosis> FindDiagnosis(const TrialResult& result,
                                       const std::vector<LoadSample>& samples, double closure_start,
                                       double window = 0.15);

}  // namespace graspbench
