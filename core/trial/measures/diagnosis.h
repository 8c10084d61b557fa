#pragma once
/** @file
How a failed trial lost its object: a mechanism with its time and works, kept in the trial's record.
The words for it are one function (diagnosis_text.h), so that every page and command says the same.

Two parts of the hand, digits or the rest of it, oppose each other while their summed normal forces
are 0.05 N or more each and more than 110 degrees apart, for 20 ms or longer; runs interrupted by
less than 30 ms are one. The object is lost at the end of their last run. Works on the object,
relative to the hand, are summed over the run's last 150 ms (load_recorder.h); of one that is still
between them at the end of the trial, over all of the time since lift-off. The mechanism is the
first of these that holds (all limits proposed by graspbench):

    arm at limit    the outcome is "arm overloaded"
    outside push    a force beyond table and hand above 0.2 N and half the weight; of an object that
                    was lifted while the hand still touched it
    pushed          the object moved by more than 5 mm along the table before two parts opposed, and
                    none did for half a second afterwards; dated by the first touch of the part that
                    pressed most until then
    not reached     no two parts ever opposed
    drive at limit  some, not all, of the digits had a drive at its limit in most of the 150 ms, and
                    the object sagged or slid as below, or one of them gave way: its normal work is
                    negative, and at least half of what the other parts' normal forces and gravity
                    did
    squeezed out    the normal forces did more work than gravity and than the friction of the hand,
                    and that of 0.2 mm of fall or more
    sagged, slid    gravity did the more work; the object turned in the hand by more than 15 degrees
                    since two parts first opposed (since lift-off, where they did then), or not
    cause not identified   neither, as where friction dragged it along */

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

/** Of a part that touched in the window of the works. */
struct PartWork {
  std::string part;            ///< a digit or "palm", which is the rest of the hand
  double force = 0.0;          ///< largest sum of normal forces [N]
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
  /** That did not touch, pushed or gave way; of "squeezed out" with the most normal work, of
  "sagged" and "slid" the one along which most friction was lost; empty: none. */
  std::string part;
  /** Of the hand or, of "arm at limit", of its robot arm, whose drive is at its limit; empty: not
  known, or another mechanism. */
  std::string joint;
  std::string phase;  ///< in which the object was lost, of kPhases
  /** At which it was, since the start of placing; of "pushed" and "outside push" when that began, of
  "sagged" and still in the hand when it had turned so far [s]. */
  double time = kUnset;
  double opposed_since = kUnset;  ///< two parts first opposed, since the same start; NaN: never [s]
  double shift = kUnset;          ///< along the table until then, without it the largest [m]
  double turn = kUnset;           ///< in the hand, see "sagged" [rad]
  double table_share = kUnset;    ///< of the weight, that the table bore on average in the window
  double push = kUnset;           ///< from outside [N]
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

/** None of a success, and of a trial whose outcome says it all (unreachable, not seen, ..).
@param result  as TableLift::End knows it, with phases, contacts, touches and weight; times since
the start of closure.   @param samples  of the whole trial.
@param closure_start  since the start of placing [s]; NaN: not reached.
@param window  over which works are summed [s]. */
std::optional<Diagnosis> FindDiagnosis(const TrialResult& result,
                                       const std::vector<LoadSample>& samples, double closure_start,
                                       double window = 0.15);

}  // namespace graspbench
