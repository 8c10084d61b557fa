#pragma once
/** @file
How a digit closes: its share s of the way from pre-grasp to target posture over time,

    s_d(t) = clip((t - delay_d) speed_d / T, 0, 1)

with T the time of the closure. Delays of zero and speeds of one are the thesis's common s. After
the digit's first touch its speed may be a share of that, and a regulated grip holds the digit where
it is, shifts it, or takes back what it was ahead of its drive (core/trial/grip). Knows time and
touch, no physics. */

#include <algorithm>
#include <cmath>

namespace graspbench {

struct ClosingSchedule {
  double delay = 0.0;  ///< after the start of closure [s]
  double speed = 1.0;  ///< > 0
};
inline bool operator==(const ClosingSchedule& a, const ClosingSchedule& b) {
  return a.delay == b.delay && a.speed == b.speed;
}
/** From the start of closure to s = 1 [s]. */
inline double CalcClosingTime(const ClosingSchedule& schedule, double closure_time) {
  return schedule.delay + closure_time / schedule.speed;
}

class ClosingLaw {
 public:
  explicit ClosingLaw(const ClosingSchedule& schedule = {}) : schedule_(schedule) {}

  /** One step of the closure. @param share  of the digit's own speed. */
  void Advance(double step, double closure_time, double share) {
    ++num_steps_;
    if (num_steps_ <= std::lround(schedule_.delay / step)) return;
    closing_ = std::min(1.0, closing_ + share * schedule_.speed * step / closure_time);
  }
  /** Never beyond the target posture. */
  void MoveTo(double closing) { closing_ = std::clamp(closing, 0.0, 1.0); }

  double closing() const { return closing_; }  ///< s

 private:
  ClosingSchedule schedule_;
  double closing_ = 0.0;
  long num_steps_ = 0;  ///< since the start of closure
};

}  // namespace graspbench
