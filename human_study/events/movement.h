#pragma once
/** @file
Onset and end of a reach from the speed of the wrist, by published rules.

Every rule looks for the onset before the peak of speed. The end is the onset of the curve run
backwards, so both ends are treated alike and turning time round swaps them. */

#include <string>
#include <vector>

#include "human_study/events/scalar_curve.h"

namespace graspbench {

struct MovementOptions {
  std::string rule = "threshold";  ///< an id of MovementRuleList()
  double cutoff = 10.0;            ///< of the zero-phase filter on the wrist [Hz]
  double speed_threshold = 0.05;   ///< [m/s]
  double peak_fraction = 0.05;     ///< of the peak speed

  template <class V>
  void Visit(V&& v) {
    v("rule", rule);
    v("cutoff_hz", cutoff);
    v("speed_threshold_m_per_s", speed_threshold);
    v("peak_fraction", peak_fraction);
  }
};

struct MovementRule {
  const char* id;
  const char* text;  ///< what it does and where it comes from, for methods sections
  /** @param peak  sample of the peak speed. Looks at samples 0..peak. */
  EventTime (*find_onset)(const ScalarCurve& speed, size_t peak, const MovementOptions& options);
};

const std::vector<MovementRule>& MovementRuleList();
/** @throws Error(kNotFound) with a suggestion. */
const MovementRule& FindMovementRule(const std::string& id);

struct Movement {
  EventTime onset;
  EventTime end;
  double peak_speed = std::numeric_limits<double>::quiet_NaN();  ///< [m/s]
  double peak_time = std::numeric_limits<double>::quiet_NaN();   ///< [s]
};

/** @param speed  of the wrist, filtered.
@param begin,end  only this part is looked at [s]; give the hold (hold.h) as the end: the way back
is another movement.
@throws Error(kNotFound) for an unknown rule. */
Movement FindMovement(const ScalarCurve& speed, double begin, double end,
                      const MovementOptions& options);

}  // namespace graspbench
