#include "human_study/events/doubts/plausibility.h"

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

/** Largest distance between two digits in about a hundred samples, sorted; without zeros. */
std::vector<double> ListSpans(const std::vector<DigitTrack>& digits) {
  constexpr size_t kEnough = 100;  // samples
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
  std::sort(spans.begin(), spans.end());
  return spans;
}

/** Largest speed of the middle one of the digits over a twentieth of a second, which noise and one
marker's outliers do not reach. */
double FindFastest(const std::vector<DigitTrack>& digits) {
  constexpr double kWindow = 0.05;  // [s]
  const std::vector<double>& times = digits.front().tip.times;
  double fastest = 0.0;
  std::vector<double> speeds;
  for (size_t i = 0, j = 0; i < times.size(); ++i) {
    while (j < times.size() && times[j] - times[i] < kWindow - 1e-9) ++j;
    if (j == times.size()) break;
    speeds.clear();
    for (const DigitTrack& digit : digits) {
      if (!digit.tip.IsValid(i) || !digit.tip.IsValid(j)) continue;
      const Vector3d way = digit.tip.At(j) - digit.tip.At(i);
      speeds.push_back(way.norm() / (times[j] - times[i]));
    }
    if (speeds.size() < 2) continue;
    std::sort(speeds.begin(), speeds.end());
    fastest = std::max(fastest, CalcSortedQuantile(speeds, 0.5));
  }
  return fastest;
}

/** The mistake that makes lengths wrong by about this factor, and what to do. */
std::string NameConfusion(double factor) {
  constexpr double kNear = 2.2;  // hands and openings differ by as much
  struct Confusion {
    double factor;
    const char* text;
  };
  constexpr Confusion kConfusions[] = {{1000.0, "millimetres read as metres (unit: mm)"},
                                       {100.0, "centimetres read as metres (unit: cm)"},
                                       {25.4, "millimetres read as inches (unit: mm)"},
                                       {10.0, "millimetres read as centimetres (unit: mm)"},
                                       {1.0 / 10.0, "centimetres read as millimetres (unit: cm)"},
                                       {1.0 / 25.4, "inches read as millimetres (unit: in)"},
                                       {1.0 / 100.0, "metres read as centimetres (unit: m)"},
                                       {1.0 / 1000.0, "metres read as millimetres (unit: m)"}};
  const auto how_far = [&](const Confusion& c) { return std::abs(std::log(c.factor / factor)); };
  const auto* nearest =
      std::min_element(std::begin(kConfusions), std::end(kConfusions),
                       [&](const auto& a, const auto& b) { return how_far(a) < how_far(b); });
  const bool is_near = how_far(*nearest) < std::log(kNear);
  return std::string("likely ") + nearest->text +
         (is_near ? ""
                  : ", or a marker's columns (mapping) or two markers' labels are exchanged, or a "
                    "marker is not on the hand") +
         ". Say the unit in the file, its mapping or study.yaml (recording.unit, for files that "
         "state none)";
}

/** How far a digit goes from one sample to another beyond what the others do, coordinate by
coordinate their median; NaN when it or all others are hidden.
@param others  a buffer: this is asked some thousand times a trial. */
double CalcOwnStep(const std::vector<DigitTrack>& digits, size_t own, size_t from, size_t to,
                   std::vector<double>& others) {
  const auto is_seen = [&](const DigitTrack& digit) {
    return digit.tip.IsValid(from) && digit.tip.IsValid(to);
  };
  if (!is_seen(digits[own])) return std::nan("");
  Vector3d way;
  for (int axis = 0; axis < 3; ++axis) {
    const auto step_of = [&](const DigitTrack& digit) {
      return digit.tip.p(axis, static_cast<Column>(to)) -
             digit.tip.p(axis, static_cast<Column>(from));
    };
    others.clear();
    for (size_t d = 0; d < digits.size(); ++d) {
      if (d != own && is_seen(digits[d])) others.push_back(step_of(digits[d]));
    }
    if (others.empty()) return std::nan("");
    std::sort(others.begin(), others.end());
    way[axis] = step_of(digits[own]) - CalcSortedQuantile(others, 0.5);
  }
  return way.norm();
}

