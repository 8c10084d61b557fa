#include "human_study/study/run/recording_faults.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "core/base/text/text.h"
#include "core/base/units.h"
#include "core/statistics/summary.h"

namespace graspbench {
namespace {

std::vector<Doubt> FindLostFrames(const PreparedRecording& recording, const ReachTrial& trial) {
  constexpr double kTolerable = 0.01;  // [s]
  double lost = 0.0;
  size_t num_places = 0;
  for (const FrameLoss& loss : recording.frame_losses) {
    const double time = recording.times[loss.sample];
    if (time < trial.times.front() || time > trial.times.back()) continue;
    lost += loss.count / recording.rate;
    ++num_places;
  }
  if (lost < kTolerable && num_places < 2) return {};
  return {{"frame_jump",
           fmt::format("in {} all markers go on by more than one of their own steps, in sum "
                       "by {:.0f} ms, as if frames were missing: the time stamps do not show it, "
                       "and frames lost at rest leave no trace. Export the recording again with "
                       "all its frames",
                       FormatCount(static_cast<int64_t>(num_places), "place"), MsFromS(lost))}};
}

/** Range of the middle 98 % of the distances between two digits; NaN where both are hardly seen. */
double CalcRange(const Trajectory& one, const Trajectory& other) {
  constexpr size_t kEnough = 20;
  std::vector<double> distances;
  for (size_t i = 0; i < one.size(); ++i) {
    if (one.IsValid(i) && other.IsValid(i)) distances.push_back((one.At(i) - other.At(i)).norm());
  }
  if (distances.size() < kEnough) return std::nan("");
  std::sort(distances.begin(), distances.end());
  return CalcSortedQuantile(distances, 0.99) - CalcSortedQuantile(distances, 0.01);
}

/** Between the farthest places of a digit along one axis. */
double CalcTravel(const Trajectory& track) {
  double travel = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    double low = INFINITY, high = -INFINITY;
    for (size_t i = 0; i < track.size(); ++i) {
      if (!track.IsValid(i)) continue;
      low = std::min(low, track.At(i)(axis));
      high = std::max(high, track.At(i)(axis));
    }
    travel = std::max(travel, high - low);
  }
  return travel;
}

std::vector<Doubt> FindConstantShape(const ReachTrial& trial) {
  constexpr double kSame = 3e-3, kTravels = 0.1;  // [m]
  const std::vector<DigitTrack>& digits = trial.digits;
  if (digits.size() < 3 || !(CalcTravel(digits.front().tip) > kTravels)) return {};
  double largest = 0.0;
  for (size_t a = 0; a < digits.size(); ++a) {
    for (size_t b = a + 1; b < digits.size(); ++b) {
      const double range = CalcRange(digits[a].tip, digits[b].tip);
      if (!(range < kSame)) return {};
      largest = std::max(largest, range);
    }
  }
  return {{"constant_shape",
           fmt::format("the digits keep their distances within {:.1f} mm through the whole trial: "
                       "a hand model, not measured digits. Export the digits' own markers",
                       MmFromM(largest))}};
}

std::vector<Doubt> FindExchangedMarkers(const PreparedRecording& recording,
                                        const ReachTrial& trial) {
  const ExchangedMarkers* first = nullptr;
  double last = 0.0;
  for (const ExchangedMarkers& exchange : recording.exchanges) {
    if (exchange.time <= trial.times.front() || exchange.time > trial.times.back()) continue;
    if (first == nullptr) first = &exchange;
    last = exchange.time;
  }
  if (first == nullptr) return {};
  const std::string again =
      last > first->time ? fmt::format(" (the last such frame is at {:.3f} s)", last) : "";
  return {{"label_jump",
           fmt::format("at {:.3f} s the marker of {} goes on where that of {} was, {:.0f} mm from "
                       "its own course, and that of {} is no longer there{}: their labels are "
                       "exchanged. Correct the labels in the recording",
                       first->time, first->label, first->other, MmFromM(first->distance),
                       first->other, again)}};
}

}  // namespace

std::vector<Doubt> FindRecordingFaults(const PreparedRecording& recording,
                                       const ReachTrial& trial) {
  std::vector<Doubt> doubts = FindExchangedMarkers(recording, trial);
  for (Doubt& doubt : FindLostFrames(recording, trial)) doubts.push_back(std::move(doubt));
  for (Doubt& doubt : FindConstantShape(trial)) doubts.push_back(std::move(doubt));
  return doubts;
}

}  // namespace graspbench
