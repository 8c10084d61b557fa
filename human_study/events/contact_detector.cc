#include "human_study/events/contact_detector.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/statistics/summary.h"

namespace graspbench {

namespace {

using Column = Eigen::Index;

/** Of what noise of a coordinate may leave in a looseness from which it was subtracted. */
constexpr double kUnsureOfNoise = 0.8;

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

/** RMS distance from the mean place, without what noise of that SD makes of it. Filled samples take
no part: a bridge over a gap does not follow an object that is carried. */
double CalcLooseness(const SmoothPath& smooth, double noise, const Hold& hold) {
  const SampleRun window = FindSamples(smooth.path.times, hold.time, hold.end);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double squares = 0.0, count = 0.0;
  for (size_t i = window.first; i < window.last; ++i) {
    if (smooth.path.states[i] != SampleState::kMeasured) continue;
    const Eigen::Vector3d p = smooth.path.At(i);
    sum += p;
    squares += p.squaredNorm();
    count += 1.0;
  }
  const double variance = (squares - sum.squaredNorm() / count) / count - 3.0 * noise * noise;
  return std::sqrt(std::max(0.0, variance));
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
  const std::vector<TouchFits>& fits = trial.FitTouches(tips, hold, options.object_cutoff);
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
    digit.looseness = CalcLooseness(tip.smooth, tip.smooth_noise, hold);
    digit.fits = fits[i];
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
  if (digit.hold_distance > options.max_pad_offset) {
    return fmt::format("in the hold its marker is {:.0f} mm from the surface",
                       MmFromM(digit.hold_distance));
  }
  const double given = digit.track->pad_offset;
  const double expected = std::isnan(given) ? evidence.typical_hold_distance : given;
  if (digit.hold_distance > expected + options.max_pad_difference) {
    return fmt::format("in the hold its marker is {:.0f} mm farther from the surface than {}",
                       MmFromM(digit.hold_distance - expected),
                       std::isnan(given) ? "those of the other digits" : "its pad offset");
  }
  // Less than half a millimetre may be the skin of a digit that holds, and noise is known to a
  // part.
  const double unsure = std::max(0.0005, kUnsureOfNoise * digit.noise_O);
  // A thumb bears what all fingers press: its skin gives way under the sum of their forces.
  const double load = digit.track->is_thumb ? static_cast<double>(evidence.digits.size() - 1) : 1.0;
  if (digit.looseness >
      std::max(load * options.max_looseness * evidence.typical_looseness, unsure)) {
    return fmt::format(
        "while the object is held it moves {:.1f} mm (RMS) against it, the other digits {:.1f} mm",
        MmFromM(digit.looseness), MmFromM(evidence.typical_looseness));
  }
  // Below four standard deviations noise alone may look like motion.
  if (speed > std::max(options.speed_threshold, 4.0 * digit.speed.noise)) {
    return fmt::format("in the hold it moves at {:.0f} mm/s against the object", MmFromM(speed));
  }
  return "";
}

EventTime MakeTouchEvent(const DigitEvidence& digit, const TouchFit& fit,
                         const ContactOptions& options) {
  EventTime event = CalcTouchTime(fit, options.depths);
  if (!event.IsFound()) return event;
  const Trajectory& p_O = digit.p_O;
  const auto is_hidden = [&](size_t i) { return p_O.states[i] != SampleState::kMeasured; };
  const size_t after = FindSamples(p_O.times, event.time, p_O.times.back()).first;
  size_t begin = after, end = after;  // samples of the gap
  while (begin > 0 && is_hidden(begin - 1)) --begin;
  while (end < p_O.size() && is_hidden(end)) ++end;
  event.is_in_gap = begin < end || after == 0 || after == p_O.size();
  if (begin == end || begin == 0 || end == p_O.size()) return event;
  const double length = p_O.times[end] - p_O.times[begin - 1];
  if (length <= kMaxTouchGap) return event;
  return MissingEvent(fmt::format("{}: digit or object hidden for {:.0f} ms about it", kNotUsable,
                                  MsFromS(length)));
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

namespace {

EventTime CheckUsable(const EventTime& event, const ContactOptions& options) {
  const bool is_usable =
      options.max_uncertainty == 0.0 || !(event.uncertainty > options.max_uncertainty);
  if (!event.IsFound() || is_usable) return event;
  EventTime wide = event;
  wide.missing =
      fmt::format("{}: known to \u00b1 {:.0f} ms only", kNotUsable, MsFromS(event.CalcHalfWidth()));
  return wide;
}

bool IsForce(const ContactDetector& detector) { return std::string_view(detector.id) == "force"; }

/** Null: the detector fits nothing. */
const TouchFit* FindBelievedFit(const DigitEvidence& digit, const std::string& detector) {
  if (detector == "surface") return &digit.fits.surface;
  return detector == "breakpoint" ? &digit.fits.path : nullptr;
}

}  // namespace

std::vector<DigitContactEvents> FindContacts(const ContactEvidence& evidence,
                                             const ContactOptions& options) {
  const size_t believed = FindContactDetector(options.detector);
  std::vector<DigitContactEvents> contacts;
  contacts.reserve(evidence.digits.size());  // a study keeps them for each of its trials
  for (const DigitEvidence& digit : evidence.digits) {
    DigitContactEvents events;
    events.by_detector.reserve(ContactDetectorList().size());
    events.digit = digit.track->digit;
    events.is_thumb = digit.track->is_thumb;
    events.noise_O = digit.noise_O;
    events.has_pad_offset = !std::isnan(digit.track->pad_offset);
    events.hold_distance =
        digit.hold_distance - (events.has_pad_offset ? digit.track->pad_offset : 0.0);
    events.is_verified = !std::isnan(digit.hold_distance);
    double earliest = std::numeric_limits<double>::infinity(), latest = -earliest;
    int num_found = 0;
    for (const ContactDetector& detector : ContactDetectorList()) {
      events.by_detector.push_back(CheckUsable(detector.find(evidence, digit, options), options));
      const EventTime& event = events.by_detector.back();
      if (!event.IsFound()) continue;
      events.is_verified |= IsForce(detector);
      ++num_found;
      earliest = std::min(earliest, event.time);
      latest = std::max(latest, event.time);
    }
    events.contact = events.by_detector[believed];
    const TouchFit* const fit = FindBelievedFit(digit, options.detector);
    events.own_uncertainty =
        fit != nullptr ? CalcOwnUncertainty(*fit, options.depths) : events.contact.uncertainty;
    events.fit = digit.fits.surface.missing.empty() ? digit.fits.surface : digit.fits.path;
    if (events.contact.IsFound()) {
      events.regrasp = FindRegrasp(digit.departure, evidence.begin, events.contact.time);
    }
    events.stands_off = digit.hold_distance - evidence.typical_hold_distance;
    if (num_found >= 2) events.disagreement = latest - earliest;
    contacts.push_back(std::move(events));
  }
  return contacts;
}

void CoverDisagreement(double limit, const ContactOptions& options,
                       std::vector<DigitContactEvents>& contacts) {
  constexpr double kSigmas = 3.0;
  if (limit == 0.0) return;
  const std::vector<ContactDetector>& detectors = ContactDetectorList();
  for (DigitContactEvents& digit : contacts) {
    EventTime& contact = digit.contact;
    if (!contact.IsFound() || digit.is_reviewed) continue;
    double farthest = 0.0;
    for (size_t i = 0; i < detectors.size(); ++i) {
      const EventTime& other = digit.by_detector[i];
      const std::string_view id = detectors[i].id;
      if (!other.IsFound() || id == "multiplied" || id == "speed") continue;
      const double apart = std::abs(other.time - contact.time);
      const double unsure = kSigmas * std::hypot(other.uncertainty, contact.uncertainty);
      if (apart > std::max(limit, unsure)) farthest = std::max(farthest, apart);
    }
    if (farthest == 0.0) continue;
    contact.uncertainty = farthest / kNormal95;
    contact = CheckUsable(contact, options);
  }
}

namespace {

constexpr double kAtPlace = 2e-3, kLeftPlace = 4e-3;  // [m]
constexpr double kAtPlaceNoise = 3.0, kLeftPlaceNoise = 6.0;

}  // namespace

Regrasp FindRegrasp(const ScalarCurve& departure, double begin, double contact) {
  const double at_place = std::max(kAtPlace, kAtPlaceNoise * departure.noise);
  const double left = std::max(kLeftPlace, kLeftPlaceNoise * departure.noise);
  const SampleRun run = FindSamples(departure.times, begin, contact);
  const auto value = [&](size_t i) { return departure.At(i); };
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
