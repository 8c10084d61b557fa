#include "human_study/events/plausibility.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "core/base/units.h"
#include "core/statistics/summary.h"

namespace graspbench {
namespace {

using Column = Eigen::Index;
using Eigen::Vector3d;

constexpr double kRigid = 0.003;  // change of a distance between two digits that hold [m]
constexpr double kSigmas = 3.0;   // of combined uncertainties
constexpr double kRisingShare = 0.15;
constexpr double kAxisShare = 0.9;  // of the way along its likely direction

/** First or last of those found; null without any. */
const DigitContactEvents* FindExtreme(const std::vector<DigitContactEvents>& contacts, bool last) {
  const DigitContactEvents* extreme = nullptr;
  for (const DigitContactEvents& digit : contacts) {
    if (!digit.contact.IsFound()) continue;
    if (!extreme || (digit.contact.time > extreme->contact.time) == last) extreme = &digit;
  }
  return extreme;
}

/** Their times are those of thresholds, which slow arrivals cross early. */
bool IsRough(const std::string& detector) {
  return detector == "multiplied" || detector == "speed";
}

void AddDisagreement(const DigitContactEvents& digit, double limit, std::vector<Doubt>& doubts) {
  if (!digit.contact.IsFound() || digit.is_reviewed) return;
  const std::vector<ContactDetector>& detectors = ContactDetectorList();
  for (size_t i = 0; i < detectors.size(); ++i) {
    const EventTime& other = digit.by_detector[i];
    if (!other.IsFound() || IsRough(detectors[i].id)) continue;
    const double apart = std::abs(other.time - digit.contact.time);
    if (apart <= limit ||
        apart <= kSigmas * std::hypot(other.uncertainty, digit.contact.uncertainty)) {
      continue;
    }
    doubts.push_back(
        {"detectors_disagree",
         fmt::format("digit {}: \"{}\" finds its contact {:.0f} ms away, more than both say of "
                     "their uncertainty",
                     digit.digit, detectors[i].id, MsFromS(apart))});
    return;
  }
}

}  // namespace

std::vector<Doubt> FindWrongUnit(const std::vector<DigitTrack>& digits) {
  // Between two digits of a hand that opens and closes.
  constexpr double kLeast = 2e-3, kMost = 1.0, kTypical = 0.1;  // [m]
  constexpr size_t kEnough = 100;                               // samples
  const size_t num_samples = digits.front().tip.size();
  std::vector<double> spans;
  const size_t step = std::max<size_t>(1, num_samples / kEnough);
  for (size_t i = 0; i < num_samples; i += step) {
    double span = 0.0;
    for (size_t a = 0; a < digits.size(); ++a) {
      for (size_t b = a + 1; b < digits.size(); ++b) {
        if (!digits[a].tip.IsValid(i) || !digits[b].tip.IsValid(i)) continue;
        const auto column = static_cast<Column>(i);
        span = std::max(span, (digits[a].tip.p.col(column) - digits[b].tip.p.col(column)).norm());
      }
    }
    if (span > 0.0) spans.push_back(span);
  }
  if (spans.empty()) return {};
  const double largest = *std::max_element(spans.begin(), spans.end());
  const double median = CalcMedian(std::move(spans));
  if (largest >= kLeast && median <= kMost) return {};
  const bool is_large = median > kMost;
  const double factor = is_large ? median / kTypical : kTypical / largest;
  const char* likely = factor > 300.0 ? (is_large ? "millimetres read as metres (unit: mm)"
                                                  : "metres read as millimetres (unit: m)")
                                      : (is_large ? "centimetres read as metres (unit: cm)"
                                                  : "metres read as centimetres (unit: m)");
  return {{"wrong_unit",
           fmt::format("the recording's unit of length is wrong: its digits are {:.3g} m apart, "
                       "those of a hand about {:g} m; likely {}. Say the unit in the file, its "
                       "mapping or study.yaml (recording.unit)",
                       is_large ? median : largest, kTypical, likely)}};
}

std::vector<Doubt> FindHandCentred(const std::vector<DigitTrack>& digits) {
  constexpr double kNearOrigin = 0.15, kTravel = 0.05;  // [m]; no reach ends so near its start
  double farthest = 0.0;
  Vector3d low = Vector3d::Constant(INFINITY), high = -low;
  for (size_t i = 0; i < digits.front().tip.size(); ++i) {
    Vector3d middle = Vector3d::Zero();
    bool shows_all = true;
    for (const DigitTrack& digit : digits) {
      shows_all = shows_all && digit.tip.IsValid(i);
      middle += digit.tip.p.col(static_cast<Column>(i)) / static_cast<double>(digits.size());
    }
    if (!shows_all) continue;
    farthest = std::max(farthest, middle.norm());
    low = low.cwiseMin(middle);
    high = high.cwiseMax(middle);
  }
  const double travel = (high - low).norm();
  if (!(farthest > 0.0 && farthest < kNearOrigin && travel < kTravel)) return {};
  return {
      {"hand_centred",
       fmt::format("the digits' middle stays within {:.0f} mm of the origin and moves {:.0f} mm: "
                   "the places are counted from the hand itself, so that its reach is not in "
                   "them. Record in a frame that stands still",
                   MmFromM(farthest), MmFromM(travel))}};
}

std::vector<Doubt> FindWrongShape(const std::vector<DigitContactEvents>& contacts,
                                  const PlausibilityOptions& options) {
  constexpr double kInside = 1e-3;    // no marker's middle is nearer to what its skin touches [m]
  constexpr double kPadError = 5e-3;  // of a given pad offset [m]
  if (options.max_hold_distance == 0.0) return {};
  std::vector<double> distances;
  bool is_given = false;
  for (const DigitContactEvents& digit : contacts) {
    if (std::isnan(digit.hold_distance)) continue;
    distances.push_back(digit.hold_distance);
    is_given |= digit.has_pad_offset;
  }
  if (distances.size() < 2) return {};
  const double median = CalcMedian(std::move(distances));
  const double least = is_given ? -kPadError : kInside;
  const double most = is_given ? kPadError : options.max_hold_distance;
  if (median >= least && median <= most) return {};
  return {
      {"wrong_shape",
       fmt::format("in the hold the digits' markers are {:.0f} mm {} the object's surface{}: its "
                   "size or centre in objects.csv is likely wrong (too {}); expected {:.0f} to "
                   "{:.0f} mm (plausibility.max_hold_distance_m)",
                   MmFromM(std::abs(median)),
                   is_given ? (median < 0.0 ? "nearer to" : "farther from")
                            : (median < 0.0 ? "inside" : "from"),
                   is_given ? " than their pad offsets" : "", median < least ? "large" : "small",
                   MmFromM(least), MmFromM(most))}};
}

double CalcJointTravel(const std::vector<SmoothPath>& tips, const Hold& hold) {
  std::vector<const SmoothPath*> seen;
  const std::vector<double>& times = tips.front().path.times;
  const SampleRun run = FindSamples(times, times.front(), hold.time);
  if (run.size() == 0) return 0.0;
  const size_t at = run.last - 1;
  for (const SmoothPath& tip : tips) {
    if (tip.path.IsValid(at)) seen.push_back(&tip);
  }
  if (seen.size() < 2) return 0.0;
  const auto place = [](const SmoothPath& tip, size_t i) -> Vector3d {
    return tip.path.p.col(static_cast<Column>(i));
  };
  const auto is_rigid = [&](size_t i) {
    for (size_t a = 0; a < seen.size(); ++a) {
      for (size_t b = a + 1; b < seen.size(); ++b) {
        if (!seen[a]->path.IsValid(i) || !seen[b]->path.IsValid(i)) continue;
        const double now = (place(*seen[a], i) - place(*seen[b], i)).norm();
        const double held = (place(*seen[a], at) - place(*seen[b], at)).norm();
        const double noise = std::hypot(seen[a]->smooth_noise, seen[b]->smooth_noise);
        if (std::abs(now - held) > std::max(kRigid, 4.0 * noise)) return false;
      }
    }
    return true;
  };
  double farthest = 0.0;
  for (size_t i = at; i-- > 0 && is_rigid(i);) {
    Vector3d moved = Vector3d::Zero();
    double count = 0.0;
    for (const SmoothPath* tip : seen) {
      if (!tip->path.IsValid(i)) continue;
      moved += place(*tip, i) - place(*tip, at);
      count += 1.0;
    }
    if (count > 0.0) farthest = std::max(farthest, moved.norm() / count);
  }
  return farthest;
}

std::vector<Doubt> FindUnseenCarrying(const std::vector<SmoothPath>& tips, const Hold& hold,
                                      const PlausibilityOptions& options) {
  if (options.min_carried == 0.0 || !hold.IsFound()) return {};
  const double travel = CalcJointTravel(tips, hold);
  if (travel < options.min_carried) return {};
  return {{"carried_unseen",
           fmt::format(
               "the object was not recorded and the hand carried it: the digits moved {:.0f} mm "
               "together, so where they touched is not determined; record a marker on the object, "
               "or cut the trial before the lift (end_s)",
               MmFromM(travel))}};
}

std::vector<Doubt> FindOtherLiftAxis(const ObjectTravel& travel, const ObjectEvents& object,
                                     const LiftOffOptions& lift_off,
                                     const PlausibilityOptions& options) {
  if (!options.lift_axis) return {};
  const int farthest = FindPeak(travel.displacement, {0, travel.displacement.size()});
  if (farthest < 0) return {};
  // A tilt may look like a small lift; what is lifted and carried aside rises first.
  const auto rises = [&](Column i) {
    const Vector3d stated = Vector3d(lift_off.up_x, lift_off.up_y, lift_off.up_z).normalized();
    return stated.dot(travel.moved.col(i)) > kRisingShare * travel.moved.col(i).norm();
  };
  const int early = FindFirstAbove(travel.displacement, 3.0 * lift_off.min_rise);
  if (object.lift_off.IsFound() && (early < 0 || rises(early) || rises(farthest))) return {};
  const Vector3d way = travel.moved.col(farthest);
  Column axis = 0;
  const double along = way.cwiseAbs().maxCoeff(&axis);
  if (way.norm() < 3.0 * lift_off.min_rise || along < kAxisShare * way.norm()) return {};
  const double sign = way[axis] > 0.0 ? 1.0 : -1.0;
  Vector3d up = Vector3d::Zero();
  up[axis] = sign;
  return {
      {"other_lift_axis",
       fmt::format(
           "the object moves {:.0f} mm along {}{}, but does not rise along the stated "
           "direction of the lift ({:g}, {:g}, {:g}); if that is up in the recording, say so in "
           "study.yaml: lift_off: {{up_x: {:g}, up_y: {:g}, up_z: {:g}}}",
           MmFromM(along), sign > 0.0 ? '+' : '-', "xyz"[axis], lift_off.up_x, lift_off.up_y,
           lift_off.up_z, up.x(), up.y(), up.z())}};
}

std::vector<Doubt> FindContactDoubts(const std::vector<DigitContactEvents>& contacts,
                                     const Movement& movement, const ObjectEvents& object,
                                     double gct, const PlausibilityOptions& options) {
  std::vector<Doubt> doubts;
  const DigitContactEvents* first = FindExtreme(contacts, false);
  const DigitContactEvents* last = FindExtreme(contacts, true);
  if (first == nullptr) return doubts;
  const double after = last->contact.time - movement.end.time;
  const bool is_lifted_after =
      object.lift_off.IsFound() && last->contact.time < object.lift_off.time;
  if (options.max_contact_after_end > 0.0 && after > options.max_contact_after_end &&
      !is_lifted_after) {
    doubts.push_back(
        {"contact_after_end",
         fmt::format("digit {} touches {:.0f} ms after the movement's end; expected at most "
                     "{:.0f} (plausibility.max_contact_after_end_s)",
                     last->digit, MsFromS(after), MsFromS(options.max_contact_after_end))});
  }
  if (options.max_closure_time > 0.0 && gct > options.max_closure_time) {
    doubts.push_back(
        {"closure_too_long", fmt::format("the hand closes for {:.0f} ms; expected at most {:.0f} "
                                         "(plausibility.max_closure_time_s)",
                                         MsFromS(gct), MsFromS(options.max_closure_time))});
  }
  if (options.max_disagreement > 0.0) {
    for (const DigitContactEvents& digit : contacts) {
      AddDisagreement(digit, options.max_disagreement, doubts);
    }
  }
  if (options.max_moved_before > 0.0 && object.moved.IsFound()) {
    const double before = first->contact.time - object.moved.time;
    const double u = std::hypot(first->contact.uncertainty, object.moved.uncertainty);
    if (before > std::max(options.max_moved_before, kSigmas * u)) {
      doubts.push_back(
          {"moved_before_touch",
           fmt::format("the object moves {:.0f} ms before the first contact that was found "
                       "(digit {})",
                       MsFromS(before), first->digit)});
    }
  }
  return doubts;
}

}  // namespace graspbench
