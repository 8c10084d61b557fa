#pragma once
/** @file
When a digit first touched: several independent answers from the same trial.

One detector is one file detectors/<id>.cc with Make<Name>Detector() and one line in
detectors/detector_list.inc. All are asked; one is believed (ContactOptions::detector), and the
spread of the others is reported beside it.

A grasp ends in a hold: the object is in the hand, no tip moves against it. Every detector starts
from there and looks back, so that touching and letting go before the grasp does not count. The hold
is the lift-off; without a recorded object it is the end of the movement. */

#include <string>
#include <vector>

#include "human_study/events/event_time.h"
#include "human_study/events/reach_trial.h"
#include "human_study/events/scalar_curve.h"

namespace graspbench {

struct ContactOptions {
  std::string detector = "breakpoint";  ///< an id of ContactDetectorList(): the one believed
  double cutoff = 20.0;                 ///< of the zero-phase filter on the tips [Hz]
  double speed_threshold = 0.05;        ///< "speed": slower against the object [m/s]
  double surface_tolerance = 0.002;     ///< "surface": nearer than this beyond the pad [m]
  double max_pad_offset = 0.025;        ///< a marker held farther from the surface: no touch [m]
  double force_noise_factor = 4.0;      ///< "force": above this many SD of the baseline's rate

  template <class V>
  void Visit(V&& v) {
    v("detector", detector);
    v("cutoff_hz", cutoff);
    v("speed_threshold_m_per_s", speed_threshold);
    v("surface_tolerance_m", surface_tolerance);
    v("max_pad_offset_m", max_pad_offset);
    v("force_noise_factor", force_noise_factor);
  }
};

/** What the detectors share, computed once a trial. Without a recorded object, "against the object"
means against the laboratory. */
struct DigitEvidence {
  Trajectory p_O;        ///< tip in O, unfiltered
  ScalarCurve speed;     ///< against the object, filtered [m/s]
  ScalarCurve distance;  ///< of the marker from the surface, filtered [m]; empty: shape not known
  double noise = 0.0;    ///< SD of one coordinate of p_O [m], from what the filter takes away
  const DigitTrack* track = nullptr;
};

struct ContactEvidence {
  double begin = 0.0;   ///< onset of the movement [s]: no contact is looked for before it
  double hold = 0.0;    ///< [s]
  ScalarCurve opening;  ///< thumb to virtual finger, filtered [m]
  ScalarCurve object_displacement;  ///< [m]; empty: object not recorded
  std::vector<DigitEvidence> digits;
};

/** @pre CheckTrial passed. The evidence refers to `trial`. */
ContactEvidence MakeContactEvidence(const ReachTrial& trial, double begin, double hold,
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
  EventTime contact;                   ///< of the detector believed
  /** Latest minus earliest of the detectors that found one [s]; NaN below two. */
  double disagreement = std::numeric_limits<double>::quiet_NaN();
};

std::vector<DigitContactEvents> FindContacts(const ContactEvidence& evidence,
                                             const ContactOptions& options);

}  // namespace graspbench
