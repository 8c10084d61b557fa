#include "human_study/study/run/hand_places.h"

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/statistics/summary.h"
#include "human_study/events/filtered_trial.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

constexpr double kContactSpan = 0.05;  ///< [s]
constexpr double kLeastWay = 0.01;     ///< of a hand that moves to the object [m]

Vector3d CalcMedianPlace(const std::vector<Vector3d>& places) {
  Vector3d median;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> values;
    for (const Vector3d& place : places) values.push_back(place[axis]);
    median[axis] = CalcMedian(values);
  }
  return median;
}

/** Of the valid samples of an interval, in O; nothing: there is none. */
std::optional<Vector3d> FindPlace(const Trajectory& path, double begin, double end) {
  const SampleRun run = FindSamples(path.times, begin, end);
  std::vector<Vector3d> places;
  for (size_t i = run.first; i < run.last; ++i) {
    if (path.IsValid(i)) places.emplace_back(path.At(i));
  }
  if (places.empty()) return std::nullopt;
  return CalcMedianPlace(places);
}

/** A landmark of the reach from that instant on, in O, behind no filter. */
std::optional<Vector3d> FindLandmark(const ReachTrial& reach, const Trajectory& path, double time) {
  if (path.size() != reach.times.size()) return std::nullopt;
  const SampleRun run = FindSamples(reach.times, time, time + kContactSpan);
  std::vector<Vector3d> places;
  for (size_t i = run.first; i < run.last; ++i) {
    if (!path.IsValid(i) || reach.object.states[i] == SampleState::kInvalid) continue;
    places.emplace_back(reach.object.X_LO[i].inverse() * Vector3d(path.At(i)));
  }
  if (places.empty()) return std::nullopt;
  return CalcMedianPlace(places);
}

/** Of all joints of a digit; none where one is hidden. */
std::vector<Vector3d> FindJoints(const ReachTrial& reach, const DigitTrack& digit, double time) {
  std::vector<Vector3d> places;
  for (const Trajectory& joint : digit.joints) {
    const std::optional<Vector3d> place = FindLandmark(reach, joint, time);
    if (!place) return {};
    places.push_back(*place);
  }
  return places;
}

/** Adds to each digit where it was before contact, as long as all have a place. */
void FollowBack(const std::vector<const Trajectory*>& paths, double contact, double onset,
                double half, HandPlaces& places) {
  for (DigitPlaces& digit : places.digits) digit.p_OCourse = {digit.p_OContact};
  for (int k = 1;; ++k) {
    const double time = contact - k * kCoursePeriod;
    if (time < onset) return;
    std::vector<Vector3d> found;
    for (const Trajectory* path : paths) {
      const std::optional<Vector3d> place = FindPlace(*path, time - half, time + half);
      if (!place) return;
      found.push_back(*place);
    }
    for (size_t d = 0; d < found.size(); ++d) places.digits[d].p_OCourse.push_back(found[d]);
  }
}

/** Of the places that trials have, where half of the trials or more have one. */
template <class ListPlace>
std::optional<Vector3d> CalcMedianOf(const std::vector<HandPlaces>& trials,
                                     const ListPlace& list_place) {
  std::vector<Vector3d> places;
  for (const HandPlaces& trial : trials) {
    if (const std::optional<Vector3d> place = list_place(trial)) places.push_back(*place);
  }
  if (places.empty() || 2 * places.size() < trials.size()) return std::nullopt;
  return CalcMedianPlace(places);
}

}  // namespace

