#pragma once
/** @file
Closing of one digit: its share s of the path from pre-grasp to target posture over time,

    s_d(t) = clip((t - delay_d) speed_d / T, 0, 1)

where T is the closure time. Zero delays and unit speeds give the thesis's common s. A digit with a
recorded course (grasp_course.h) follows that first, from the start of placing and later by its
delay. After its first touch a digit may close more slowly. A regulated grip holds the digit at its
position, shifts it, or takes back its lead over its drive (core/trial/grip). The law depends on
time and touch only, not on physics. */

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/grasp/grasp_course.h"

namespace graspbench {

struct ClosingSchedule {
  double delay = 0.0;  ///< after the start of closure [s]
  double speed = 1.0;  ///< > 0
};
inline bool operator==(const ClosingSchedule& a, const ClosingSchedule& b) {
  return a.delay == b.delay && a.speed == b.speed;
}
/** Time from the start of closure to s = 1 [s]. */
inline double CalcClosingTime(const ClosingSchedule& schedule, double closure_time) {
  return schedule.delay + closure_time / schedule.speed;
}

class ClosingLaw {
 public:
  /** @param course  its recorded closing by instant, `period` apart [s]; empty: none. */
  explicit ClosingLaw(const ClosingSchedule& schedule = {}, std::vector<double> course = {},
                      double period = 0.0)
      : schedule_(schedule),
        course_(std::move(course)),
        period_(period),
        time_(-schedule.delay),
        closing_(CalcCourseClosing(course_, period_, time_)) {}

  /** Closes by one time step. @param share  share of the digit's own speed. */
  void Advance(double step, double closure_time, double share) {
    ++num_steps_;
    if (!course_.empty() && time_ < period_ * (static_cast<double>(course_.size()) - 1.0)) {
      const double before = CalcCourseClosing(course_, period_, time_);
      time_ += step;
      MoveTo(closing_ + CalcCourseClosing(course_, period_, time_) - before);
      return;
    }
    if (num_steps_ <= std::lround(schedule_.delay / step)) return;
    closing_ = std::min(1.0, closing_ + share * schedule_.speed * step / closure_time);
  }
  /** Sets s, clipped to [0, 1]. */
  void MoveTo(double closing) { closing_ = std::clamp(closing, 0.0, 1.0); }

  double closing() const { return closing_; }  ///< s

 private:
  ClosingSchedule schedule_;
  std::vector<double> course_;
  double period_;
  double time_;         ///< in the course [s]
  double closing_;      ///< s
  long num_steps_ = 0;  ///< since the start of closure or of the course
};

}  // namespace graspbench
