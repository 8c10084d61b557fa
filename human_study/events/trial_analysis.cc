#include "human_study/events/trial_analysis.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "core/base/config.h"
#include "core/base/error.h"
#include "human_study/events/doubts/plausibility.h"

namespace graspbench {
namespace {

/** Of every number the range that its listing states. */
class RangeCheck {
 public:
  explicit RangeCheck(const char* group = "") : group_(group) {}

  template <class T>
  void operator()(const char* key, T& value, const KeyInfo& info = {}) const {
    if constexpr (internal::HasVisit<T>::value) {
      value.Visit(RangeCheck(key));
    } else if constexpr (std::is_same_v<T, double>) {
      const bool has_limit = std::isfinite(info.low) || std::isfinite(info.high);
      const bool is_in_range = std::isfinite(value) && value >= info.low && value <= info.high;
      if (!has_limit || is_in_range) return;
      const FileKey row(std::string(group_) + "." + key, "", "", info.low, info.high);
      throw Error(ErrorKind::kRange,
                  fmt::format("{} is {:g}; expected {}", row.key, value, FormatRange(row)));
    }
  }

 private:
  const char* group_;
};

void CheckUp(const LiftOffOptions& lift_off) {
  const double length = std::hypot(lift_off.up_x, lift_off.up_y, lift_off.up_z);
  if (length > 0.0 && std::isfinite(length)) return;
  throw Error(ErrorKind::kRange,
              fmt::format("lift_off.up_z is {:g}, up_x {:g} and up_y {:g}, which is no direction; "
                          "expected the one of the lift in the recording, for instance up_z: 1",
                          lift_off.up_z, lift_off.up_x, lift_off.up_y));
}

struct CutoffKey {
  const char* key;
  double& (*of)(AnalysisOptions& options);
};

constexpr CutoffKey kCutoffs[] = {
    {"movement.cutoff_hz", [](AnalysisOptions& o) -> double& { return o.movement.cutoff; }},
    {"hold.cutoff_hz", [](AnalysisOptions& o) -> double& { return o.hold.cutoff; }},
    {"opening.cutoff_hz", [](AnalysisOptions& o) -> double& { return o.opening.cutoff; }},
    {"contact.cutoff_hz", [](AnalysisOptions& o) -> double& { return o.contact.cutoff; }},
    {"contact.object_cutoff_hz",
     [](AnalysisOptions& o) -> double& { return o.contact.object_cutoff; }},
    {"lift_off.cutoff_hz", [](AnalysisOptions& o) -> double& { return o.lift_off.cutoff; }},
};

/** Path whose speed is the movement's: the wrist, else the centroid of the tips. */
Trajectory FindTransport(const ReachTrial& trial) {
  if (trial.wrist.size() > 0) return trial.wrist;
  Trajectory centroid = trial.digits[0].tip;
  for (size_t d = 1; d < trial.digits.size(); ++d) {
    const Trajectory& tip = trial.digits[d].tip;
    centroid.p += tip.p;  // NaN where one is hidden
    for (size_t i = 0; i < centroid.size(); ++i) {
      centroid.states[i] = CombineStates(centroid.states[i], tip.states[i]);
    }
  }
  centroid.p /= static_cast<double>(trial.digits.size());
  return centroid;
}

std::vector<DigitContactEvents> ListMissingContacts(const ReachTrial& trial,
                                                    const std::string& reason) {
  std::vector<DigitContactEvents> contacts;
  for (const DigitTrack& digit : trial.digits) {
    DigitContactEvents& events = contacts.emplace_back();
    events.digit = digit.digit;
    events.is_thumb = digit.is_thumb;
    events.contact = MissingEvent(reason);
    events.by_detector.assign(ContactDetectorList().size(), events.contact);
    events.fit.missing = reason;
  }
  return contacts;
}

ContactTiming CalcTiming(const std::vector<DigitContactEvents>& contacts, double t0,
                         bool with_missing) {
  std::vector<DigitContact> times;
  for (const DigitContactEvents& contact : contacts) {
    // Of a digit that touched at an unknown instant nobody knows whether it was first or last.
    if (IsUnresolved(contact.contact)) return CalcContactTiming({}, t0);
    if (contact.contact.IsFound() || with_missing) {
      times.push_back({contact.digit, contact.is_thumb, contact.contact.time});
    }
  }
  if (times.size() < 2) times.clear();  // one digit is no grasp: nothing to be simultaneous with
  return CalcContactTiming(times, t0);
}

ContactOrder FindOrder(const std::vector<DigitContactEvents>& contacts) {
  std::vector<DigitContact> times;
  std::vector<double> uncertainties;
  for (const DigitContactEvents& contact : contacts) {
    const bool is_found = contact.contact.IsFound();
    times.push_back({contact.digit, contact.is_thumb, is_found ? contact.contact.time : kUnset});
    uncertainties.push_back(contact.contact.uncertainty);
  }
  return FindContactOrder(times, uncertainties);
}

void CalcUncertainties(TrialAnalysis& analysis) {
  const EventTime *first = nullptr, *last = nullptr, *thumb = nullptr, *first_finger = nullptr;
  for (const DigitContactEvents& digit : analysis.contacts) {
    const EventTime& contact = digit.contact;
    if (!contact.IsFound()) continue;
    if (!first || contact.time < first->time) first = &contact;
    if (!last || contact.time > last->time) last = &contact;
    if (digit.is_thumb) {
      thumb = &contact;
    } else if (!first_finger || contact.time < first_finger->time) {
      first_finger = &contact;
    }
  }
  /** Of a time that rests on two instants; NaN when the time is missing. */
  const auto combine = [](double time, const EventTime* a, const EventTime* b) {
    return a && b && !std::isnan(time) ? std::hypot(a->uncertainty, b->uncertainty) : std::nan("");
  };
  analysis.gft_uncertainty = combine(analysis.timing.gft, first, last);
  analysis.got_uncertainty = combine(analysis.timing.got, thumb, first_finger);
  analysis.gct_uncertainty = combine(analysis.timing.gct, &analysis.closure_start, last);
}

void NoteWeakEvents(TrialAnalysis& analysis) {
  std::vector<const EventTime*> used = {&analysis.movement.onset, &analysis.movement.end,
                                        &analysis.closure_start, &analysis.object.lift_off};
  for (const DigitContactEvents& digit : analysis.contacts) used.push_back(&digit.contact);
  analysis.used_filled = analysis.used_gap = false;
  for (const EventTime* event : used) {
    analysis.used_filled |= event->IsFound() && event->is_filled;
    analysis.used_gap |= event->IsFound() && event->is_in_gap;
  }
}

double FindFirstContact(const std::vector<DigitContactEvents>& contacts) {
  double first = std::nan("");
  for (const DigitContactEvents& digit : contacts) {
    if (digit.contact.IsFound() && !(digit.contact.time >= first)) first = digit.contact.time;
  }
  return first;
}

/** From when on contacts are looked for. */
double FindBegin(const TrialAnalysis& analysis) {
  const EventTime& onset = analysis.movement.onset;
  return onset.IsFound() ? onset.time : analysis.opening.times.front();
}

/** The way back comes after it. */
double FindReachEnd(const TrialAnalysis& analysis) {
  return analysis.hold.IsFound() ? analysis.hold.time : analysis.opening.times.back();
}

/** What follows from the contacts that are believed. */
void CalcMeasures(const AnalysisOptions& options, TrialAnalysis& analysis) {
  CoverDisagreement(options.plausibility.max_disagreement, options.contact, analysis.contacts);
  analysis.peak_opening =
      FindPeakOpening(analysis.opening, FindBegin(analysis), FindFirstContact(analysis.contacts),
                      FindReachEnd(analysis), options.opening.min_prominence);
  const bool is_largest = options.opening.maximum == "largest";
  const PeakOpening& peak = analysis.peak_opening;
  analysis.closure_start = is_largest ? peak.largest : peak.last;
  analysis.closure_start_value = is_largest ? peak.largest_value : peak.last_value;

  analysis.order = FindOrder(analysis.contacts);
  analysis.num_touching = static_cast<int>(
      std::count_if(analysis.contacts.begin(), analysis.contacts.end(),
                    [](const DigitContactEvents& digit) { return digit.contact.IsFound(); }));
  analysis.num_unverified = static_cast<int>(std::count_if(
      analysis.contacts.begin(), analysis.contacts.end(), [](const DigitContactEvents& digit) {
        return digit.contact.IsFound() && !digit.is_verified;
      }));
  analysis.num_unresolved = static_cast<int>(
      std::count_if(analysis.contacts.begin(), analysis.contacts.end(),
                    [](const DigitContactEvents& digit) { return IsUnresolved(digit.contact); }));
  analysis.final_opening = analysis.num_unresolved > 0
                               ? std::nan("")
                               : ValueNear(analysis.opening, FindLastContact(analysis.contacts));
  const double touched = analysis.num_unresolved > 0 ? kUnset : FindLastContact(analysis.contacts);
  const HandCourse& hand = *analysis.hand;
  analysis.plane_residual = ValueNear(hand.plane, touched);
  analysis.meeting_residual =
      CalcMedianMeeting(hand, analysis.closure_start.time, FindFirstContact(analysis.contacts));
  analysis.axis_turn = CalcAxisTurn(hand, analysis.movement.onset.time, touched);
  analysis.axis_settled = FindAxisSettling(hand, analysis.movement.onset.time, touched);
  analysis.closes_on = analysis.final_opening - ValueNear(analysis.opening, analysis.hold.time);
  analysis.timing = CalcTiming(analysis.contacts, analysis.closure_start.time, false);
  analysis.timing_all = CalcTiming(analysis.contacts, analysis.closure_start.time, true);
  std::vector<DigitContactEvents> first_touches = analysis.contacts;
  for (DigitContactEvents& digit : first_touches) {
    if (digit.regrasp.IsFound()) digit.contact = digit.regrasp.first_touch;
  }
  analysis.timing_first = CalcTiming(first_touches, analysis.closure_start.time, false);
  CalcUncertainties(analysis);
  NoteWeakEvents(analysis);
  analysis.doubts = analysis.trial_doubts;
  for (Doubt& doubt : FindContactDoubts(analysis.contacts, analysis.movement, analysis.object,
                                        analysis.timing.gct, options.plausibility)) {
    analysis.doubts.push_back(std::move(doubt));
  }
}

/** The contacts; none when an unseen object was carried. */
void FindTrialContacts(FilteredTrial& filtered, const ObjectTravel& travel,
                       const AnalysisOptions& options, TrialAnalysis& analysis) {
  const ReachTrial& trial = filtered.trial();
  if (!trial.object.IsRecorded()) {
    for (Doubt& doubt : FindUnseenCarrying(filtered.FilterTips(options.contact.cutoff),
                                           analysis.hold, options.plausibility)) {
      analysis.contacts = ListMissingContacts(trial, doubt.text);
      analysis.trial_doubts.push_back(std::move(doubt));
      return;
    }
  }
  if (!analysis.hold.IsFound()) {
    analysis.contacts = ListMissingContacts(trial, "no hold");
    return;
  }
  const ContactEvidence evidence =
      MakeContactEvidence(filtered, analysis.opening, travel.displacement, FindBegin(analysis),
                          analysis.hold, options.contact);
  analysis.contacts = FindContacts(evidence, options.contact);
  for (Doubt& doubt : FindWrongShape(analysis.contacts, analysis.object.lift_off.IsFound(),
                                     options.plausibility)) {
    analysis.trial_doubts.push_back(std::move(doubt));
  }
}

/** Found instants' difference; NaN when one is missing, as its time is NaN. */
double Between(const EventTime& from, const EventTime& to) { return to.time - from.time; }

}  // namespace

void CheckOptions(const AnalysisOptions& options) {
  FindMovementRule(options.movement.rule);
  FindHoldRule(options.hold.rule);
  FindContactDetector(options.contact.detector);
  FindHandOpening(options.opening.measure);
  std::vector<std::string> lift_rules;
  for (const LiftOffRule& rule : LiftOffRuleList()) lift_rules.push_back(rule.id);
  const std::string& lift = options.lift_off.rule;
  if (std::find(lift_rules.begin(), lift_rules.end(), lift) == lift_rules.end()) {
    throw Error(ErrorKind::kNotFound,
                "no lift-off rule \"" + lift + "\"" + SuggestNames(lift, lift_rules));
  }
  const std::string& maximum = options.opening.maximum;
  if (maximum != "largest" && maximum != "last") {
    throw Error(ErrorKind::kNotFound, "opening.maximum is \"" + maximum + "\"" +
                                          SuggestNames(maximum, {"largest", "last"}));
  }
  AnalysisOptions copy = options;
  copy.Visit(RangeCheck());
  CheckUp(options.lift_off);
}

Cutoffs ListCutoffs(AnalysisOptions options) {
  Cutoffs cutoffs;
  for (const CutoffKey& cutoff : kCutoffs) cutoffs.emplace_back(cutoff.key, cutoff.of(options));
  return cutoffs;
}

double FitCutoff(const AnalysisOptions& options, const std::string& key, double cutoff,
                 double rate) {
  if (options.stated_cutoffs.count(key) > 0) return cutoff;
  return std::fmin(cutoff, kMaxCutoffShare * rate);  // a rate that is NaN changes nothing
}

AnalysisOptions FitCutoffs(AnalysisOptions options, double rate) {
  for (const CutoffKey& cutoff : kCutoffs) {
    cutoff.of(options) = FitCutoff(options, cutoff.key, cutoff.of(options), rate);
  }
  return options;
}

std::string FindCutoffFault(const Cutoffs& cutoffs, double rate) {
  constexpr double kSurely = 0.999;  // two ways to count a recording's rate differ by less
  const double limit = 0.4 * rate;   // as MakeLowPass
  std::string found;
  for (const auto& [key, cutoff] : cutoffs) {
    if (cutoff < kSurely * limit) continue;
    found += fmt::format("{}{} is {:.6g}", found.empty() ? "" : ", ", key, cutoff);
  }
  if (found.empty()) return "";
  return fmt::format(
      "{}; this recording of {:.6g} Hz allows less than {:.6g}. Choose a lower one, or leave the "
      "key out: the cut-off then follows the rate",
      found, rate, limit);
}

double CalcRate(const ReachTrial& trial) {
  return static_cast<double>(trial.times.size() - 1) / (trial.times.back() - trial.times.front());
}

double FindLastContact(const std::vector<DigitContactEvents>& contacts) {
  double last = std::nan("");
  for (const DigitContactEvents& digit : contacts) {
    if (digit.contact.IsFound() && !(digit.contact.time <= last)) last = digit.contact.time;
  }
  return last;
}

TrialAnalysis AnalyseTrial(FilteredTrial& filtered, const AnalysisOptions& options) {
  CheckOptions(options);
  const ReachTrial& trial = filtered.trial();
  const std::string fault = FindCutoffFault(ListCutoffs(options), CalcRate(trial));
  if (!fault.empty()) throw Error(ErrorKind::kRange, fault);
  TrialAnalysis analysis;
  analysis.low_pass = trial.low_pass;
  analysis.trial_doubts = FindFrameJump(trial);
  for (Doubt& doubt : FindWrongUnit(trial.digits)) analysis.trial_doubts.push_back(doubt);
  for (const auto& find : {FindHandCentred, FindNoMovement, FindLabelJump}) {
    for (Doubt& doubt : find(trial.digits)) analysis.trial_doubts.push_back(std::move(doubt));
  }

  ObjectTravel travel;
  if (trial.object.IsRecorded()) {
    travel = CalcObjectTravel(trial, options.lift_off);
    analysis.object = FindObjectEvents(travel, options.lift_off);
    for (Doubt& doubt :
         FindOtherLiftAxis(travel, analysis.object, options.lift_off, options.plausibility)) {
      analysis.trial_doubts.push_back(std::move(doubt));
    }
  } else {
    analysis.object.moved = analysis.object.lift_off = MissingEvent("the object was not recorded");
  }
  const EventTime& lift_off = analysis.object.lift_off;

  const Trajectory transport = FindTransport(trial);
  analysis.opening =
      CalcOpeningCurve(filtered, FindHandOpening(options.opening.measure), options.opening.cutoff);
  analysis.hold = lift_off.IsFound() ? MakeLiftedHold(lift_off.time)
                                     : FindHold(filtered, transport, analysis.opening, options.hold,
                                                options.contact.object_cutoff);

  analysis.speed = CalcSpeed(Smooth(transport, options.movement.cutoff));
  analysis.movement =
      FindMovement(analysis.speed, trial.times.front(), FindReachEnd(analysis), options.movement);
  analysis.phases = FindPhases(analysis.speed, analysis.movement);
  const std::vector<SmoothPath>& tips = filtered.FilterTips(options.hold.cutoff);
  analysis.hand = filtered.FollowHand(options.hold.cutoff);
  if (trial.object.IsRecorded() && !lift_off.IsFound()) {
    for (Doubt& doubt :
         FindLeftBehind(tips, travel, analysis.hold, options.lift_off, options.plausibility)) {
      analysis.trial_doubts.push_back(std::move(doubt));
    }
  }
  analysis.may_be_exchanged =
      MayBeExchanged(trial.digits, tips, trial.wrist, analysis.movement.onset.time, analysis.hold);
  if (trial.object.IsRecorded()) {
    analysis.goes_elsewhere_first = GoesElsewhereFirst(travel, lift_off, options.lift_off);
  }
  for (Doubt& doubt : FindSwappedThumb(trial.digits, tips, analysis.hold)) {
    analysis.trial_doubts.push_back(std::move(doubt));
  }
  FindTrialContacts(filtered, travel, options, analysis);
  CalcMeasures(options, analysis);
  return analysis;
}

TrialAnalysis AnalyseTrial(const ReachTrial& trial, const AnalysisOptions& options) {
  FilteredTrial filtered(trial);
  return AnalyseTrial(filtered, options);
}

void BelieveDetector(const std::string& detector, const AnalysisOptions& options,
                     TrialAnalysis& analysis) {
  const size_t believed = FindContactDetector(detector);
  for (DigitContactEvents& digit : analysis.contacts) {
    if (!digit.is_reviewed) digit.contact = digit.by_detector[believed];
  }
  CalcMeasures(options, analysis);
}

void RecalcMeasures(const AnalysisOptions& options, TrialAnalysis& analysis) {
  CalcMeasures(options, analysis);
}

namespace {

/** GOT with its sign. */
double CalcOpposingLag(const TrialAnalysis& analysis) {
  double first = std::numeric_limits<double>::quiet_NaN();
  for (size_t d = 1; d < analysis.contacts.size(); ++d) {
    const EventTime& contact = analysis.contacts[d].contact;
    if (contact.IsFound()) first = std::fmin(first, contact.time);
  }
  const EventTime& thumb = analysis.contacts.front().contact;
  return thumb.IsFound() ? first - thumb.time : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

const std::vector<TrialMeasure>& TrialMeasureList() {
  using A = TrialAnalysis;
  static const std::vector<TrialMeasure> measures = {
      {"grasp_forming_time_s", "grasp forming time (GFT)", "s",
       [](const A& a) { return a.timing.gft; }},
      {"grasp_opposing_time_s", "grasp opposing time (GOT)", "s",
       [](const A& a) { return a.timing.got; }},
      {"grasp_closure_time_s", "grasp closure time (GCT)", "s",
       [](const A& a) { return a.timing.gct; }},
      {"grasp_forming_ratio", "GFT / GCT (GFT%)", "1",
       [](const A& a) { return a.timing.gft_ratio; }},
      {"grasp_opposing_ratio", "GOT / GCT (GOT%)", "1",
       [](const A& a) { return a.timing.got_ratio; }},
      {"opposing_lag_s", "thumb's contact to the first of the fingers; negative: a finger first",
       "s", CalcOpposingLag},
      {"grasp_forming_time_all_s", "GFT of all digits", "s",
       [](const A& a) { return a.timing_all.gft; }},
      {"grasp_forming_time_first_s", "GFT of first touches (GFT is of lasting touches)", "s",
       [](const A& a) { return a.timing_first.gft; }},
      {"grasp_closure_time_all_s", "GCT of all digits", "s",
       [](const A& a) { return a.timing_all.gct; }},
      {"grasp_forming_ratio_all", "GFT / GCT of all digits", "1",
       [](const A& a) { return a.timing_all.gft_ratio; }},
      {"touching_digits", "digits that touched", "",
       [](const A& a) { return static_cast<double>(a.num_touching); }},
      {"contact_ties", "neighbours in the order of contact whose instants are not resolved", "",
       [](const A& a) { return static_cast<double>(a.order.num_ties); }},
      {"peak_opening_m", "peak opening", "m", [](const A& a) { return a.closure_start_value; }},
      {"time_to_peak_opening_s", "onset to peak opening", "s",
       [](const A& a) { return Between(a.movement.onset, a.closure_start); }},
      {"relative_time_to_peak_opening", "onset to peak opening / movement time", "1",
       [](const A& a) {
         return Between(a.movement.onset, a.closure_start) /
                Between(a.movement.onset, a.movement.end);
       }},
      {"closure_time_s", "peak opening to end of movement", "s",
       [](const A& a) { return Between(a.closure_start, a.movement.end); }},
      {"final_opening_m", "opening at the last contact", "m",
       [](const A& a) { return a.final_opening; }},
      {"movement_time_s", "movement time", "s",
       [](const A& a) { return Between(a.movement.onset, a.movement.end); }},
      {"onset_lag_s",
       "extrapolated start of the movement to its onset: how late the onset's rule is, and by how "
       "much every time from the onset is too short",
       "s", [](const A& a) { return Between(a.movement.start, a.movement.onset); }},
      {"peak_speed_m_per_s", "peak speed of the wrist", "m/s",
       [](const A& a) { return a.movement.peak_speed; }},
      {"time_to_peak_speed_s", "onset to peak speed", "s",
       [](const A& a) { return a.movement.peak_time - a.movement.onset.time; }},
      {"high_velocity_phase_s", "onset to re-acceleration (high-velocity phase)", "s",
       [](const A& a) { return Between(a.movement.onset, a.phases.reacceleration); }},
      {"low_velocity_phase_s", "re-acceleration to end (low-velocity phase)", "s",
       [](const A& a) { return Between(a.phases.reacceleration, a.movement.end); }},
      {"relative_reacceleration", "onset to re-acceleration / movement time", "1",
       [](const A& a) {
         return Between(a.movement.onset, a.phases.reacceleration) /
                Between(a.movement.onset, a.movement.end);
       }},
      {"reacceleration_to_peak_opening_s", "re-acceleration to peak opening", "s",
       [](const A& a) { return Between(a.phases.reacceleration, a.closure_start); }},
      {"contact_to_lift_s", "last contact to lift-off", "s",
       [](const A& a) { return a.object.lift_off.time - FindLastContact(a.contacts); }},
      {"tip_plane_residual_m",
       "distance of the tips from one plane at the last contact, four digits or more (RMS)", "m",
       [](const A& a) { return a.plane_residual; }},
      {"tip_meeting_residual_m",
       "distance of the digits' courses from one point while they close (RMS)", "m",
       [](const A& a) { return a.meeting_residual; }},
      {"axis_turn_rad", "turn of the opposition axis from the onset to the last contact", "rad",
       [](const A& a) { return a.axis_turn; }},
      {"axis_settling_time_s",
       "onset until the opposition axis stays within 5 deg of that at the last contact", "s",
       [](const A& a) { return a.axis_settled - a.movement.onset.time; }},
  };
  return measures;
}

}  // namespace graspbench
