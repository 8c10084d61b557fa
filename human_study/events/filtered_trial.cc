#include "human_study/events/filtered_trial.h"

#include <fmt/core.h>

#include <cmath>
#include <optional>

#include "core/base/units.h"
#include "core/statistics/summary.h"
#include "human_study/events/approach.h"
#include "human_study/events/hand_course.h"

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

/** SD of a coordinate, from third differences: smooth motion has small ones. */
double CalcNoise(const Trajectory& path) {
  const double kSdOfDifference = std::sqrt(20.0);  // 1 + 9 + 9 + 1
  std::vector<double> differences;
  for (size_t i = 3; i < path.size(); ++i) {
    bool is_measured = true;
    for (size_t k = i - 3; k <= i; ++k) is_measured &= path.states[k] == SampleState::kMeasured;
    if (!is_measured) continue;
    const auto at = static_cast<Column>(i);
    differences.push_back(
        (path.p.col(at) - 3.0 * path.p.col(at - 1) + 3.0 * path.p.col(at - 2) - path.p.col(at - 3))
            .norm());
  }
  // No marker is known better than this.
  constexpr double kLeast = 2e-5;
  if (differences.empty()) return kLeast;
  return std::max(kLeast, CalcMedian(std::move(differences)) / (kMedianPerSd * kSdOfDifference));
}

/** RMS of a coordinate between 6 and 16 Hz while the hand is free, without its white noise. Half of
the samples decide (median), so that corners of the path do not. */
double CalcTremor(const Trajectory& path, double hold) {
  constexpr double kSlowest = 6.0, kFastest = 16.0;  // [Hz]
  constexpr double kBeating = 1.4;  // waves that beat are small half of the time, edges are cut off
  const double interval = path.times[1] - path.times[0];
  if (!(kFastest * interval < 0.4)) return 0.0;  // too slow a recording to tell
  const SmoothPath above = Smooth(path, kFastest), below = Smooth(path, kSlowest);
  const SampleRun run = FindSamples(path.times, path.times.front(), hold);
  std::vector<double> sizes;
  for (size_t i = run.first; i < run.last; ++i) {
    const auto at = static_cast<Column>(i);
    if (above.path.IsValid(i) && below.path.IsValid(i)) {
      sizes.push_back((above.path.p.col(at) - below.path.p.col(at)).norm());
    }
  }
  if (sizes.empty()) return 0.0;
  const double size = CalcMedian(std::move(sizes)) / kMedianPerSd;
  const double white =
      above.smooth_noise * above.smooth_noise - below.smooth_noise * below.smooth_noise;
  return kBeating * std::sqrt(std::max(0.0, size * size - white));
}

TouchFit FitIfSeen(const TouchSamples& samples) {
  // A sudden stop before the last one is the touch, unless it goes on farther than skin gives way.
  constexpr double kEarlier = 0.99, kEarlierOfFar = 0.5;  // how likely it is
  constexpr double kSkin = 2e-3, kFar = 4e-3;             // [m]
  TouchFit fit;
  if (samples.times.empty()) {
    fit.missing = "no approach to its place in the hold is seen";
    return fit;
  }
  fit = FitTouch(samples);
  if (!fit.missing.empty()) return fit;
  const TouchSamples stop = TakeEarlierStop(samples, CalcStopTime(fit));
  if (stop.times.empty()) return fit;
  const TouchFit earlier = FitTouch(stop);
  if (!earlier.missing.empty()) return fit;
  const double goes_on = samples.places.front() - stop.places.front();
  const double far = std::clamp((goes_on - kSkin) / (kFar - kSkin), 0.0, 1.0);
  return MixFits(fit, earlier, kEarlier + far * (kEarlierOfFar - kEarlier));
}

