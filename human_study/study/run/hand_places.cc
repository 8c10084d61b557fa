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

/** The wrist at that instant, in O. */
std::optional<Vector3d> FindWrist(const ReachTrial& reach, double time) {
  if (reach.wrist.size() != reach.times.size()) return std::nullopt;
  const SampleRun run = FindSamples(reach.times, time, time + kContactSpan);
  for (size_t i = run.first; i < run.last; ++i) {
    if (!reach.wrist.IsValid(i) || reach.object.states[i] == SampleState::kInvalid) continue;
    return Vector3d(reach.object.X_LO[i].inverse() * Vector3d(reach.wrist.At(i)));
  }
  return std::nullopt;
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
    places.digits.push_back({reach.digits[d].digit, *met, *widest});
    way += *met - *widest;
  }
  way /= std::max<double>(1.0, static_cast<double>(places.digits.size()));
  if (way.norm() >= kLeastWay) places.approach_O = way.normalized();
  places.p_OWrist = FindWrist(reach, last);
  return places;
}

HandPlaces CalcMedianPlaces(const std::vector<HandPlaces>& trials) {
  GRASPBENCH_DEMAND(!trials.empty(), "no trial");
  HandPlaces median;
  std::vector<DigitPlaces> all;
  std::vector<Vector3d> wrists, approaches;
  for (const HandPlaces& trial : trials) {
    all.insert(all.end(), trial.digits.begin(), trial.digits.end());
    if (trial.p_OWrist) wrists.push_back(*trial.p_OWrist);
    approaches.push_back(trial.approach_O);
  }
  for (const char* digit : {"TH", "FF", "MF", "RF", "LF"}) {
    std::vector<Vector3d> met, open;
    for (const DigitPlaces& place : all) {
      if (place.digit != digit) continue;
      met.push_back(place.p_OContact);
      open.push_back(place.p_OOpen);
    }
    if (2 * met.size() < trials.size()) continue;
    median.digits.push_back({digit, CalcMedianPlace(met), CalcMedianPlace(open)});
  }
  if (2 * wrists.size() >= trials.size()) median.p_OWrist = CalcMedianPlace(wrists);
  const Vector3d approach = CalcMedianPlace(approaches);
  if (approach.norm() > 0.5) median.approach_O = approach.normalized();
  return median;
}

}  // namespace graspbench
