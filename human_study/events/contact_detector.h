#pragma once
/** @file
When a digit first touched: several independent answers from the same trial.

One detector is one file `detectors/<id>.cc` with Make<Name>Detector() and one line in
detectors/detector_list.inc. All are asked; one is believed (ContactOptions::detector), and the
spread of the others is reported beside it.

A grasp ends in a hold (hold.h): the object is in the hand, no tip moves against it. Every detector
starts from there and looks back, so that touching and letting go before the grasp does not count.
*/

#include <string>
#include <string_view>
#include <vector>

#include "core/base/file_keys.h"
#include "human_study/events/filtered_trial.h"
#include "human_study/events/hold.h"
#include "human_study/events/scalar_curve.h"

namespace graspbench {

/** A digit that touches, leaves again and returns before the object is held.

A contact (DigitContactEvents::contact) is the lasting touch: that of the final hold, what detectors
look back from. A digit that was at the place where it holds before, left it by more than 4 mm (six
standard deviations of the noise) and came back has touched earlier, too. GFT and the other measures
are those of lasting touches; GFT of first touches is a measure of its own.

    first_touch  the departure from the place in the hold first fell below 2 mm (three standard
                 deviations), late by some 10 ms with soft arrivals
    release      it last rose through that before it was farthest */
struct Regrasp {
  EventTime first_touch, release;
  double left_by = 0.0;  ///< largest departure between release and the final contact [m]

  bool IsFound() const { return first_touch.IsFound(); }
};

/** @param departure  of the tip from its place in the hold, in the object's frame, filtered [m].
@param begin,contact  the search goes from one to the other [s]. */
Regrasp FindRegrasp(const ScalarCurve& departure, double begin, double contact);

struct ContactOptions {
  std::string detector = "breakpoint";  ///< an id of ContactDetectorList(): the one believed
  double cutoff = 20.0;                 ///< of the zero-phase filter on the tips [Hz]
  double object_cutoff = 15.0;          ///< of the filter on the object's pose [Hz]
  double speed_threshold = 0.05;        ///< "speed": slower against the object [m/s]
  double max_pad_offset = 0.025;        ///< a marker held farther from the surface: no touch [m]
  double max_pad_difference = 0.005;    ///< .. or farther than this beyond the other digits' [m]
  double max_looseness = 3.0;           ///< held this many times looser than the others: no touch
  double max_uncertainty = 0.05;        ///< a contact known less well is not usable [s]; 0: all are
  double force_noise_factor = 4.0;      ///< "force": above this many SD of the baseline's rate
  /** How far digits go on after they touched (touch_fit.h). No setting: learned from a study. */
  DepthWeights depths = kUsualDepths;

