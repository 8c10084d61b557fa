#include "human_study/events/contact_detector.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/statistics/summary.h"
#include "human_study/events/detectors/detector_list.h"

namespace graspbench {
namespace {

using Column = Eigen::Index;

/** Valid samples about the hold. */
std::vector<Column> FindHoldSamples(const ScalarCurve& curve, const Hold& hold) {
  const SampleRun window = FindSamples(curve.times, std::max(hold.begin, hold.time - 0.05),
                                       std::min(hold.end, hold.time + 0.1));
  std::vector<Column> samples;
  for (size_t i = window.first; i < window.last; ++i) {
    if (curve.IsValid(i)) samples.push_back(static_cast<Column>(i));
  }
  const int nearest = FindHoldSample(curve, hold);
  if (samples.empty() && nearest >= 0) samples.push_back(nearest);
  return samples;
}

/** Median about the hold; NaN when hidden there. */
double CalcHoldMedian(const ScalarCurve& curve, const Hold& hold) {
  std::vector<double> values;
  for (const Column i : FindHoldSamples(curve, hold)) values.push_back(curve.values[i]);
  return CalcMedian(std::move(values));
}

/** Mean place about the hold; NaN when hidden there. */
Eigen::Vector3d CalcHoldPlace(const SmoothPath& smooth, const ScalarCurve& speed,
                              const Hold& hold) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  const std::vector<Column> samples = FindHoldSamples(speed, hold);
  for (const Column i : samples) sum += smooth.path.p.col(i);
  return sum / static_cast<double>(samples.size());
}

}  // namespace

ContactEvidence MakeContactEvidence(FilteredTrial& trial, const ScalarCurve& opening,
                                    const ScalarCurve& object_displacement, double begin,
                                    const Hold& hold, const ContactOptions& options) {
  ContactEvidence evidence;
  evidence.begin = begin;
  evidence.hold = hold;
  evidence.opening = opening;
  evidence.object_displacement = object_displacement;
  const std::vector<TipAgainstObject>& tips =
      trial.FilterTipsAgainstObject(options.cutoff, options.object_cutoff);
  for (size_t i = 0; i < tips.size(); ++i) {
    const TipAgainstObject& tip = tips[i];
    DigitEvidence digit;
    digit.track = &trial.trial().digits[i];
    digit.p_O = tip.p_O;
    digit.speed = tip.speed;
    const Eigen::Vector3d place = CalcHoldPlace(tip.smooth, digit.speed, hold);
    digit.departure =
        CalcCurve(tip.smooth, [&](const Eigen::Vector3d& p_O) { return (p_O - place).norm(); });
    digit.distance = tip.distance;
    if (digit.distance.size() > 0) digit.hold_distance = CalcHoldMedian(digit.distance, hold);
    evidence.digits.push_back(std::move(digit));
  }
  return evidence;
}

int FindHoldSample(const ScalarCurve& curve, const Hold& hold) {
  const SampleRun samples = FindSamples(curve.times, hold.begin, hold.end);
  int nearest = -1;
  for (size_t i = samples.first; i < samples.last; ++i) {
    if (!curve.IsValid(i)) continue;
    const bool is_nearer =
        nearest < 0 || std::abs(curve.times[i] - hold.time) <
                           std::abs(curve.times[static_cast<size_t>(nearest)] - hold.time);
    if (is_nearer) nearest = static_cast<int>(i);
  }
  return nearest;
}

std::string FindNoTouch(const ContactEvidence& evidence, const DigitEvidence& digit,
                        const ContactOptions& options) {
  const double speed = CalcHoldMedian(digit.speed, evidence.hold);
  if (std::isnan(speed)) return "the digit is hidden in the hold";
  if (digit.hold_distance > options.max_pad_offset) {
    return fmt::format("in the hold its marker is {:.0f} mm from the surface",
                       MmFromM(digit.hold_distance));
  }
  // Below four standard deviations noise alone may look like motion.
  if (speed > std::max(options.speed_threshold, 4.0 * digit.speed.noise)) {
    return fmt::format("in the hold it moves at {:.0f} mm/s against the object", MmFromM(speed));
  }
  return "";
}

EventTime FindArrival(const ScalarCurve& distance, const ContactEvidence& evidence,
                      double tolerance) {
  // A slower approach is not extrapolated as such: the contact would lie too far away [m/s].
  constexpr double kMinClosingSpeed = 0.02;
  const int hold = FindHoldSample(distance, evidence.hold);
  if (hold < 0) return MissingEvent("the digit is hidden in the hold");
  const size_t first = FindSamples(distance.times, evidence.begin, evidence.hold.time).first;
  EventTime event =
      TraceBack(distance, static_cast<size_t>(hold), first, tolerance, Side::kBelow, kMinApproach);
  if (!event.IsFound() || event.is_in_gap) return event;
  const size_t after = FindSamples(distance.times, event.time, distance.times.back()).first;
  const auto column = static_cast<Column>(after);
  const double speed = (distance.values[column - 1] - distance.values[column]) /
                       (distance.times[after] - distance.times[after - 1]);
  event.time += tolerance / std::max(kMinClosingSpeed, speed);
  return event;
}

const std::vector<ContactDetector>& ContactDetectorList() {
  static const std::vector<ContactDetector> detectors = {
#define GRASPBENCH_DETECTOR(name) Make##name##Detector(),
#include "human_study/events/detectors/detector_list.inc"
#undef GRASPBENCH_DETECTOR
  };
  return detectors;
}

size_t FindContactDetector(const std::string& id) {
  const std::vector<ContactDetector>& detectors = ContactDetectorList();
  std::vector<std::string> known;
  for (size_t i = 0; i < detectors.size(); ++i) {
    if (detectors[i].id == id) return i;
    known.push_back(detectors[i].id);
  }
  throw Error(ErrorKind::kNotFound, "no contact detector \"" + id + "\"" + SuggestNames(id, known));
}

std::vector<DigitContactEvents> FindContacts(const ContactEvidence& evidence,
                                             const ContactOptions& options) {
  const size_t believed = FindContactDetector(options.detector);
  std::vector<DigitContactEvents> contacts;
  for (const DigitEvidence& digit : evidence.digits) {
    DigitContactEvents events;
    events.digit = digit.track->digit;
    events.is_thumb = digit.track->is_thumb;
    double earliest = std::numeric_limits<double>::infinity(), latest = -earliest;
    int num_found = 0;
    for (const ContactDetector& detector : ContactDetectorList()) {
      events.by_detector.push_back(detector.find(evidence, digit, options));
      const EventTime& event = events.by_detector.back();
      if (!event.IsFound()) continue;
      ++num_found;
      earliest = std::min(earliest, event.time);
      latest = std::max(latest, event.time);
    }
    events.contact = events.by_detector[believed];
    if (num_found >= 2) events.disagreement = latest - earliest;
    contacts.push_back(std::move(events));
  }
  return contacts;
}

}  // namespace graspbench
