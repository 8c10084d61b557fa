#include "human_study/study/run/usual_hands.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "core/base/units.h"
#include "core/statistics/summary.h"

namespace graspbench {
namespace {

using Eigen::Vector4d;

constexpr double kOtherWayRound = 2.0;  // |q - m| of |q + m|
constexpr size_t kFewestTrials = 3;

Vector4d CalcMedianPlace(const std::vector<Vector4d>& places) {
  Vector4d median;
  for (Eigen::Index row = 0; row < median.size(); ++row) {
    std::vector<double> values;
    for (const Vector4d& place : places) values.push_back(place[row]);
    median[row] = CalcMedian(std::move(values));
  }
  return median;
}

std::vector<DigitPair> ListPairs(const TrialAnalysis& analysis, const ReachTrial& reach) {
  const double begin = analysis.movement.onset.time, end = analysis.hold.time;
  if (!(begin < end)) return {};
  const SampleRun run = FindSamples(reach.times, begin, end);
  const bool has_wrist = reach.wrist.size() > 0;
  std::vector<DigitPair> pairs;
  for (size_t a = 0; a < reach.digits.size(); ++a) {
    for (size_t b = a + 1; b < reach.digits.size(); ++b) {
      const Trajectory &one = reach.digits[a].tip, &other = reach.digits[b].tip;
      std::vector<Vector4d> places;
      for (size_t i = run.first; i < run.last; ++i) {
        if (!one.IsValid(i) || !other.IsValid(i) || (has_wrist && !reach.wrist.IsValid(i))) {
          continue;
        }
        Vector4d place = Vector4d::Zero();
        place.head<3>() = one.At(i) - other.At(i);
        if (has_wrist) {
          place[3] =
              (one.At(i) - reach.wrist.At(i)).norm() - (other.At(i) - reach.wrist.At(i)).norm();
        }
        places.push_back(place);
      }
      if (places.empty()) continue;
      pairs.push_back({reach.digits[a].digit, reach.digits[b].digit, CalcMedianPlace(places)});
    }
  }
  return pairs;
}

bool IsOtherWayRound(const Vector4d& place, const Vector4d& usual) {
  return (place - usual).norm() > kOtherWayRound * (place + usual).norm();
}

std::string MakeKey(const PlannedReach& planned, const std::string& object, const DigitPair& pair) {
  return planned.participant + "\n" + planned.hand + "\n" + object + "\n" + pair.one + pair.other;
}

const char* const kAnyObject = "\n";

}  // namespace

void UsualHands::Add(const PlannedReach& planned, const TrialAnalysis& analysis,
                     const ReachTrial& reach) {
  for (const DigitPair& pair : ListPairs(analysis, reach)) {
    places_[MakeKey(planned, planned.object, pair)].push_back(pair.place);
    places_[MakeKey(planned, kAnyObject, pair)].push_back(pair.place);
  }
}

std::optional<Vector4d> UsualHands::FindUsual(const PlannedReach& planned,
                                              const DigitPair& pair) const {
  auto found = places_.find(MakeKey(planned, planned.object, pair));
  if (found == places_.end() || found->second.size() < kFewestTrials) {
    found = places_.find(MakeKey(planned, kAnyObject, pair));
  }
  if (found == places_.end() || found->second.size() < kFewestTrials) return std::nullopt;
  const Vector4d usual = CalcMedianPlace(found->second);
  const auto num_agreeing = static_cast<size_t>(
      std::count_if(found->second.begin(), found->second.end(),
                    [&](const Vector4d& place) { return IsOtherWayRound(-place, usual); }));
  if (3 * num_agreeing < 2 * found->second.size()) return std::nullopt;
  return usual;
}

bool UsualHands::FitsExchanged(const PlannedReach& planned, const std::vector<DigitPair>& pairs,
                               const DigitPair& exchanged) const {
  const auto relabel = [&](const std::string& digit) {
    return digit == exchanged.one     ? exchanged.other
           : digit == exchanged.other ? exchanged.one
                                      : digit;
  };
  return std::none_of(pairs.begin(), pairs.end(), [&](const DigitPair& pair) {
    const std::string one = relabel(pair.one), other = relabel(pair.other);
    for (const double sign : {1.0, -1.0}) {
      const DigitPair corrected = {sign > 0.0 ? one : other, sign > 0.0 ? other : one,
                                   sign * pair.place};
      const std::optional<Vector4d> usual = FindUsual(planned, corrected);
      if (usual && (corrected.place - *usual).norm() > (corrected.place + *usual).norm()) {
        return true;
      }
    }
    return false;
  });
}

std::vector<Doubt> UsualHands::FindExchange(const PlannedReach& planned,
                                            const TrialAnalysis& analysis,
                                            const ReachTrial& reach) const {
  const std::vector<DigitPair> pairs = ListPairs(analysis, reach);
  double best = kOtherWayRound;
  std::vector<Doubt> doubts;
  for (const DigitPair& pair : pairs) {
    const std::optional<Vector4d> usual = FindUsual(planned, pair);
    if (!usual) continue;
    const double off = (pair.place - *usual).norm(), off_exchanged = (pair.place + *usual).norm();
    if (!(off > best * off_exchanged) || !FitsExchanged(planned, pairs, pair)) continue;
    best = off / off_exchanged;
    const std::string one = NameOfDigit(pair.one), other = NameOfDigit(pair.other);
    doubts = {
        {"labels_exchanged",
         fmt::format(
             "{} and {} are where {} and {} are in the person's other trials: {:.0f} mm from their "
             "usual places against each other, {:.0f} mm with their labels exchanged. Correct the "
             "labels through this whole trial, or name the hand in trials.csv, if it was the other "
             "one",
             one, other, other, one, MmFromM(off), MmFromM(off_exchanged))}};
  }
  return doubts;
}

}  // namespace graspbench
