#include "human_study/events/regrasp.h"

#include <algorithm>

namespace graspbench {
namespace {

constexpr double kAtPlace = 2e-3, kLeftPlace = 4e-3;  // [m]
constexpr double kAtPlaceNoise = 3.0, kLeftPlaceNoise = 6.0;

}  // namespace

Regrasp FindRegrasp(const ScalarCurve& departure, double begin, double contact) {
  const double at_place = std::max(kAtPlace, kAtPlaceNoise * departure.noise);
  const double left = std::max(kLeftPlace, kLeftPlaceNoise * departure.noise);
  const SampleRun run = FindSamples(departure.times, begin, contact);
  const auto value = [&](size_t i) { return departure.values[static_cast<Eigen::Index>(i)]; };
  Regrasp regrasp;
  regrasp.first_touch = regrasp.release = MissingEvent("it touched once");
  size_t first = run.first;
  while (first < run.last && !(departure.IsValid(first) && value(first) < at_place)) ++first;
  size_t farthest = first;
  for (size_t i = first; i < run.last; ++i) {
    if (departure.IsValid(i) && value(i) > value(farthest)) farthest = i;
  }
  if (first >= run.last || first == 0 || !(value(farthest) > left)) return regrasp;
  regrasp.left_by = value(farthest);
  regrasp.first_touch = TraceBack(departure, first, first - 1, at_place, Side::kBelow);
  regrasp.release = TraceBack(departure, farthest, first, at_place, Side::kAbove);
  return regrasp;
}

}  // namespace graspbench
