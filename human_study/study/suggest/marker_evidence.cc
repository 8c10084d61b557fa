#include <algorithm>
#include <cmath>
#include <set>

#include "core/statistics/summary.h"
#include "human_study/study/suggest/suggest_settings.h"

namespace graspbench {
namespace {

constexpr double kMaxSpread = 0.008, kMaxDistance = 0.08;  // [m]
constexpr double kMiddle = 3.29;  // SD of a normal that hold its middle 90 %

/** The value below which that share of them lies. @pre not empty. */
double FindQuantile(std::vector<double> values, double share) {
  const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[static_cast<size_t>(at)];
}

/** Distances where both are seen [m]. */
std::vector<double> ListDistances(const Trajectory& a, const Trajectory& b) {
  std::vector<double> distances;
  for (size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    if (!a.IsValid(i) || !b.IsValid(i)) continue;
    const auto column = static_cast<Eigen::Index>(i);
    distances.push_back((a.p.col(column) - b.p.col(column)).norm());
  }
  return distances;
}

double FindSpread(const std::vector<double>& values) {
  return 0.5 * (FindQuantile(values, 0.95) - FindQuantile(values, 0.05));
}

/** SD of white noise by second differences, most of which hold no motion. */
double FindNoise(const std::vector<double>& values) {
  std::vector<double> sizes;
  for (size_t i = 2; i < values.size(); ++i) {
    sizes.push_back(std::abs(values[i] - 2.0 * values[i - 1] + values[i - 2]));
  }
  return sizes.empty() ? 0.0 : CalcMedian(std::move(sizes)) / (0.6745 * std::sqrt(6.0));
}

const std::string* FindTipLabel(const std::vector<std::string>& wanted,
                                const std::set<std::string>& labels) {
  const auto found = std::find_if(wanted.begin(), wanted.end(),
                                  [&](const auto& label) { return labels.count(label) > 0; });
  return found == wanted.end() ? nullptr : &*found;
}

}  // namespace

std::vector<CompanionEvidence> FindCompanions(const Recording& recording,
                                              const MarkerConfig& markers) {
  std::set<std::string> labels, used(markers.object.begin(), markers.object.end());
  for (const RecordedPoint& point : recording.points) labels.insert(point.label);
  for (int digit = 0; digit < PerDigit<int>::kNumDigits; ++digit) {
    used.insert(markers.tips[digit].begin(), markers.tips[digit].end());
  }
  std::vector<CompanionEvidence> found;
  for (int digit = 0; digit < PerDigit<int>::kNumDigits; ++digit) {
    const std::string* label = FindTipLabel(markers.tips[digit], labels);
    if (label == nullptr || !markers.companions[digit].empty()) continue;
    const Trajectory tip = MakeTrajectory(recording, *label);
    CompanionEvidence best;
    best.spread = kMaxSpread;
    for (const std::string& other : labels) {
      if (used.count(other) > 0) continue;
      const Trajectory track = MakeTrajectory(recording, other);
      const std::vector<double> distances = ListDistances(tip, track);
      if (distances.size() < 100) continue;
      CompanionEvidence evidence = {
          digit, *label, other, 0, 0, CalcMedian(distances), FindSpread(distances)};
      for (size_t i = 0; i < tip.size(); ++i) {
        if (tip.IsValid(i)) continue;
        ++evidence.num_hidden;
        evidence.num_bridged += track.IsValid(i);
      }
      const bool helps = evidence.num_hidden > 0 && 2 * evidence.num_bridged >= evidence.num_hidden;
      if (helps && evidence.distance < kMaxDistance && evidence.spread < best.spread) {
        best = evidence;
      }
    }
    if (!best.companion.empty()) found.push_back(best);
  }
  return found;
}

double FindYield(const PreparedRecording& recording) {
  double most = 0.0;
  const std::vector<Trajectory>& markers = recording.object_markers;
  for (size_t a = 0; a < markers.size(); ++a) {
    for (size_t b = a + 1; b < markers.size(); ++b) {
      const std::vector<double> distances = ListDistances(markers[a], markers[b]);
      if (distances.empty()) continue;
      const double all = 2.0 * FindSpread(distances), noise = kMiddle * FindNoise(distances);
      most = std::max(most, std::sqrt(std::max(0.0, all * all - noise * noise)));
    }
  }
  return most;
}

std::optional<CutConfig> FindCut(const PreparedRecording& recording) {
  std::vector<double> distances;
  for (const double distance : CalcHandDistances(recording)) {
    if (!std::isnan(distance)) distances.push_back(distance);
  }
  if (distances.empty()) return std::nullopt;
  const double at_object = FindQuantile(distances, 0.1), away = FindQuantile(distances, 0.9);
  const auto round = [](double length) { return std::round(100.0 * length) / 100.0; };
  CutConfig cut;
  cut.near = round(at_object + 0.25 * (away - at_object));
  cut.far = round(at_object + 0.5 * (away - at_object));
  if (!(cut.near > 0.0 && cut.far > cut.near)) return std::nullopt;
  if (FindReaches(recording, cut).size() < 3) return std::nullopt;
  return cut;
}

}  // namespace graspbench
