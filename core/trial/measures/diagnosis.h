#pragma once
/** @file
Why a trial failed: the first disturbance, the first loss that mattered, what the others bore then,
and what would have been needed. One answer, kept in the trial's record, so that every page and
command says the same.

The loss that mattered is the part of the hand whose last run of slipping or not touching, up to
the end of the trial, began first; runs interrupted by less than 30 ms are one. Its cause is the
first of these that holds (all limits proposed by graspbench):

    push          a force beyond table and hand above 0.2 N and half the weight; of an object that
                  was lifted while the hand still touched it
    late digit    when another digit first touched, the command of one that had not was behind its
                  by 0.08 of the closing or by half of it; the farthest behind
    low friction  a part that slipped up to then has less than 0.75 of the least friction of the
                  others
    weak digit    some, not all, of the digits had a drive at its limit in most of the 0.3 s before
    no touch      a digit never touched, though it was asked for all of its way before the loss

Then, of a hand that was lifted:

    weak grip     friction, sum mu N, could not bear the weight, which the table no longer bore
    pressed out   it could, but not what the normal forces leave over, |sum N n + m g|; the table
                  bears what of it presses on it
    turned        it could bear both: no lack of force, but their moments did not balance

Of what is left, where two parts press against each other through the object while their summed
normal forces are 0.05 N or more each and more than 110 degrees apart, for 20 ms or longer:

    pushed by a digit     the object moved by more than 5 mm before two parts did
    squeezed out          two parts did when the object was lost, or up to 30 ms before, and the
                          object moved by more than 5 mm
    cause not identified  neither */

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

enum class FailureCause {
  kPush,
  kLateDigit,
  kNoTouch,
  kLowFriction,
  kWeakDigit,
  kPushedByDigit,
  kWeakGrip,
  kPressedOut,
  kTurned,
  kSqueezedOut,
  kNotIdentified,
};
inline constexpr NamedValue<FailureCause> kFailureCauses[] = {
    {FailureCause::kPush, "push"},
    {FailureCause::kLateDigit, "late digit"},
    {FailureCause::kNoTouch, "no touch"},
    {FailureCause::kLowFriction, "low friction"},
    {FailureCause::kWeakDigit, "weak digit"},
    {FailureCause::kPushedByDigit, "pushed by a digit"},
    {FailureCause::kWeakGrip, "weak grip"},
    {FailureCause::kPressedOut, "pressed out"},
    {FailureCause::kTurned, "turned"},
    {FailureCause::kSqueezedOut, "squeezed out"},
    {FailureCause::kNotIdentified, "cause not identified"}};
inline const char* NameOf(FailureCause cause) { return RowOf(kFailureCauses, cause).name; }
inline Json ToJson(FailureCause cause) { return NameOf(cause); }
/** @throws Json::exception or Error(kFormat). */
inline void ReadJson(const Json& json, FailureCause& cause) {
  cause = RowFromName(kFailureCauses, json.get<std::string>(), "cause").value;
}

struct Diagnosis {
  FailureCause cause = FailureCause::kTurned;
  std::string digit;      ///< that is to blame; empty: none alone
  double time = kUnset;   ///< at which the trial began to fail, since the start of placing [s]
  std::string lost;       ///< the part that gave way first for good, a digit or "palm"; empty: none
  double force = kUnset;  ///< it pressed with just before [N]
  double others = kUnset;    ///< the others did [N]
  double bearable = kUnset;  ///< sum mu N of all that touched then [N]
  std::string text;          ///< two or three sentences for a person

  template <class V>
  static void ListFields(V&& field) {
    using D = Diagnosis;
    field("cause", &D::cause);
    field("digit", &D::digit);
    field("time_s", &D::time, FieldMayMiss{});
    field("lost", &D::lost);
    field("force_n", &D::force, FieldMayMiss{});
    field("others_n", &D::others, FieldMayMiss{});
    field("bearable_n", &D::bearable, FieldMayMiss{});
    field("text", &D::text);
  }
};

/** None of a success, and of a trial whose outcome says it all (unreachable, not seen, ..).
@param result  as TableLift::End knows it, with phases, contacts, touches and weight; times since
the start of closure.   @param samples  of the whole trial.
@param closure_start  since the start of placing [s]; NaN: not reached. */
std::optional<Diagnosis> FindDiagnosis(const TrialResult& result,
                                       const std::vector<LoadSample>& samples,
                                       double closure_start);

}  // namespace graspbench