/** Longest way of any digit from one sample to the next. */
double FindLongestStep(const std::vector<DigitTrack>& digits) {
  double longest = 0.0;
  for (const DigitTrack& digit : digits) {
    const Trajectory& tip = digit.tip;
    for (size_t i = 1; i < tip.size(); ++i) {
      if (!tip.IsValid(i - 1) || !tip.IsValid(i)) continue;
      const auto column = static_cast<Column>(i);
      longest = std::max(longest, (tip.p.col(column) - tip.p.col(column - 1)).norm());
    }
  }
  return longest;
}

}  // namespace

std::vector<Doubt> FindWrongUnit(const std::vector<DigitTrack>& digits) {
  // Between two digits of a hand that opens and closes; speeds of one that reaches.
  constexpr double kFour = 0.03, kFew = 0.012;   // at least, of four digits and of fewer [m]
  constexpr double kMost = 0.3, kTypical = 0.1;  // [m]
  constexpr double kOneHand = 0.2;               // without a far digit [m]
  constexpr double kFastest = 5.0;               // [m/s]
  const std::vector<double> spans = ListSpans(digits);
  if (spans.empty()) return {};
  const double least = digits.size() >= 4 ? kFour : kFew;
  const double largest = spans.back(), most = CalcSortedQuantile(spans, 0.75);
  const double fastest = FindFastest(digits);
  const auto doubt = [](const std::string& found, double factor) -> std::vector<Doubt> {
    return {{"wrong_unit",
             "the recording's lengths are wrong: " + found + "; " + NameConfusion(factor)}};
  };
  const bool is_large = most > kMost;
  for (size_t d = 0; is_large && digits.size() > 2 && d < digits.size(); ++d) {
    std::vector<DigitTrack> others = digits;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(d));
    const std::vector<double> left = ListSpans(others);
    const double span = left.empty() ? 0.0 : CalcSortedQuantile(left, 0.75);
    if (span < kFew || span > kOneHand) continue;
    return {
        {"far_digit",
         fmt::format("digit {} is up to {:.3g} m from the others, which are {:.3g} m apart: its "
                     "marker is not on the hand, or markers or columns name another one",
                     digits[d].digit, most, span)}};
  }
  if (is_large || largest < least) {
    return doubt(fmt::format("its digits are {:.3g} m apart, those of a hand about {:g} m",
                             is_large ? most : largest, kTypical),
                 (is_large ? most : largest) / kTypical);
  }
  if (fastest > kFastest) {
    return doubt(fmt::format("its digits move at {:.3g} m/s, no reaching hand faster than {:g} m/s "
                             "(or its clock is too fast)",
                             fastest, kFastest),
                 10.0);
  }
  return {};
}