  template <class V>
  void Visit(V&& v) {
    v("detector", detector,
      {"the detector that is believed; auto: surface where every trial's object has a known shape, "
       "else breakpoint",
       "auto"});
    v("cutoff_hz", cutoff,
      {"cut-off of the zero-phase filter on the tips; unless stated, at most 0.34 of the "
       "recording's rate",
       kAboveZero});
    v("object_cutoff_hz", object_cutoff,
      {"cut-off of the filter on the object's pose; unless stated, at most 0.34 of the "
       "recording's rate",
       kAboveZero});
    v("speed_threshold_m_per_s", speed_threshold,
      {"detector speed: slower against the object", kAboveZero});
    v("max_pad_offset_m", max_pad_offset,
      {"a marker held farther from the surface does not touch", kAboveZero});
    v("max_pad_difference_m", max_pad_difference,
      {"a marker farther from the surface than the other digits' by more than this does not touch",
       kAboveZero});
    v("max_looseness", max_looseness,
      {"reject contacts whose marker moves more than this many times as much as the others in the "
       "hold",
       kAboveZero});
    v("max_uncertainty_s", max_uncertainty,
      {"contacts with a larger uncertainty are not used; 0: no limit", 0});
    v("force_noise_factor", force_noise_factor,
      {"detector force: above so many standard deviations", kAboveZero});
  }
};

/** How the reason starts why a contact that is known too badly (max_uncertainty) is missing. Its
time and uncertainty stay where they are bounded; no measure rests on them. */
inline constexpr std::string_view kNotUsable = "not usable here";
/** Touched at an unresolved time. */
inline bool IsUnresolved(const EventTime& contact) {
  return contact.missing.rfind(kNotUsable, 0) == 0;
}

/** What the detectors share, computed once a trial. "About the hold" is the part of the hold from
50 ms before to 100 ms after its instant, or the sample of the hold nearest to that instant that
shows the digit (FindHoldSample). Without a recorded object, "against the object" means against the
laboratory. */
struct DigitEvidence {
  Trajectory p_O;         ///< tip in O; the tip is unfiltered, the object's pose is filtered
  ScalarCurve speed;      ///< against the object, filtered [m/s]
  ScalarCurve departure;  ///< from its mean place about the hold, filtered [m]
  ScalarCurve distance;   ///< of the marker from the surface, filtered [m]; empty: shape not known
  /** Median of the distance about the hold [m]; NaN: shape not known or hidden. Stands in for a pad
  offset that is not given. */
  double hold_distance = std::numeric_limits<double>::quiet_NaN();
  /** SD of a coordinate of the unfiltered tip in O about the hold, median absolute: its noise
  there, that of the object's pose at its lever included [m]; NaN when hidden. */
  double noise_O = std::numeric_limits<double>::quiet_NaN();
  /** RMS distance of the filtered tip from its mean place from the hold to its end, without its
  noise [m]: a digit that is not on the object goes its own way. NaN when hidden. */
  double looseness = std::numeric_limits<double>::quiet_NaN();
  TouchFits fits;
  const DigitTrack* track = nullptr;
};

struct ContactEvidence {
  double begin = 0.0;  ///< onset of the movement [s]: no contact is looked for before it
  Hold hold;
  ScalarCurve opening;              ///< of the hand, filtered [m]
  ScalarCurve object_displacement;  ///< [m]; empty: object not recorded
  /** Medians over the digits, of three or more [m]; else NaN. */
  double typical_hold_distance = std::numeric_limits<double>::quiet_NaN();
  double typical_looseness = std::numeric_limits<double>::quiet_NaN();
  std::vector<DigitEvidence> digits;
};

/** @param opening  the hand's opening, filtered.
@param object_displacement  see ContactEvidence.
The evidence refers to the reach behind `trial`. */
ContactEvidence MakeContactEvidence(FilteredTrial& trial, const ScalarCurve& opening,
                                    const ScalarCurve& object_displacement, double begin,
                                    const Hold& hold, const ContactOptions& options);

/** A tip that moves against the object for less long is seen through noise, not approaching [s]. */
inline constexpr double kMinApproach = 0.04;

/** The valid sample of the hold that is nearest to its instant; -1 when the digit is hidden. */
int FindHoldSample(const ScalarCurve& curve, const Hold& hold);

/** Why a digit does not take part in the grasp, as far as motion and shape can tell: hidden, moving
against the object, its marker too far from the surface (farther than a given pad offset or than the
other digits' markers, too), or held more loosely than the other digits. Empty when it may. */
std::string FindNoTouch(const ContactEvidence& evidence, const DigitEvidence& digit,
                        const ContactOptions& options);

/** Across a longer gap a fit guesses how digit and object moved unseen [s]. Below, coverage is
measured (ACCURACY.md, "half hidden"). */
inline constexpr double kMaxTouchGap = 0.12;

/** The event of a fit: in a gap when no sample was measured near it, missing when that gap is longer
than kMaxTouchGap. */
EventTime MakeTouchEvent(const DigitEvidence& digit, const TouchFit& fit,
                         const ContactOptions& options);

struct ContactDetector {
  const char* id;
  const char* text;   ///< what it does, for methods sections
  const char* needs;  ///< what must have been recorded
  EventTime (*find)(const ContactEvidence& evidence, const DigitEvidence& digit,
                    const ContactOptions& options);
};

const std::vector<ContactDetector>& ContactDetectorList();
/** Place in ContactDetectorList(). @throws Error(kNotFound) with a suggestion. */
size_t FindContactDetector(const std::string& id);

struct DigitContactEvents {
  std::string digit;
  bool is_thumb = false;
  std::vector<EventTime> by_detector;  ///< in the order of ContactDetectorList()
  /** Of `contact`, without what all digits share (CalcOwnUncertainty, of the fit that is believed)
  [s]; its uncertainty where nothing is fitted. */
  double own_uncertainty = std::numeric_limits<double>::quiet_NaN();
  EventTime contact;  ///< of the detector believed: the touch that leads to the hold
  Regrasp regrasp;    ///< it touched and left before
  /** Farther from the surface than the other digits' in the hold [m]; a study takes out what is
  usual for this digit of this person, which is its marker's place. NaN: not known. */
  double stands_off = std::numeric_limits<double>::quiet_NaN();
  TouchFit fit;  ///< to the clearance from the surface, else to the path
  double noise_O = std::numeric_limits<double>::quiet_NaN();  ///< DigitEvidence::noise_O [m]
  /** How much farther from the surface its marker is in the hold than the pad offset that was given;
  the distance itself when none was [m]. NaN: shape not known, or hidden. */
  double hold_distance = std::numeric_limits<double>::quiet_NaN();
  bool has_pad_offset = false;  ///< one was given
  /** Something other than the digit's own stop says that it touched: the object's shape or a force.
  Without, a digit that stops off the surface looks like one that touches. */
  bool is_verified = false;
  bool is_reviewed = false;  ///< a person looked at it: `contact` stays, whatever is believed
  /** Latest minus earliest of the detectors that found one [s]; NaN below two. */
  double disagreement = std::numeric_limits<double>::quiet_NaN();
};

std::vector<DigitContactEvents> FindContacts(const ContactEvidence& evidence,
                                             const ContactOptions& options);

/** Where another detector finds a contact elsewhere, beyond a limit [s] and beyond three times what
both say of their uncertainty, the interval of the contact reaches as far as that. "multiplied" and
"speed" are not asked: they stop at thresholds, which slow arrivals cross early. A limit of 0 changes
nothing, and neither does a contact that a person looked at change. */
void CoverDisagreement(double limit, const ContactOptions& options,
                       std::vector<DigitContactEvents>& contacts);

// Declares Make<Name>Detector() for every line of detector_list.inc.
#define GRASPBENCH_DETECTOR(name) ContactDetector Make##name##Detector();
#include "human_study/events/detectors/detector_list.inc"
#undef GRASPBENCH_DETECTOR

}  // namespace graspbench
