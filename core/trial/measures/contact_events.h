#pragma once
/** @file
Contacts between the links of the hand and the object, as events of a trial:

    touch     a link touches for the first time
    lost      it has let go; with the normal impulse of the contact that ended
    regained  it touches again
    slip      all of its contacts have begun to slide, faster than 1 mm/s

An event counts if its state lasts for 10 ms, and is dated to the beginning of that state. Shorter
interruptions are chatter of points that roll over edges. */

#include <string>
#include <vector>

#include "core/base/enum_table.h"
#include "core/base/text/json.h"
#include "core/base/text/record_fields.h"
#include "core/base/units.h"
#include "core/hand/hand.h"
#include "core/physics/world.h"

namespace graspbench {

enum class ContactEventKind { kTouch, kLost, kRegained, kSlip };
struct ContactEventRow {
  ContactEventKind value;
  const char* name;
  const char* symbol;  ///< in a strip chart
};
inline constexpr ContactEventRow kContactEvents[] = {{ContactEventKind::kTouch, "touch", "T"},
                                                     {ContactEventKind::kLost, "lost", "L"},
                                                     {ContactEventKind::kRegained, "regained", "R"},
                                                     {ContactEventKind::kSlip, "slip", "S"}};
inline const char* NameOf(ContactEventKind kind) { return RowOf(kContactEvents, kind).name; }
inline Json ToJson(ContactEventKind kind) { return NameOf(kind); }
/** @throws Json::exception or Error(kFormat). */
inline void ReadJson(const Json& json, ContactEventKind& kind) {
  kind = RowFromName(kContactEvents, json.get<std::string>(), "contact event").value;
}

struct ContactEvent {
  double time = 0.0;  ///< [s]
  ContactEventKind kind = ContactEventKind::kTouch;
  std::string digit;        ///< id; "palm" for links of no digit
  std::string link;         ///< name
  double impulse = kUnset;  ///< normal impulse on the object, for "lost" [N s]

  template <class V>
  static void ListFields(V&& field) {
    using E = ContactEvent;
    field("time_s", &E::time, FieldColumn{"s", "since the start of closure"});
    field("kind", &E::kind);
    field("digit", &E::digit, FieldColumn{"", "id of the digit; palm: none"});
    field("link", &E::link, FieldColumn{"", "name of the hand's link"});
    field("impulse_ns", &E::impulse, FieldMayMiss(),
          FieldColumn{"N s", "normal impulse on the object of the touch that was lost"});
  }
};

/** Records the events of a trial. */
class ContactEventRecorder {
 public:
  explicit ContactEventRecorder(const Hand& hand);

  /** Call after every step with its contacts. @param duration  of the step [s]. */
  void Observe(double time, double duration, const std::vector<HandContact>& contacts);

  /** Returns the events by time; for equal times, links in the hand's order. */
  std::vector<ContactEvent> MakeEvents() const;

 private:
  struct LinkState {
    bool is_touching = false, is_sliding = false;  // as of the last event
    double changed_since = kUnset;                 // the contact differs since then; NaN: it does
                                                   // not
    double slides_since = kUnset;
    double impulse = 0.0;  // of the current touch [N s]
    bool has_touched = false;
  };
  void AddEvent(double time, ContactEventKind kind, size_t link, double impulse = kUnset);

  const Hand* hand_;
  std::vector<LinkState> links_;
  std::vector<ContactEvent> events_;
};

/** Monitors the hand's contacts with the object to decide when a trial may take longer steps. While
the object hangs in the hand and its contacts do not change, one step as long as several gives the
same motion. The condition holds if for 50 ms the same links have touched at the same number of
points, none has slid, and the object has moved at most 5 mm/s relative to the hand. At the first
slip, new or lost contact, steps return to the length of the settings.

Limits: events within a long step are detected at its end, at most 10 ms late. The engine's targets
of accuracy are those of its short steps. That the verdicts agree with those of short steps is
measured (workbench/manual/validation/physics.yaml). All limits are proposed by graspbench. */
class SteadyContacts {
 public:
  /** Call after every step. @param duration  of that step [s]   @param slip_speed  by
  CalcSlipSpeed. */
  void Observe(const std::vector<HandContact>& contacts, double table_force, double slip_speed,
               double duration);
  bool are_steady() const { return steady_time_ >= kSteadyTime - 1e-9; }

 private:
  static constexpr double kSteadyTime = 0.05;  // [s]

  std::vector<int> links_;    // by contact, of the last step
  double steady_time_ = 0.0;  // [s]
};

/** Number of steps of the settings' length that a long step replaces. */
int CalcSteadySteps(const SimConfig& config);

}  // namespace graspbench