Answer<HandPlaces> FindHandPlaces(const TrialAnalysis& analysis, const ReachTrial& reach,
                                  const AnalysisOptions& stated) {
  if (!reach.object.IsRecorded()) {
    return NoAnswer{"the object's pose was not recorded (markers.object of study.yaml)"};
  }
  if (!analysis.closure_start.IsFound()) {
    return NoAnswer{"the widest opening is missing: " + analysis.closure_start.missing};
  }
  const double last = FindLastContact(analysis.contacts);
  if (std::isnan(last)) return NoAnswer{"no digit has a contact"};
  const AnalysisOptions options = FitCutoffs(stated, CalcRate(reach));
  FilteredTrial filtered(reach);
  const std::vector<TipAgainstObject>& tips =
      filtered.FilterTipsAgainstObject(options.contact.cutoff, options.contact.object_cutoff);
  const double open = analysis.closure_start.time, half = 0.5 / CalcRate(reach);
  HandPlaces places;
  std::vector<const Trajectory*> paths;
  Vector3d way = Vector3d::Zero();
  for (size_t d = 0; d < tips.size(); ++d) {
    const EventTime& contact = analysis.contacts[d].contact;
    if (!contact.IsFound() && !IsUnresolved(contact)) continue;
    const Trajectory& path = tips[d].smooth.path;
    const std::optional<Vector3d> met = FindPlace(path, last, last + kContactSpan);
    const std::optional<Vector3d> widest = FindPlace(path, open - half, open + half);
    if (!met || !widest) {
      return NoAnswer{reach.digits[d].digit + " is hidden at " +
                      (met ? "the widest opening" : "contact")};
    }
    places.digits.push_back({reach.digits[d].digit,
                             *met,
                             *widest,
                             FindJoints(reach, reach.digits[d], last),
                             FindJoints(reach, reach.digits[d], open - half),
                             contact.IsFound() ? contact.time : kUnset,
                             {}});
    paths.push_back(&path);
    way += *met - *widest;
  }
  way /= std::max<double>(1.0, static_cast<double>(places.digits.size()));
  if (way.norm() >= kLeastWay) places.approach_O = way.normalized();
  double first = last;
  for (const DigitPlaces& digit : places.digits) first = std::min(first, digit.lag);
  for (DigitPlaces& digit : places.digits) digit.lag -= first;
  const EventTime& onset = analysis.movement.onset;
  const double met = last + 0.5 * kContactSpan;
  FollowBack(paths, met, onset.IsFound() ? onset.time : reach.times.front(),
             std::max(half, 0.5 * kCoursePeriod), places);
  places.from_widest = met - open;
  places.p_OWrist = FindLandmark(reach, reach.wrist, last);
  return places;
}

HandPlaces CalcMedianPlaces(const std::vector<HandPlaces>& trials) {
  GRASPBENCH_DEMAND(!trials.empty(), "no trial");
  HandPlaces median;
  for (const char* name : {"TH", "FF", "MF", "RF", "LF"}) {
    std::vector<HandPlaces> own;  // with that digit alone
    std::vector<double> lags;
    for (const HandPlaces& trial : trials) {
      for (const DigitPlaces& digit : trial.digits) {
        if (digit.digit != name) continue;
        own.emplace_back().digits = {digit};
        if (std::isfinite(digit.lag)) lags.push_back(digit.lag);
      }
    }
    if (own.empty() || 2 * own.size() < trials.size()) continue;
    const auto calc_chain = [&](std::vector<Vector3d> DigitPlaces::*joints) {
      std::vector<Vector3d> chain;
      for (size_t j = 0;; ++j) {
        const std::optional<Vector3d> place = CalcMedianOf(own, [&](const HandPlaces& trial) {
          const std::vector<Vector3d>& all = trial.digits.front().*joints;
          return j < all.size() ? std::optional(all[j]) : std::nullopt;
        });
        if (!place) return chain;
        chain.push_back(*place);
      }
    };
    const auto calc_place = [&](Vector3d DigitPlaces::*place) {
      return *CalcMedianOf(own, [&](const HandPlaces& trial) {
        return std::optional<Vector3d>(trial.digits.front().*place);
      });
    };
    median.digits.push_back({name, calc_place(&DigitPlaces::p_OContact),
                             calc_place(&DigitPlaces::p_OOpen), calc_chain(&DigitPlaces::p_OJoints),
                             calc_chain(&DigitPlaces::p_OOpenJoints), CalcMedian(lags),
                             calc_chain(&DigitPlaces::p_OCourse)});
  }
  std::vector<double> from_widest;
  for (const HandPlaces& trial : trials) from_widest.push_back(trial.from_widest);
  median.from_widest = CalcMedian(from_widest);
  median.p_OWrist = CalcMedianOf(trials, [](const HandPlaces& trial) { return trial.p_OWrist; });
  const Vector3d approach = *CalcMedianOf(
      trials, [](const HandPlaces& trial) { return std::optional<Vector3d>(trial.approach_O); });
  if (approach.norm() > 0.5) median.approach_O = approach.normalized();
  return median;
}

}  // namespace graspbench