std::vector<Doubt> FindLabelJump(const std::vector<DigitTrack>& digits) {
  // Against the other digits, which are carried along; no finger opens or closes so fast.
  constexpr double kFastest = 3.0, kLeast = 0.015;  // [m/s], [m]
  constexpr double kNoiseFactor = 8.0;              // of the track's usual step
  constexpr size_t kStay = 4;                       // samples; what comes back sooner is an outlier
  // Each coordinate of a median of steps is at most the longest step: most trials end here.
  if ((1.0 + std::sqrt(3.0)) * FindLongestStep(digits) <= kLeast) return {};
  const size_t num_samples = digits.front().tip.size();
  std::vector<double> others;
  for (size_t d = 0; d < digits.size(); ++d) {
    const auto own_step = [&](size_t from, size_t to) {
      return CalcOwnStep(digits, d, from, to, others);
    };
    std::vector<double> steps;
    for (size_t i = 1; i < num_samples; ++i) {
      const double step = own_step(i - 1, i);
      if (!std::isnan(step)) steps.push_back(step);
    }
    if (steps.empty() || *std::max_element(steps.begin(), steps.end()) <= kLeast) continue;
    const double usual = CalcMedian(steps);
    const std::vector<double>& times = digits[d].tip.times;
    for (size_t i = 1 + kStay; i + kStay < num_samples; ++i) {
      const double limit =
          std::max({kLeast, kFastest * (times[i] - times[i - 1]), kNoiseFactor * usual});
      const double step = own_step(i - 1, i);
      bool stays = step > limit;
      for (size_t k = 1; stays && k <= kStay; ++k) {
        stays = own_step(i - 1, i + k) > 0.5 * step && own_step(i - 1 - k, i) > 0.5 * step &&
                own_step(i - 1 - k, i - 1) < 0.5 * step && own_step(i, i + k) < 0.5 * step;
      }
      if (!stays) continue;
      return {{"label_jump",
               fmt::format("digit {} jumps {:.0f} mm against the other digits between two frames, "
                           "at {:.3f} s, and stays there: its marker is likely labelled as another "
                           "one from there on. Correct the labels in the recording",
                           digits[d].digit, MmFromM(step), times[i])}};
    }
  }
  return {};
}

std::vector<Doubt> FindNoMovement(const std::vector<DigitTrack>& digits) {
  constexpr double kTravel = 0.02;  // of a tip; shorter is no reach [m]
  double farthest = 0.0, begin = INFINITY, end = -INFINITY;
  for (const DigitTrack& digit : digits) {
    Vector3d low = Vector3d::Constant(INFINITY), high = -low;
    for (size_t i = 0; i < digit.tip.size(); ++i) {
      if (!digit.tip.IsValid(i)) continue;
      low = low.cwiseMin(digit.tip.At(i));
      high = high.cwiseMax(digit.tip.At(i));
      begin = std::min(begin, digit.tip.times[i]);
      end = std::max(end, digit.tip.times[i]);
    }
    if ((high - low).minCoeff() >= 0.0) farthest = std::max(farthest, (high - low).norm());
  }
  if (!(begin < end) || farthest >= kTravel) return {};
  return {{"no_movement",
           fmt::format("no digit moves farther than {:.1f} mm in {:.2f} s: there is no reach in "
                       "this recording; it may be cut off, too short, or of another trial",
                       MmFromM(farthest), end - begin)}};
}

std::vector<Doubt> FindHandCentred(const std::vector<DigitTrack>& digits) {
  constexpr double kNearOrigin = 0.15, kTravel = 0.05;  // [m]; no reach ends so near its start
  size_t num_shown = 0;
  double farthest = 0.0;
  Vector3d low = Vector3d::Constant(INFINITY), high = -low;
  for (size_t i = 0; i < digits.front().tip.size(); ++i) {
    Vector3d middle = Vector3d::Zero();
    bool shows_all = true;
    for (const DigitTrack& digit : digits) {
      shows_all = shows_all && digit.tip.IsValid(i);
      middle += digit.tip.At(i) / static_cast<double>(digits.size());
    }
    if (!shows_all) continue;
    ++num_shown;
    farthest = std::max(farthest, middle.norm());
    low = low.cwiseMin(middle);
    high = high.cwiseMax(middle);
  }
  const double travel = (high - low).norm();
  // The few samples that show all digits of a recording full of gaps are near each other.
  if (2 * num_shown < digits.front().tip.size()) return {};
  if (!(farthest > 0.0 && farthest < kNearOrigin && travel < kTravel)) return {};
  return {
      {"hand_centred",
       fmt::format("the digits' middle stays within {:.0f} mm of the origin and moves {:.0f} mm: "
                   "the places are counted from the hand itself, so that its reach is not in "
                   "them. Record in a frame that stands still",
                   MmFromM(farthest), MmFromM(travel))}};
}

