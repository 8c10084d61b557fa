#pragma once
/** @file
When the hand holds the object. Contacts are looked for backwards from there, so that touching and
letting go before the grasp does not count.

An object that is lifted tells it: at its lift-off it is in the hand (LiftOffRuleList). Where
nothing is lifted, or the object was not recorded, the hand must tell. A grasp then is where the
hand rests at the object, closed: three criteria, each a number between 0 and 1 at every sample,
combined by a rule. This is the way of Schot, Brenner and Smeets (2010): a speed threshold alone
takes every pause for the grasp, a place alone every passage.

    slow    of the fastest visible tip against the object: 1 at rest, 0 from the threshold on,
            linear between. The threshold is the usual 50 mm/s, or four standard deviations of the
            noise of that speed where this is more.
    there   of the wrist's distance from the object (else from where it began): 1 where it is
            nearest the object (farthest from the beginning), 0 for the half of the range away from
            there, linear between
    closed  of the hand's opening: 1 at its smallest, 0 at its widest, linear

No threshold of distance or opening has to be chosen: both criteria are relative to the trial.
Hidden tips take no part in `slow`, which is 0 where none is seen; distance and opening go straight
across gaps, as they weigh and decide no instant.

Not told apart: an object that was not recorded and is carried on before the hand rests. Cut such a
trial before that. */

#include <Eigen/Core>
#include <limits>
#include <string>
#include <vector>

#include "core/base/file_keys.h"
#include "human_study/events/filtered_trial.h"
#include "human_study/events/reach_trial.h"
#include "human_study/events/scalar_curve.h"

namespace graspbench {

struct HoldOptions {
  std::string rule = "multiplied";  ///< an id of HoldRuleList(), for what is not lifted
  double cutoff = 10.0;             ///< of the zero-phase filter on the tips [Hz]
  double speed_threshold = 0.05;    ///< [m/s]

  template <class V>
  void Visit(V&& v) {
    v("rule", rule, "how the hold is found for objects that are not lifted");
    v("cutoff_hz", cutoff,
      {"cut-off of the zero-phase filter on the tips; unless stated, at most 0.34 of the "
       "recording's rate",
       kAboveZero});
    v("speed_threshold_m_per_s", speed_threshold, {"tips that are faster do not hold", kAboveZero});
  }
};

/** A stretch of a trial in which the hand holds, and an instant of it. */
struct Hold {
  double time = std::numeric_limits<double>::quiet_NaN();  ///< [s]
  double begin = time;  ///< no visible tip is fast against the object from here .. [s]
  double end = time;    ///< .. to here
  std::string missing;  ///< why there is none; empty when there is one

  bool IsFound() const { return missing.empty() && time == time; }
};

/** The hold of an object lifted at that instant: from 0.1 s before to 0.5 s after. */
Hold MakeLiftedHold(double lift_off);

/** One number between 0 and 1 a sample each. */
struct HoldCriteria {
  std::vector<double> times;  ///< [s]
  Eigen::VectorXd slow, there, closed;
};

struct HoldRule {
  const char* id;
  const char* text;  ///< what it does and where it comes from, for methods sections
  /** A sample of the hold; -1 when there is none. */
  int (*find)(const HoldCriteria& criteria);
};

const std::vector<HoldRule>& HoldRuleList();
/** @throws Error(kNotFound) with a suggestion. */
const HoldRule& FindHoldRule(const std::string& id);

/** @param transport  path of the wrist in L, unfiltered.
@param opening  of the hand, filtered.
@param object_cutoff  of the object's pose [Hz].
@throws Error(kNotFound) for an unknown rule, Error(kRange) when a cut-off does not fit the rate. */
Hold FindHold(FilteredTrial& trial, const Trajectory& transport, const ScalarCurve& opening,
              const HoldOptions& options, double object_cutoff);

// When the object leaves its support, and when it first moves at all.
struct LiftOffOptions {
  std::string rule = "fitted";  ///< an id of LiftOffRuleList()
  double cutoff = 10.0;         ///< of the zero-phase filter on the middle of the markers [Hz]
  double min_rise = 0.01;       ///< an object that rises less is not lifted [m]
  double rise = 0.003;          ///< "rise": this high [m]
  double speed = 0.01;          ///< "traced_back", and where "fitted" looks: slower [m/s]
  double displacement = 0.002;  ///< an object this far from its place has moved [m]
  double up_x = 0.0, up_y = 0.0, up_z = 1.0;  ///< direction of the lift, in L

  template <class V>
  void Visit(V&& v) {
    v("rule", rule, "how the lift-off is found");
    v("cutoff_hz", cutoff,
      {"cut-off of the zero-phase filter on the object; unless stated, at most 0.34 of the "
       "recording's rate",
       kAboveZero});
    v("min_rise_m", min_rise, {"an object that rises less is not lifted", kAboveZero});
    v("rise_m", rise, {"rule rise: this high", kAboveZero});
    v("speed_m_per_s", speed,
      {"rule traced_back, and where rule fitted looks: slower than this", kAboveZero});
    v("displacement_m", displacement, {"an object this far from its place has moved", kAboveZero});
    v("up_x", up_x, "direction of the lift in the laboratory, x");
    v("up_y", up_y, "direction of the lift in the laboratory, y");
    v("up_z", up_z, "direction of the lift in the laboratory, z");
  }
};

/** How far the object is from its place of rest, the median position over the first tenth of the
trial. */
struct ObjectTravel {
  ScalarCurve height;      ///< along the direction of the lift [m]
  ScalarCurve unfiltered;  ///< the height without the filter [m]
  /** Of the object's lowest point, unfiltered: one that tilts on its edge stands until that rises.
  The same as `unfiltered` where the shape or the turn is not known [m]. */
  ScalarCurve lowest;
  ScalarCurve displacement;  ///< in any direction [m]
  Eigen::Matrix3Xd moved;    ///< the same as vectors in L [m]; NaN where invalid
  Eigen::Matrix3Xd moved_unfiltered;
};

struct LiftOffRule {
  const char* id;
  const char* text;
  EventTime (*find)(const ObjectTravel& travel, const LiftOffOptions& options);
};

const std::vector<LiftOffRule>& LiftOffRuleList();

struct ObjectEvents {
  EventTime moved;     ///< first left its place, in any direction: bounds the first contact
  EventTime lift_off;  ///< first leaves its support for good
};

/** @pre the object was recorded and the direction of the lift is not zero. */
ObjectTravel CalcObjectTravel(const ReachTrial& trial, const LiftOffOptions& options);

/** @pre the rule is known. */
ObjectEvents FindObjectEvents(const ObjectTravel& travel, const LiftOffOptions& options);

/** A way of the object along an axis of L. */
struct ObjectWay {
  Eigen::Vector3d axis;  ///< unit, in L
  double along = 0.0;    ///< the largest displacement that way [m]
  EventTime lift_off;    ///< the rule's instant, as if that were the stated direction
};
/** Ways of more than `least` [m] on which the object was under way, by 10 mm, while it had hardly
risen: by less than 0.3 of the height that would keep pace. */
std::vector<ObjectWay> FindWaysBeforeRise(const ObjectTravel& travel, double least,
                                          const LiftOffOptions& options);

}  // namespace graspbench
