#include "core/trial/grip/grip_threshold.h"

#include <cmath>

#include "core/base/error.h"

namespace graspbench {

double CalcGripAt(const ThresholdScale& scale, int place) {
  GRASPBENCH_DEMAND(place >= 0 && place <= kMostGripPlace, std::to_string(place));
  return scale.least * std::pow(scale.most / scale.least, place / double{kMostGripPlace});
}

namespace {

/** One bisection; once an answer is not known it asks nothing more. */
class Bisection {
 public:
  Bisection(const std::function<std::optional<bool>(int place)>& succeeds, int most)
      : succeeds_(succeeds), most_(most) {}

  GripThreshold Find() {
    if (Holds(most_)) {
      upper_ = most_;
    } else {
      FindWeakerGrip();
    }
    if (upper_ < 0) return found_;
    while (upper_ - lower_ > 1 && CountAsked() < kMostThresholdTrials - 1) {
      Ask((lower_ + upper_) / 2);
    }
    if (!is_lower_asked_ && (upper_ == 0 || Holds(0))) {
      upper_ = 0;
      found_.is_below_range = true;
    } else if (is_lower_asked_ && found_.is_monotone) {
      const int above = (upper_ + most_) / 2;
      if (above > upper_ && above < most_) found_.is_monotone = Holds(above);
    } else if (upper_ - lower_ > 1 && CountAsked() < kMostThresholdTrials) {
      Ask((lower_ + upper_) / 2);
    }
    found_.place = upper_;
    return found_;
  }

 private:
  int CountAsked() const {
    return static_cast<int>(found_.failed.size() + found_.succeeded.size()) +
           (found_.next ? kMostThresholdTrials : 0);
  }

  bool Holds(int place) {
    if (found_.next) return false;
    const std::optional<bool> answer = succeeds_(place);
    if (!answer) {
      found_.next = place;
      return false;
    }
    (*answer ? found_.succeeded : found_.failed).push_back(place);
    return *answer;
  }

  void Ask(int place) {
    if (Holds(place)) {
      upper_ = place;
    } else {
      lower_ = place;
      is_lower_asked_ = true;
    }
  }

  void FindWeakerGrip() {
    for (const int place : {8, 4, 2, 12}) {
      if (place >= most_ || !Holds(place)) continue;
      found_.is_monotone = false;
      upper_ = place;
      is_lower_asked_ = place == 12;
      lower_ = is_lower_asked_ ? 8 : 0;
      return;
    }
  }

  const std::function<std::optional<bool>(int place)>& succeeds_;
  const int most_;
  GripThreshold found_;
  int lower_ = 0, upper_ = -1;  // places; the threshold is above the one, at most the other
  bool is_lower_asked_ = false;
};

}  // namespace

GripThreshold FindGripThreshold(const std::function<std::optional<bool>(int place)>& succeeds,
                                int most) {
  GRASPBENCH_DEMAND(most >= 0 && most <= kMostGripPlace, std::to_string(most));
  GripThreshold found = Bisection(succeeds, most).Find();
  if (found.next) found.place = std::nullopt;
  return found;
}

}  // namespace graspbench