/** The last stop on the way to the place. Two stops that may both be the touch are both weighed. */
TouchFit FitPath(const TipAgainstObject& tip, const ObjectTrack& object, double tremor,
                 const Eigen::Vector3d& place, const Hold& hold) {
  constexpr int kMaxTurns = 3;
  Eigen::Vector3d from = Eigen::Vector3d::Constant(std::nan(""));
  double after = -INFINITY;
  std::optional<TouchFit> earlier;
  double share = 0.0;
  for (int turn = 0; turn < kMaxTurns; ++turn) {
    TouchSamples samples = TakeApproachToPlace(tip.p_O, place, hold, tip.noise, from, after);
    samples.tremor = tremor;
    if (object.IsRecorded()) {
      AddObjectMotion(tip.p_O.times, object.X_LO, place, samples.direction, samples);
    }
    const TouchFit fit = FitIfSeen(samples);
    if (earlier) return fit.missing.empty() ? MixFits(*earlier, fit, share) : *earlier;
    if (!fit.missing.empty()) return fit;
    const double touch = CalcStopTime(fit);
    const LateMotion late =
        FindLateMotion(tip.p_O, place, hold, tip.noise, touch, samples.direction);
    share = late.share;
    if (share == 0.0) return fit;
    if (share < 1.0) earlier = fit;
    from = late.from;
    after = touch;
  }
  TouchFit fit;
  fit.missing = "it never comes to rest in all directions at once";
  return fit;
}

/** The touch of the surface, after which a tip does not go far. */
TouchFit FitSurface(const TipAgainstObject& tip, const ObjectTrack& object, double tremor,
                    const Eigen::Vector3d& place, const Hold& hold, double pad_offset) {
  TouchSamples samples =
      TakeApproachToSurface(tip.p_O, object.distance, place, hold, tip.noise, pad_offset);
  samples.tremor = tremor;
  AddObjectMotion(tip.p_O.times, object.X_LO, place, FindNormal(object.distance, place), samples);
  TouchFit fit = FitIfSeen(samples);
  if (!fit.missing.empty()) return fit;
  const LateMotion late =
      FindLateMotion(tip.p_O, place, hold, tip.noise, CalcStopTime(fit), Eigen::Vector3d::Zero());
  if (late.share == 1.0) {
    fit.missing =
        fmt::format("it comes to the surface {:.0f} mm from where it holds", MmFromM(late.way));
  }
  return fit;
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

std::shared_ptr<const HandCourse> FilteredTrial::FollowHand(double cutoff) {
  std::shared_ptr<const HandCourse>& hand = hands_[cutoff];
  if (!hand) hand = std::make_shared<const HandCourse>(CalcHandCourse(*this, cutoff));
  return hand;
}

const ObjectTrack& FilteredTrial::FilterObject(double cutoff) {
  const auto [entry, is_new] = objects_.try_emplace(cutoff);
  if (!is_new || !trial_->object.IsRecorded()) return entry->second;
  // A thing that is pushed starts at once, and its middle is known better than its turn.
  const double interval = trial_->times[1] - trial_->times[0];
  const double of_middle = std::max(cutoff, std::min(2.0 * cutoff, 0.35 / interval));
  entry->second = SmoothObject(*trial_, of_middle, cutoff);
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
    tip.noise = std::hypot(CalcNoise(digit.tip), object.smooth_noise);
    tip.smooth_noise = std::hypot(tip.smooth.smooth_noise, object.smooth_noise);
    tip.speed = CalcSpeed(tip.smooth);
    if (object.IsRecorded() && object.distance) {
      tip.distance = CalcCurve(tip.smooth, object.distance);
    }
    tips.push_back(std::move(tip));
  }
  return tips;
}

const std::vector<TouchFits>& FilteredTrial::FitTouches(const std::vector<TipAgainstObject>& tips,
                                                        const Hold& hold, double object_cutoff) {
  std::vector<TouchFits>& fits = touch_fits_[{hold.time, hold.begin, hold.end, object_cutoff}];
  if (!fits.empty()) return fits;
  const ObjectTrack& object = FilterObject(object_cutoff);
  for (size_t i = 0; i < tips.size(); ++i) {
    const TipAgainstObject& tip = tips[i];
    const Eigen::Vector3d place = FindHoldPlace(tip.p_O, hold);
    TouchFits fit;
    const double tremor = CalcTremor(trial_->digits[i].tip, hold.time);
    fit.path = FitPath(tip, object, tremor, place, hold);
    if (object.IsRecorded() && object.distance) {
      fit.surface = FitSurface(tip, object, tremor, place, hold, trial_->digits[i].pad_offset);
    } else {
      fit.surface.missing = "the object's pose or shape is not known";
    }
    fits.push_back(std::move(fit));
  }
  return fits;
}

}  // namespace graspbench
