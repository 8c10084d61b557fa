#include "human_study/events/contact_detector.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/base/error.h"
#include "core/base/units.h"
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

/** SD of a coordinate about the hold by its median absolute deviation; NaN when hidden there. */
double CalcHoldNoise(const Trajectory& p_O, const Hold& hold) {
  constexpr double kSdPerMedian = 1.4826;  // of a normal distribution
  const SampleRun window = FindSamples(p_O.times, std::max(hold.begin, hold.time - 0.05),
                                       std::min(hold.end, hold.time + 0.1));
  std::vector<double> deviations;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> values;
    for (size_t i = window.first; i < window.last; ++i) {
      if (p_O.IsValid(i)) values.push_back(p_O.p(axis, static_cast<Column>(i)));
    }
    const double median = CalcMedian(values);
    for (const double value : values) deviations.push_back(std::abs(value - median));
  }
  return kSdPerMedian * CalcMedian(std::move(deviations));
}

double CalcLooseness(const SmoothPath& smooth, const Hold& hold) {
  const SampleRun window = FindSamples(smooth.path.times, hold.time, hold.end);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double squares = 0.0, count = 0.0;
  for (size_t i = window.first; i < window.last; ++i) {
    if (!smooth.path.IsValid(i)) continue;
    const Eigen::Vector3d p = smooth.path.p.col(static_cast<Column>(i));
    sum += p;
    squares += p.squaredNorm();
    count += 1.0;
  }
  return std::sqrt(std::max(0.0, (squares - sum.squaredNorm() / count) / count));
}

/** Median over the digits that have one; NaN below three. */
double CalcTypical(const std::vector<DigitEvidence>& digits, double DigitEvidence::*value) {
  std::vector<double> values;
  for (const DigitEvidence& digit : digits) {
    if (!std::isnan(digit.*value)) values.push_back(digit.*value);
  }
  return values.size() < 3 ? std::nan("") : CalcMedian(std::move(values));
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
    digit.noise_O = CalcHoldNoise(tip.p_O, hold);
    digit.looseness = CalcLooseness(tip.smooth, hold);
    evidence.digits.push_back(std::move(digit));
  }
  evidence.typical_hold_distance = CalcTypical(evidence.digits, &DigitEvidence::hold_distance);
  evidence.typical_looseness = CalcTypical(evidence.digits, &DigitEvidence::looseness);
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
  char text[120];
  if (digit.hold_distance > options.max_pad_offset) {
    std::snprintf(text, sizeof text, "in the hold its marker is %.0f mm from the surface",
                  MmFromM(digit.hold_distance));
    return text;
  }
  const double given = digit.track->pad_offset;
  const double expected = std::isnan(given) ? evidence.typical_hold_distance : given;
  if (digit.hold_distance > expected + options.max_pad_difference) {
    std::snprintf(text, sizeof text,
                  "in the hold its marker is %.0f mm farther from the surface than %s",
                  MmFromM(digit.hold_distance - expected),
                  std::isnan(given) ? "those of the other digits" : "its pad offset");
    return text;
  }
  // Less than half a millimetre may be the skin of a digit that holds.
  if (digit.looseness > std::max(options.max_looseness * evidence.typical_looseness, 0.0005)) {
    std::snprintf(text, sizeof text,
                  "while the object is held it moves %.1f mm (RMS) against it, the other digits "
                  "%.1f mm",
                  MmFromM(digit.looseness), MmFromM(evidence.typical_looseness));
    return text;
  }
  // Below four standard deviations noise alone may look like motion.
  if (speed > std::max(options.speed_threshold, 4.0 * digit.speed.noise)) {
    std::snprintf(text, sizeof text, "in the hold it moves at %.0f mm/s against the object",
                  MmFromM(speed));
    return text;
  }
  return "";
}

Arrival FindArrival(const ScalarCurve& distance, const ContactEvidence& evidence,
                    double tolerance) {
  // A slower approach is not extrapolated as such: the contact would lie too far away [m/s].
  constexpr double kMinClosingSpeed = 0.02;
  Arrival arrival;
  EventTime& event = arrival.event;
  const int hold = FindHoldSample(distance, evidence.hold);
  if (hold < 0) {
    event = MissingEvent("the digit is hidden in the hold");
    return arrival;
  }
  const size_t first = FindSamples(distance.times, evidence.begin, evidence.hold.time).first;
  event =
      TraceBack(distance, static_cast<size_t>(hold), first, tolerance, Side::kBelow, kMinApproach);
  if (!event.IsFound() || event.is_in_gap) return arrival;
  arrival.begin = event.time;
  const size_t after = FindSamples(distance.times, event.time, distance.times.back()).first;
  const auto column = static_cast<Column>(after);
  const double speed = (distance.values[column - 1] - distance.values[column]) /
                       (distance.times[after] - distance.times[after - 1]);
  const double straight = tolerance / std::max(kMinClosingSpeed, speed);
  event.time += straight;
  const double settled = std::max(0.15 * tolerance, 3.0 * distance.noise);
  if (settled >= tolerance) return arrival;
  size_t last = after;
  while (last < static_cast<size_t>(hold) &&
         (!distance.IsValid(last) || distance.values[static_cast<Column>(last)] > settled)) {
    ++last;
  }
  const double expected = arrival.begin + straight * (1.0 - settled / tolerance);
  arrival.settling = std::max(0.0, distance.times[last] - expected - distance.reach);
  return arrival;
}

void AllowForSettling(const Arrival& arrival, EventTime& event) {
  if (!event.IsFound() || event.is_in_gap || !(arrival.settling > 0.0)) return;
  const double before = std::clamp(event.time - arrival.begin, 0.0, 2.0 * arrival.settling);
  const double length = before + arrival.settling;
  event.time += (arrival.settling - before) / 2.0;
  event.uncertainty = std::hypot(event.uncertainty, length / 2.0);
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
    events.noise_O = digit.noise_O;
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
