#include "human_study/events/filtered_trial.h"

#include <cmath>

namespace graspbench {
namespace {

using Column = Eigen::Index;

Trajectory ExpressInObject(const Trajectory& tip, const ObjectTrack& object) {
  if (!object.IsRecorded()) return tip;
  Trajectory p_O = tip;
  for (size_t i = 0; i < tip.size(); ++i) {
    const auto column = static_cast<Column>(i);
    p_O.states[i] = CombineStates(tip.states[i], object.states[i]);
    p_O.p.col(column) = p_O.IsValid(i)
                            ? Eigen::Vector3d(object.X_LO[i].inverse() * tip.p.col(column))
                            : Eigen::Vector3d::Constant(std::nan(""));
  }
  return p_O;
}

}  // namespace

FilteredTrial::FilteredTrial(const ReachTrial& trial) : trial_(&trial) { CheckTrial(trial); }

const std::vector<SmoothPath>& FilteredTrial::FilterTips(double cutoff) {
  std::vector<SmoothPath>& tips = tips_[cutoff];
  if (tips.empty()) {
    for (const DigitTrack& digit : trial_->digits) tips.push_back(Smooth(digit.tip, cutoff));
  }
  return tips;
}

const ObjectTrack& FilteredTrial::FilterObject(double cutoff) {
  const auto [entry, is_new] = objects_.try_emplace(cutoff);
  if (is_new && trial_->object.IsRecorded()) entry->second = SmoothObject(*trial_, cutoff);
  return entry->second;
}

const std::vector<TipAgainstObject>& FilteredTrial::FilterTipsAgainstObject(double cutoff,
                                                                            double object_cutoff) {
  std::vector<TipAgainstObject>& tips = tips_against_object_[{cutoff, object_cutoff}];
  if (!tips.empty()) return tips;
  const ObjectTrack& object = FilterObject(object_cutoff);
  for (const DigitTrack& digit : trial_->digits) {
    TipAgainstObject tip;
    tip.p_O = ExpressInObject(digit.tip, object);
    tip.smooth = Smooth(tip.p_O, cutoff);
    tip.speed = CalcSpeed(tip.smooth);
    if (object.IsRecorded() && object.distance) {
      tip.distance = CalcCurve(tip.smooth, object.distance);
    }
    tips.push_back(std::move(tip));
  }
  return tips;
}

}  // namespace graspbench
