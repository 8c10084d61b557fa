#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "core/base/units.h"
#include "core/statistics/summary.h"
#include "human_study/events/doubts/plausibility.h"

namespace graspbench {
namespace {

using Column = Eigen::Index;
using Eigen::Vector3d;

constexpr double kCarriedRigid = 5e-3;  // [m] tips that carry a thing stay as far apart as this
constexpr double kObjectStays = 10e-3;  // [m] an object that moved less stayed
constexpr double kRisen = 0.03;      // [m] a hand that closed on a thing takes it as high as this
constexpr double kOpposition = 1.3;  // a digit this many times farther out than the thumb
constexpr double kOpposed = 0.02;    // .. and by this much [m]

/** The sample of an instant; -1 outside. */
int FindSampleAt(const std::vector<double>& times, double time) {
  const SampleRun run = FindSamples(times, time, times.back());
  return run.size() == 0 ? -1 : static_cast<int>(run.first);
}

bool AreAllSeen(const std::vector<SmoothPath>& tips, size_t sample) {
  return std::all_of(tips.begin(), tips.end(),
                     [&](const SmoothPath& tip) { return tip.path.IsValid(sample); });
}

Vector3d FindTipPlace(const SmoothPath& tip, size_t sample) { return tip.path.At(sample); }

/** The thumb's distances, or the first digit's, to all but one of the others are those of `held`. */
bool IsGripOf(const std::vector<SmoothPath>& tips, size_t sample, size_t held) {
  size_t num_loose = 0;
  for (size_t d = 1; d < tips.size(); ++d) {
    const double now = (FindTipPlace(tips[d], sample) - FindTipPlace(tips[0], sample)).norm();
    const double then = (FindTipPlace(tips[d], held) - FindTipPlace(tips[0], held)).norm();
    num_loose += std::abs(now - then) > kCarriedRigid;
  }
  return num_loose == 0 || (tips.size() > 3 && num_loose == 1);
}

/** Samples about `held` in which the digits, where all are seen, are in the same grip. */
SampleRun FindGrip(const std::vector<SmoothPath>& tips, size_t held) {
  const auto is_in_it = [&](size_t i) { return !AreAllSeen(tips, i) || IsGripOf(tips, i, held); };
  SampleRun run{held, held + 1};
  while (run.first > 0 && is_in_it(run.first - 1)) --run.first;
  while (run.last < tips.front().path.size() && is_in_it(run.last)) ++run.last;
  return run;
}

Vector3d FindMiddle(const std::vector<SmoothPath>& tips, size_t sample) {
  Vector3d sum = Vector3d::Zero();
  for (const SmoothPath& tip : tips) sum += FindTipPlace(tip, sample);
  return sum / static_cast<double>(tips.size());
}

/** How one marker goes from each frame to the next. */
struct FrameSteps {
  Eigen::Matrix3Xd own;   ///< what it moves a frame by the frames around; NaN where one is hidden
  Eigen::Matrix3Xd jump;  ///< how far it goes beyond that
  double limit = 0.0;     ///< a jump below is none [m]
};

constexpr Column kSide = 4;  // frames that tell a marker's own motion, before and after

FrameSteps CalcFrameSteps(const Trajectory& track, double interval) {
  constexpr double kLeast = 1e-3, kUsual = 4.0;  // [m], of the usual jump
  constexpr double kJerk = 1000.0;               // of a hand [m/s^3]
  const auto num_frames = static_cast<Column>(track.size());
  FrameSteps steps;
  steps.own = steps.jump = Eigen::Matrix3Xd::Constant(3, num_frames, std::nan(""));
  std::vector<double> jumps;
  for (Column i = kSide; i + kSide <= num_frames; ++i) {
    const auto first = track.states.begin() + (i - kSide);
    if (std::count(first, first + 2 * kSide, SampleState::kInvalid) > 0) continue;
    const auto& p = track.p;
    steps.own.col(i) = (p.col(i - 1) - p.col(i - kSide) + p.col(i + kSide - 1) - p.col(i)) /
                       (2.0 * static_cast<double>(kSide - 1));
    steps.jump.col(i) = p.col(i) - p.col(i - 1) - steps.own.col(i);
    jumps.push_back(steps.jump.col(i).norm());
  }
  const double of_motion = 2.0 * kJerk * std::pow(interval, 3);
  if (jumps.empty()) return steps;
  steps.limit = std::max({kLeast, of_motion, kUsual * CalcMedian(std::move(jumps))});
  return steps;
}

/** The marker moves on as before and after: no single sample is off. */
bool IsKept(const Trajectory& track, const FrameSteps& steps, Column i) {
  const double most = std::max(steps.limit, 0.5 * steps.jump.col(i).norm());
  return (track.p.col(i + 1) - track.p.col(i) - steps.own.col(i)).norm() <= most &&
         (track.p.col(i - 1) - track.p.col(i - 2) - steps.own.col(i)).norm() <= most;
}

}  // namespace

std::vector<Doubt> FindFrameJump(const ReachTrial& trial) {
  constexpr double kFewestFrames = 0.8, kTolerance = 0.5;
  constexpr size_t kEnough = 3;  // markers that show it
  std::vector<Trajectory> tracks;
  for (const DigitTrack& digit : trial.digits) tracks.push_back(digit.tip);
  if (trial.wrist.size() > 0) tracks.push_back(trial.wrist);
  const size_t num_of_hand = tracks.size();
  if (trial.object.IsRecorded()) tracks.push_back(TakeObjectPath(trial));
  const double interval =
      (trial.times.back() - trial.times.front()) / static_cast<double>(trial.times.size() - 1);
  std::vector<FrameSteps> steps;
  for (const Trajectory& track : tracks) steps.push_back(CalcFrameSteps(track, interval));
  const auto num_frames = static_cast<Column>(trial.times.size());
  for (Column i = kSide; i + kSide <= num_frames; ++i) {
    double along = 0.0, squares = 0.0, least = INFINITY, most = 0.0;
    size_t num_seen = 0, num_seen_of_hand = 0, num_jumping = 0, num_jumping_of_hand = 0;
    bool is_kept = true;
    for (size_t m = 0; m < tracks.size(); ++m) {
      const double jump = steps[m].jump.col(i).norm();
      if (std::isnan(jump)) continue;
      const bool does_jump = jump > 2.0 * steps[m].limit;
      ++num_seen;
      num_jumping += does_jump;
      num_seen_of_hand += m < num_of_hand;
      num_jumping_of_hand += m < num_of_hand && does_jump;
      along += steps[m].jump.col(i).dot(steps[m].own.col(i));
      squares += steps[m].own.col(i).squaredNorm();
      least = does_jump ? std::min(least, jump) : least;
      most = std::max(most, jump);
      is_kept = is_kept && IsKept(tracks[m], steps[m], i);
    }
    if (num_jumping == 0 || !is_kept) continue;
    const bool does_hand_jump =
        num_seen_of_hand >= kEnough && num_jumping_of_hand == num_seen_of_hand;
    const double lost = along / squares;  // frames
    bool is_lost = lost >= kFewestFrames && num_jumping >= std::min(kEnough, num_seen);
    for (const FrameSteps& s : steps) {
      const Vector3d skipped = lost * s.own.col(i);
      is_lost =
          is_lost && !((s.jump.col(i) - skipped).norm() > s.limit + kTolerance * skipped.norm());
    }
    if (num_seen < 2 || !(is_lost || does_hand_jump)) continue;
    const std::string cause = is_lost
                                  ? fmt::format("as if {:.0f} frames were missing", lost)
                                  : "as if frames were missing or the frame of reference had moved";
    return {
        {"frame_jump",
         fmt::format("at {:.3f} s {} of {} markers jump together, by {:.0f} to {:.0f} mm beyond "
                     "their own motion, {}: the time stamps do not show it. Export the "
                     "recording again with all its frames",
                     trial.times[static_cast<size_t>(i)], num_jumping, num_seen, MmFromM(least),
                     MmFromM(most), cause)}};
  }
  return {};
}

std::vector<Doubt> FindLeftBehind(const std::vector<SmoothPath>& tips, const ObjectTravel& travel,
                                  const Hold& hold, const LiftOffOptions& lift_off,
                                  const PlausibilityOptions& options) {
  if (options.min_carried == 0.0) return {};
  const std::vector<double>& times = tips.front().path.times;
  int held = hold.IsFound() ? FindSampleAt(times, hold.time) : static_cast<int>(times.size()) - 1;
  while (held >= 0 && !AreAllSeen(tips, static_cast<size_t>(held))) --held;
  if (held < 0) return {};
  const Vector3d up = Vector3d(lift_off.up_x, lift_off.up_y, lift_off.up_z).normalized();
  const SampleRun grip = FindGrip(tips, static_cast<size_t>(held));
  double lowest = INFINITY, risen = 0.0;
  for (size_t i = grip.first; i < grip.last; ++i) {
    if (travel.displacement.At(i) > kObjectStays) return {};
    if (!AreAllSeen(tips, i)) continue;
    const double height = up.dot(FindMiddle(tips, i));
    lowest = std::min(lowest, height);
    risen = std::max(risen, height - lowest);
  }
  if (risen < std::min(kRisen, options.min_carried)) return {};
  return {{"object_left_behind",
           fmt::format("the digits rise {:.0f} mm together and the object's marker stays where it "
                       "was: it is not on what the hand carries. Name the object's own marker "
                       "under markers, or none",
                       MmFromM(risen))}};
}

std::vector<Doubt> FindSwappedThumb(const std::vector<DigitTrack>& digits,
                                    const std::vector<SmoothPath>& tips, const Hold& hold) {
  if (digits.size() < 4 || !digits.front().is_thumb || !hold.IsFound()) return {};
  const int at = FindSampleAt(tips.front().path.times, hold.time);
  if (at < 0 || !AreAllSeen(tips, static_cast<size_t>(at))) return {};
  const auto held = static_cast<size_t>(at);
  Vector3d sum = Vector3d::Zero();
  for (const SmoothPath& tip : tips) sum += FindTipPlace(tip, held);
  // From the middle of all others.
  const auto out_of = [&](size_t d) {
    const Vector3d others =
        (sum - FindTipPlace(tips[d], held)) / static_cast<double>(tips.size() - 1);
    return (FindTipPlace(tips[d], held) - others).norm();
  };
  size_t farthest = 0;
  for (size_t d = 1; d < tips.size(); ++d) {
    if (out_of(d) > out_of(farthest)) farthest = d;
  }
  const double thumb = out_of(0), most = out_of(farthest);
  if (farthest == 0 || most < kOpposition * thumb || most < thumb + kOpposed) return {};
  return {{"thumb_not_opposed",
           fmt::format("in the hold digit {} is opposite all others ({:.0f} mm from their middle), "
                       "the thumb is not ({:.0f} mm): their labels are likely exchanged through "
                       "the whole file. Correct markers in study.yaml",
                       digits[farthest].digit, MmFromM(most), MmFromM(thumb))}};
}

bool MayBeExchanged(const std::vector<DigitTrack>& digits, const std::vector<SmoothPath>& tips,
                    const Trajectory& wrist, double begin, const Hold& hold) {
  constexpr double kNearer = 5e-3;  // [m]
  constexpr size_t kIndex = 1;
  if (digits.size() < 3 || !digits.front().is_thumb || digits[kIndex].digit != "FF") return false;
  const std::vector<double>& times = tips.front().path.times;
  if (wrist.size() != times.size() || !hold.IsFound() || std::isnan(begin)) return false;
  std::vector<double> beyond;  // of the thumb
  const SampleRun reach = FindSamples(times, begin, hold.time);
  for (size_t i = reach.first; i < reach.last; ++i) {
    if (!wrist.IsValid(i) || !tips[0].path.IsValid(i) || !tips[kIndex].path.IsValid(i)) continue;
    const Vector3d from = wrist.At(i);
    beyond.push_back((FindTipPlace(tips[0], i) - from).norm() -
                     (FindTipPlace(tips[kIndex], i) - from).norm());
  }
  if (beyond.empty() || !(CalcMedian(std::move(beyond)) > kNearer)) return false;
  const int at = FindSampleAt(times, hold.time);
  if (at < 0 || !AreAllSeen(tips, static_cast<size_t>(at))) return false;
  const auto held = static_cast<size_t>(at);
  Vector3d others = Vector3d::Zero();
  for (size_t d = kIndex + 1; d < tips.size(); ++d) others += FindTipPlace(tips[d], held);
  others /= static_cast<double>(tips.size() - 2);
  return (FindTipPlace(tips[kIndex], held) - others).norm() >
         (FindTipPlace(tips[0], held) - others).norm();
}

bool GoesElsewhereFirst(const ObjectTravel& travel, const EventTime& lift_off,
                        const LiftOffOptions& options) {
  constexpr double kLeast = 0.02, kShare = 0.3;  // [m], of the rise
  constexpr double kEarlier = 0.05;              // [s]
  if (!lift_off.IsFound()) return false;
  const double height = travel.height.values.maxCoeff<Eigen::PropagateNumbers>();
  const std::vector<ObjectWay> ways =
      FindWaysBeforeRise(travel, std::max(kLeast, kShare * height), options);
  return std::any_of(ways.begin(), ways.end(), [&](const ObjectWay& way) {
    return lift_off.time - way.lift_off.time > kEarlier;
  });
}

}  // namespace graspbench