std::vector<Doubt> FindWrongShape(const std::vector<DigitContactEvents>& contacts, bool is_lifted,
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
  return {{"wrong_shape",
           fmt::format(
               "in the hold the digits' markers are {:.0f} mm {} the object's surface{}: its "
               "size or centre in objects.csv is likely wrong (too {}){}; expected {:.0f} to "
               "{:.0f} mm (plausibility.max_hold_distance_m)",
               MmFromM(std::abs(median)),
               is_given ? (median < 0.0 ? "nearer to" : "farther from")
                        : (median < 0.0 ? "inside" : "from"),
               is_given ? " than their pad offsets" : "", median < least ? "large" : "small",
               median > most && !is_lifted ? ", or the recording ends before they are at the object"
                                           : "",
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
  const auto place = [](const SmoothPath& tip, size_t i) -> Vector3d { return tip.path.At(i); };
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

namespace {

Doubt MakeOtherAxis(double along, const Vector3d& axis, const char* how,
                    const LiftOffOptions& lift_off) {
  Column which = 0;
  axis.cwiseAbs().maxCoeff(&which);
  return {
      "other_lift_axis",
      fmt::format("the object moves {:.0f} mm along {}{}, but {} the stated direction of the lift "
                  "({:g}, {:g}, {:g}); if that is up in the recording, say so in study.yaml: "
                  "lift_off: {{up_x: {:g}, up_y: {:g}, up_z: {:g}}}",
                  MmFromM(along), axis[which] > 0.0 ? '+' : '-', "xyz"[which], how, lift_off.up_x,
                  lift_off.up_y, lift_off.up_z, axis.x(), axis.y(), axis.z())};
}

/** An object on a table rises before it goes anywhere else, or as it does. One that first goes
another way, and farther in the end, is lifted that way. */
std::vector<Doubt> FindEarlierAxis(const ObjectTravel& travel, const EventTime& stated,
                                   const LiftOffOptions& lift_off) {
  constexpr double kFarther = 1.5;  // than along the stated direction
  const double height = travel.height.values.maxCoeff<Eigen::PropagateNumbers>();
  const double least = std::max(kFarther * height, 3.0 * lift_off.min_rise);
  for (const ObjectWay& way : FindWaysBeforeRise(travel, least, lift_off)) {
    const double apart = stated.time - way.lift_off.time;
    if (!(apart > kSigmas * std::hypot(stated.uncertainty, way.lift_off.uncertainty))) continue;
    const std::string how = fmt::format("rises {:.0f} ms later, and less, along", MsFromS(apart));
    return {MakeOtherAxis(way.along, way.axis, how.c_str(), lift_off)};
  }
  return {};
}

}  // namespace

std::vector<Doubt> FindOtherLiftAxis(const ObjectTravel& travel, const ObjectEvents& object,
                                     const LiftOffOptions& lift_off,
                                     const PlausibilityOptions& options) {
  if (!options.lift_axis) return {};
  if (object.lift_off.IsFound()) {
    std::vector<Doubt> doubts = FindEarlierAxis(travel, object.lift_off, lift_off);
    if (!doubts.empty()) return doubts;
  }
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
  const Vector3d stated = Vector3d(lift_off.up_x, lift_off.up_y, lift_off.up_z).normalized();
  if (stated.dot(way) > kAxisShare * way.norm()) return {};  // it is the stated direction
  Column axis = 0;
  const double along = way.cwiseAbs().maxCoeff(&axis);
  if (way.norm() < 3.0 * lift_off.min_rise || along < kAxisShare * way.norm()) return {};
  const Vector3d up = (way[axis] > 0.0 ? 1.0 : -1.0) * Vector3d::Unit(axis);
  return {MakeOtherAxis(along, up, "does not rise along", lift_off)};
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
  // Of a digit that touched at an unknown instant nobody knows whether it was first.
  const bool is_first_known =
      std::none_of(contacts.begin(), contacts.end(),
                   [](const DigitContactEvents& digit) { return IsUnresolved(digit.contact); });
  if (options.max_moved_before > 0.0 && object.moved.IsFound() && is_first_known) {
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
