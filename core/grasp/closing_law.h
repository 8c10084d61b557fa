#pragma once
/** @file
Closing of one digit: its share s of the path from pre-grasp to target posture over time,

    s_d(t) = clip((t - delay_d) speed_d / T, 0, 1)

where T is the closure time. Zero delays and unit speeds give the thesis's common s. After its first
touch a digit may close more slowly. A regulated grip holds the digit at its position, shifts it, or
takes back its lead over its drive (core/trial/grip). The law depends on time and touch only, not on
physics. */

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
/** Time from the start of closure to s = 1 [s]. */
inline double CalcClosingTime(const ClosingSchedule& schedule, double closure_time) {
  return schedule.delay + closure_time / schedule.speed;
}

class ClosingLaw {
 public:
  explicit ClosingLaw(const ClosingSchedule& schedule = {}) : schedule_(schedule) {}

  /** Closes by one time step. @param share  share of the digit's own speed. */
  void Advance(double step, double closure_time, double share) {
    ++num_steps_;
    if (num_steps_ <= std::lround(schedule_.delay / step)) return;
    closing_ = std::min(1.0, closing_ + share * schedule_.speed * step / closure_time);
  }
  /** Sets s, clipped to [0, 1]. */
  void MoveTo(double closing) { closing_ = std::clamp(closing, 0.0, 1.0); }

  double closing() const { return closing_; }  ///< s

 private:
  ClosingSchedule schedule_;
  double closing_ = 0.0;
  long num_steps_ = 0;  ///< since the start of closure
};

}  // namespace graspbench
