#pragma once
/** @file
Everything about one trial: events, then measures. The same options give the same numbers for every
trial of a study, and one multiverse is the same trials under other options.

Order: object (moved, lifted) -> hold (the lift-off, or where the hand rests at the object) ->
movement (onset, end, before the hold) -> contacts (between onset and hold) -> widest opening ->
measures. */

#include <limits>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/base/file_keys.h"
#include "core/grasp/contact_timing.h"
#include "human_study/events/contact_detector.h"
#include "human_study/events/doubts/plausibility.h"
#include "human_study/events/hand_course.h"
#include "human_study/events/hand_opening.h"
#include "human_study/events/hold.h"
#include "human_study/events/movement.h"
#include "human_study/events/reach_trial.h"

namespace graspbench {

struct OpeningOptions {
  std::string measure = kDefaultHandOpening;  ///< an id of HandOpeningList()
  std::string maximum = "largest";            ///< start of closure: "largest" or "last"
  double cutoff = 10.0;                       ///< [Hz]
  double min_prominence = 0.003;              ///< of a last maximum [m]

  template <class V>
  void Visit(V&& v) {
    v("measure", measure, "of the hand");
    v("maximum", maximum, "start of the closure: largest or last");
    v("cutoff_hz", cutoff,
      {"cut-off of the zero-phase filter on the tips; unless stated, at most 0.34 of the "
       "recording's rate",
       kAboveZero});
    v("min_prominence_m", min_prominence, {"of a last maximum", kAboveZero});
  }
};

struct AnalysisOptions {
  MovementOptions movement;
  LiftOffOptions lift_off;
  HoldOptions hold;
  OpeningOptions opening;
  ContactOptions contact;
  PlausibilityOptions plausibility;
  /** Keys of the cut-offs that a user stated: they stay as they are, the others follow the rate
  (FitCutoffs). No setting. */
  std::set<std::string> stated_cutoffs;

  template <class V>
  void Visit(V&& v) {
    v("movement", movement);
    v("lift_off", lift_off);
    v("hold", hold);
    v("opening", opening);
    v("contact", contact);
    v("plausibility", plausibility);
  }
};

/** @throws Error(kNotFound) for an unknown rule, detector or measure, Error(kRange) for a number
outside its range; both name the key. */
void CheckOptions(const AnalysisOptions& options);

/** Key and value [Hz]. */
using Cutoffs = std::vector<std::pair<std::string, double>>;
/** "movement.cutoff_hz" and so on: those that AnalyseTrial filters at. */
Cutoffs ListCutoffs(AnalysisOptions options);

/** Share of the rate that a cut-off has at most which nobody stated. MakeLowPass allows 0.4. */
inline constexpr double kMaxCutoffShare = 0.34;
/** The cut-off of a recording of `rate` [Hz]; a stated one stays as it is. */
double FitCutoff(const AnalysisOptions& options, const std::string& key, double cutoff,
                 double rate);
/** All of ListCutoffs. */
AnalysisOptions FitCutoffs(AnalysisOptions options, double rate);

/** Names every cut-off that a recording of `rate` [Hz] does not allow; empty without any. */
std::string FindCutoffFault(const Cutoffs& cutoffs, double rate);

/** Samples a second [Hz]. */
double CalcRate(const ReachTrial& trial);

struct TrialAnalysis {
  ObjectEvents object;
  Hold hold;
  Movement movement;
  MovementPhases phases;
  ScalarCurve speed;    ///< of the wrist, filtered [m/s]
  ScalarCurve opening;  ///< the chosen measure, filtered [m]
  PeakOpening peak_opening;
  EventTime closure_start;  ///< the chosen maximum: t0 of the contact timing
  double closure_start_value = std::numeric_limits<double>::quiet_NaN();  ///< [m]
  double final_opening = std::numeric_limits<double>::quiet_NaN();  ///< at the last contact [m]
  /** By how much the hand still closes after the last contact, until the hold [m]. */
  double closes_on = std::numeric_limits<double>::quiet_NaN();
  std::shared_ptr<const HandCourse> hand;  ///< of the tips filtered as for the hold
  double plane_residual = std::numeric_limits<double>::quiet_NaN();    ///< at the last contact [m]
  double meeting_residual = std::numeric_limits<double>::quiet_NaN();  ///< while closing [m]
  double axis_turn = std::numeric_limits<double>::quiet_NaN();     ///< onset to last contact [rad]
  double axis_settled = std::numeric_limits<double>::quiet_NaN();  ///< FindAxisSettling [s]
  std::vector<DigitContactEvents> contacts;
  ContactOrder order;
  int num_touching = 0;        ///< digits with a contact
  int num_unresolved = 0;      ///< digits whose contact time is unresolved
  int num_unverified = 0;      ///< contacts of which only the digit's own stop tells
  ContactTiming timing;        ///< of the digits that touched: missing when one is unresolved
  ContactTiming timing_all;    ///< of all digits: missing when one did not touch
  ContactTiming timing_first;  ///< as timing, of first touches: they differ after a regrasp
  /** Standard uncertainties of GFT, GOT, GCT [s] from those of the instants that decide them. */
  double gft_uncertainty = std::numeric_limits<double>::quiet_NaN();
  double got_uncertainty = std::numeric_limits<double>::quiet_NaN();
  double gct_uncertainty = std::numeric_limits<double>::quiet_NaN();
  bool used_filled = false;  ///< an event that a measure rests on was decided on filled samples
  bool used_gap = false;     ///< .. or fell into a gap
  double low_pass = std::numeric_limits<double>::quiet_NaN();  ///< ReachTrial::low_pass [Hz]
  bool may_be_exchanged = false;                               ///< thumb and index (MayBeExchanged)
  bool goes_elsewhere_first = false;  ///< the object, before it rises (GoesElsewhereFirst)
  std::vector<Doubt> trial_doubts;    ///< about the trial as such
  std::vector<Doubt> doubts;          ///< those, then those about the contacts believed
};

/** @throws Error as CheckOptions, Error(kRange) for a cut-off above 0.4 of the rate. What a trial
does not show is missing in the result, with the reason, never an error. */
TrialAnalysis AnalyseTrial(FilteredTrial& trial, const AnalysisOptions& options);
/** For a trial that is analysed once. @throws Error as CheckTrial, too. */
TrialAnalysis AnalyseTrial(const ReachTrial& trial, const AnalysisOptions& options);

/** Takes the contacts from another detector, as AnalyseTrial with that detector would have, without
a second search.
@param options  those of the analysis, but for the detector. @throws Error as CheckOptions. */
void BelieveDetector(const std::string& detector, const AnalysisOptions& options,
                     TrialAnalysis& analysis);

/** All measures, after contacts were changed. */
void RecalcMeasures(const AnalysisOptions& options, TrialAnalysis& analysis);

/** Latest of the first contacts [s]; NaN without any. */
double FindLastContact(const std::vector<DigitContactEvents>& contacts);

/** One column of a table of measures. */
struct TrialMeasure {
  const char* id;    ///< with its unit: "grasp_forming_time_s"
  const char* name;  ///< for people: "grasp forming time (GFT)"
  const char* unit;  ///< "s", "m", "m/s", "1" for a ratio, "" for a count
  double (*value)(const TrialAnalysis& analysis);  ///< NaN: missing
};

/** All of them, in the order of tables. */
const std::vector<TrialMeasure>& TrialMeasureList();

}  // namespace graspbench
