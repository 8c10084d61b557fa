#pragma once
/** @file
Onset and end of a reach from the speed of the wrist, by published rules.

Every rule looks for the onset before the peak of speed. The end is the onset of the curve run
backwards, so both ends are treated alike and turning time round swaps them. */

#include <array>
#include <string>
#include <vector>

#include "core/base/file_keys.h"
#include "human_study/events/scalar_curve.h"

namespace graspbench {

struct MovementOptions {
  std::string rule = "threshold";  ///< an id of MovementRuleList()
  double cutoff = 10.0;            ///< of the zero-phase filter on the wrist [Hz]
  double speed_threshold = 0.05;   ///< [m/s]
  double peak_fraction = 0.05;     ///< of the peak speed

  template <class V>
  void Visit(V&& v) {
    v("rule", rule, "how onset and end are found");
    v("cutoff_hz", cutoff,
      {"cut-off of the zero-phase filter on the wrist; unless stated, at most 0.34 of the "
       "recording's rate",
       kAboveZero});
    v("speed_threshold_m_per_s", speed_threshold,
      {"speed threshold of the rules that use one", kAboveZero});
    v("peak_fraction", peak_fraction,
      {"share of the peak speed, for the rules that use it", kAboveZero});
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

/** Shares of the peak speed at which Movement::rise is read. */
inline constexpr std::array<double, 3> kRiseShares = {0.1, 0.3, 0.6};

struct Movement {
  EventTime onset;
  EventTime end;
  /** Where the hand left rest: speed = c (t - start)^n (1 + b (t - start)), carried back to zero
  from the rising flank (4 to 60 % of the peak) for each n from 1 to 3.6, the n weighed by how well
  they explain the flank. A threshold finds the movement later, by more the slower it starts. */
  EventTime start;
  std::array<double, 3> rise = MakeNoRise();  ///< speed last rose through kRiseShares [s]; NaN
  double rise_noise = std::numeric_limits<double>::quiet_NaN();  ///< SD of the first by noise [s]
  double distance =
      std::numeric_limits<double>::quiet_NaN();  ///< of the hand, above 10 % speed [m]
  double peak_speed = std::numeric_limits<double>::quiet_NaN();      ///< [m/s]
  double peak_time = std::numeric_limits<double>::quiet_NaN();       ///< [s]
  double slowest_before = std::numeric_limits<double>::quiet_NaN();  ///< least before it [m/s]

  static constexpr std::array<double, 3> MakeNoRise() {
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    return {kNone, kNone, kNone};
  }
};

/** @param speed  of the wrist, filtered.
@param begin,end  only this part is looked at [s]; give the hold (hold.h) as the end: the way back
is another movement.
@throws Error(kNotFound) for an unknown rule. */
Movement FindMovement(const ScalarCurve& speed, double begin, double end,
                      const MovementOptions& options);

/** The two phases of a reach: fast transport, then a low-velocity phase that begins where the hand's
deceleration gives way, often with a second rise of speed (re-acceleration).
Source: Jeannerod, J. Mot. Behav. 16 (1984) 235-254, who found it at about 75 % of movement time.

With a = dv/dt, after the largest deceleration: the first maximum of a behind which a falls again by
a tenth of the largest deceleration (and four standard deviations of its noise). Where a is positive
there, the instant is that of the lowest speed before it (a = 0); else that of the maximum itself,
where the hand decelerates least. A single minimum-jerk movement has neither: its a only rises from
its lowest to 0. */
struct MovementPhases {
  EventTime reacceleration;  ///< the low-velocity phase begins
  bool rises = false;        ///< the speed rises again
};

/** @param speed  of the wrist, filtered. Looks between the peak of speed and the movement's end. */
MovementPhases FindPhases(const ScalarCurve& speed, const Movement& movement);

}  // namespace graspbench
