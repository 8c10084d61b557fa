#pragma once
/** @file
When the object leaves its support, and when it first moves at all. */

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/base/file_keys.h"
#include "human_study/events/event_time.h"
#include "human_study/events/reach_trial.h"
#include "human_study/events/scalar_curve.h"

namespace graspbench {

struct LiftOffOptions {
  std::string rule = "traced_back";  ///< an id of LiftOffRuleList()
  double cutoff = 10.0;              ///< of the zero-phase filter on the middle of the markers [Hz]
  double min_rise = 0.01;            ///< an object that rises less is not lifted [m]
  double rise = 0.003;               ///< "rise": this high [m]
  double speed = 0.01;               ///< "traced_back": slower than this [m/s]
  double displacement = 0.002;       ///< an object this far from its place has moved [m]
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
    v("speed_m_per_s", speed, {"rule traced_back: slower than this", kAboveZero});
    v("displacement_m", displacement, {"an object this far from its place has moved", kAboveZero});
    v("up_x", up_x, "direction of the lift in the laboratory, x");
    v("up_y", up_y, "the same, y");
    v("up_z", up_z, "the same, z");
  }
};

struct LiftOffRule {
  const char* id;
  const char* text;
  /** @param height  above the place of rest [m]. */
  EventTime (*find)(const ScalarCurve& height, const LiftOffOptions& options);
};

const std::vector<LiftOffRule>& LiftOffRuleList();

struct ObjectEvents {
  EventTime moved;     ///< first left its place, in any direction: bounds the first contact
  EventTime lift_off;  ///< first leaves its support for good
};

/** How far the object is from its place of rest, the median position over the first tenth of the
trial. */
struct ObjectTravel {
  ScalarCurve height;        ///< along the direction of the lift [m]
  ScalarCurve displacement;  ///< in any direction [m]
  Eigen::Matrix3Xd moved;    ///< the same as vectors in L [m]; NaN where invalid
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
