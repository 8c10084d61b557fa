#include "core/trial/measures/diagnosis.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/base/text/text.h"
#include "core/trial/measures/load_recorder.h"
#include "core/trial/trial_result.h"

namespace graspbench {
namespace {

constexpr double kMostInterruption = 0.03;  // of a run of slipping [s]
constexpr double kLookBack = 0.3;           // from the loss to its cause [s]
constexpr double kLookAhead = 0.1;          // to a slip that shows the cause [s]
constexpr double kLeastPush = 0.2;          // [N]
constexpr double kLeastPushWeights = 0.5;
constexpr double kBehind = 0.15;      // of the closing
constexpr double kBehindShare = 0.5;  // of the closing of the first to touch
constexpr double kLate = 0.2;         // after the last of the others [s]
constexpr double kClosed = 0.99;      // of the way to the target posture
constexpr double kMoved = 0.002;      // [m]
constexpr double kLowFriction = 0.75;

std::string Times(double time) { return FormatFixed(time, 3) + " s"; }
std::string Newtons(double force) { return FormatFixed(force, force < 0.1 ? 3 : 2) + " N"; }

/** A part and the sample in which its last run of slipping or not touching begins. */
struct Loss {
  size_t part, sample;
};

class Course {
 public:
  Course(const TrialResult& result, const std::vector<LoadSample>& samples, double closure_start)
      : result_(result), samples_(samples), closure_start_(closure_start) {
    for (const PhaseStart& phase : result.phases) {
      if (phase.name == NameOf(Phase::kLiftOff)) lift_off_ = phase.time + closure_start;
    }
  }

  size_t num_digits() const { return result_.contacts.size(); }
  std::string NameOfPart(size_t part) const {
    return part < num_digits() ? result_.contacts[part].digit.str() : "palm";
  }
  double FindTouch(size_t digit) const { return result_.contacts[digit].time + closure_start_; }
  double lift_off() const { return lift_off_; }  ///< NaN: not reached
  const LoadSample& At(double time) const {
    const auto at = std::lower_bound(samples_.begin(), samples_.end(), time - 1e-9,
                                     [](const LoadSample& s, double t) { return s.time < t; });
    return at == samples_.end() ? samples_.back() : *at;
  }

  /** Of the parts that pressed at some time the one that gave way first, for good. */
  std::optional<Loss> FindLoss() const {
    std::optional<Loss> first;
    for (size_t part = 0; part < samples_.back().parts.size(); ++part) {
      size_t begins = samples_.size();
      double holds_since = kUnset;
      bool has_pressed = false;
      for (size_t at = samples_.size(); at-- > 0;) {
        const PartSample& sample = samples_[at].parts[part];
        has_pressed = has_pressed || sample.force > 0.0f;
        if (sample.force == 0.0f || sample.is_sliding) {
          begins = at;
          holds_since = kUnset;
        } else {
          if (std::isnan(holds_since)) holds_since = samples_[at].time;
          if (holds_since - samples_[at].time >= kMostInterruption) break;
        }
      }
      // What never pressed has nothing to lose; what still holds has lost nothing.
      if (!has_pressed || begins == 0 || begins == samples_.size()) continue;
      if (!HasPressedBefore(part, begins)) continue;
      if (!first || begins < first->sample) first = Loss{part, begins};
    }
    return first;
  }

  /** The last sample in which the part held, at most its run's beginning. */
  const LoadSample& BeforeLoss(const Loss& loss) const {
    return samples_[loss.sample > 0 ? loss.sample - 1 : 0];
  }

  /** The first one; of an object that was lifted only while the hand still touched it. */
  const LoadSample* FindPush() const {
    const double least = std::max(kLeastPush, kLeastPushWeights * result_.weight);
    const double until = std::isnan(lift_off_) ? samples_.back().time : FindEndOfGrip();
    for (const LoadSample& sample : samples_) {
      if (sample.time > until + kMostInterruption) break;
      if (sample.push > least) return &sample;
    }
    return nullptr;
  }

  double FindEndOfGrip() const {
    for (size_t at = samples_.size(); at-- > 0;) {
      for (const PartSample& part : samples_[at].parts) {
        if (part.force > 0.0f) return samples_[at].time;
      }
    }
    return samples_.back().time;
  }

  /** The digit whose command was behind when the first one touched, or that came long after all
  others to an object that had moved by then. */
  std::optional<size_t> FindLateDigit() const {
    const std::optional<size_t> first = FindFirstDigit();
    if (!first) return std::nullopt;
    const LoadSample& begin = At(FindTouch(*first));
    const float ahead = begin.parts[*first].closing;
    std::optional<size_t> last;
    double last_of_others = FindTouch(*first);
    for (size_t digit = 0; digit < num_digits(); ++digit) {
      const float own = begin.parts[digit].closing;
      if (own < ahead - kBehind || own < kBehindShare * ahead) return digit;
      const double touch = FindTouch(digit);
      if (std::isnan(touch) || digit == *first) continue;
      if (!last || touch > FindTouch(*last)) {
        if (last) last_of_others = std::max(last_of_others, FindTouch(*last));
        last = digit;
      } else {
        last_of_others = std::max(last_of_others, touch);
      }
    }
    if (!last || FindTouch(*last) <= last_of_others + kLate) return std::nullopt;
    return At(FindTouch(*last)).shift > begin.shift + kMoved ? last : std::nullopt;
  }

  /** One that never touched though it was asked for all of its way before the loss. */
  std::optional<size_t> FindMissingDigit(double lost_at) const {
    for (size_t digit = 0; digit < num_digits(); ++digit) {
      if (!std::isnan(FindTouch(digit))) continue;
      if (At(lost_at).parts[digit].closing >= kClosed) return digit;
    }
    return std::nullopt;
  }

  std::optional<size_t> FindFirstDigit() const {
    std::optional<size_t> first;
    for (size_t digit = 0; digit < num_digits(); ++digit) {
      if (std::isnan(FindTouch(digit))) continue;
      if (!first || FindTouch(digit) < FindTouch(*first)) first = digit;
    }
    return first;
  }

  double FindEndOfClosing() const {
    return std::isnan(lift_off_) ? samples_.back().time : lift_off_;
  }

 private:
  bool HasPressedBefore(size_t part, size_t sample) const {
    for (size_t at = 0; at < sample; ++at) {
      if (samples_[at].parts[part].force > 0.0f) return true;
    }
    return false;
  }

  const TrialResult& result_;
  const std::vector<LoadSample>& samples_;
  double closure_start_, lift_off_ = kUnset;
};

/** Digits with a drive at its limit for most of the time before, where not all are. */
std::optional<size_t> FindWeakDigit(const Course& course, const std::vector<LoadSample>& samples,
                                    double until) {
  std::vector<int> at_limit(course.num_digits(), 0);
  std::vector<double> force(course.num_digits(), 0.0);
  int num_samples = 0;
  for (const LoadSample& sample : samples) {
    if (sample.time > until || sample.time < until - kLookBack) continue;
    ++num_samples;
    for (size_t digit = 0; digit < course.num_digits(); ++digit) {
      at_limit[digit] += sample.parts[digit].is_at_limit;
      force[digit] += sample.parts[digit].force;
    }
  }
  std::optional<size_t> weak;
  int num_weak = 0;
  for (size_t digit = 0; digit < course.num_digits(); ++digit) {
    if (2 * at_limit[digit] <= num_samples) continue;
    ++num_weak;
    if (!weak || force[digit] < force[*weak]) weak = digit;
  }
  if (num_weak == static_cast<int>(course.num_digits())) return std::nullopt;
  return weak;
}

/** A part that slips with much less friction than the others have. */
std::optional<size_t> FindSlipperyPart(const std::vector<LoadSample>& samples, double around) {
  for (const LoadSample& sample : samples) {
    if (sample.time > around + kLookAhead || sample.time < around - kLookBack) continue;
    for (size_t part = 0; part < sample.parts.size(); ++part) {
      const PartSample& one = sample.parts[part];
      if (!one.is_sliding || one.force == 0.0f) continue;
      float least = std::numeric_limits<float>::infinity();
      for (size_t other = 0; other < sample.parts.size(); ++other) {
        if (other == part || sample.parts[other].force == 0.0f) continue;
        least = std::min(least, sample.parts[other].friction);
      }
      if (std::isfinite(least) && one.friction < kLowFriction * least) return part;
    }
  }
  return std::nullopt;
}

struct Loads {
  double others = 0.0;    // [N]
  double bearable = 0.0;  // [N]
};

Loads CalcLoads(const LoadSample& sample, size_t part) {
  Loads loads;
  for (size_t at = 0; at < sample.parts.size(); ++at) {
    if (at != part) loads.others += sample.parts[at].force;
    loads.bearable += sample.parts[at].friction * sample.parts[at].force;
  }
  return loads;
}

bool SaysItAll(Outcome outcome) {
  return outcome == Outcome::kUnreachable || outcome == Outcome::kNotSeen ||
         outcome == Outcome::kArmOverloaded || outcome == Outcome::kNotPhysical ||
         outcome == Outcome::kNumericalFailure || outcome == Outcome::kNotRun ||
         outcome == Outcome::kSuccess;
}

}  // namespace

std::optional<Diagnosis> FindDiagnosis(const TrialResult& result,
                                       const std::vector<LoadSample>& samples,
                                       double closure_start) {
  if (SaysItAll(result.outcome) || samples.empty()) return std::nullopt;
  Diagnosis diagnosis;
  const Course course(result, samples, closure_start);
  const std::optional<Loss> loss = course.FindLoss();
  const LoadSample& before = loss ? course.BeforeLoss(*loss) : samples.back();
  const double lost_at = loss ? samples[loss->sample].time : course.FindEndOfGrip();
  const Loads loads = CalcLoads(before, loss ? loss->part : before.parts.size());
  diagnosis.time = lost_at;
  diagnosis.bearable = loads.bearable;
  if (loss) {
    diagnosis.lost = course.NameOfPart(loss->part);
    diagnosis.force = before.parts[loss->part].force;
    diagnosis.others = loads.others;
  }
  const auto blame = [&](FailureCause cause, size_t part, const std::string& text) {
    diagnosis.cause = cause;
    diagnosis.digit = course.NameOfPart(part);
    diagnosis.text = text;
  };

  const LoadSample* push = course.FindPush();
  if (push) {
    diagnosis.cause = FailureCause::kPush;
    diagnosis.time = push->time;
    diagnosis.text = "Something other than hand and table pushed the object with " +
                     Newtons(push->push) + " at " + Times(push->time) + ".";
  } else if (const auto late = course.FindLateDigit()) {
    const double touch = course.FindTouch(*late);
    const size_t first = *course.FindFirstDigit();
    const LoadSample& then = course.At(std::isnan(touch) ? course.FindEndOfClosing() : touch);
    diagnosis.time = course.FindTouch(first);
    blame(FailureCause::kLateDigit, *late,
          course.NameOfPart(*late) +
              (std::isnan(touch)
                   ? " was late and had not touched when the hand was lifted"
                   : fmt::format(" touched {} ms after {}",
                                 FormatFixed(1e3 * (touch - course.FindTouch(first)), 0),
                                 course.NameOfPart(first))) +
              fmt::format("; by then the object had been moved by {} mm.",
                          FormatFixed(1e3 * then.shift, 1)));
  } else if (const auto slippery = FindSlipperyPart(samples, lost_at)) {
    const PartSample& part = course.At(lost_at).parts[*slippery];
    blame(FailureCause::kLowFriction, *slippery,
          fmt::format("{} slipped: its friction is {}, much less than that of the others.",
                      course.NameOfPart(*slippery), FormatFixed(part.friction, 2)));
  } else if (const auto weak = FindWeakDigit(course, samples, lost_at)) {
    blame(FailureCause::kWeakDigit, *weak,
          fmt::format("A drive of {} gave all it could, which pressed with {}.",
                      course.NameOfPart(*weak), Newtons(before.parts[*weak].force)));
  } else if (const auto missing = course.FindMissingDigit(lost_at)) {
    diagnosis.time = course.FindEndOfClosing();
    blame(FailureCause::kNoTouch, *missing,
          fmt::format("{} never touched the object; its nearest was {} mm.",
                      course.NameOfPart(*missing),
                      FormatFixed(1e3 * result.touches[*missing].smallest_gap, 1)));
  } else if (std::isnan(course.lift_off()) && course.FindFirstDigit()) {
    const size_t first = *course.FindFirstDigit();
    diagnosis.time = course.FindTouch(first);
    blame(FailureCause::kPushedByDigit, first,
          fmt::format("{} touched first, at {}, and pushed the object aside before another digit "
                      "held against it.",
                      course.NameOfPart(first), Times(diagnosis.time)));
  } else if (loads.bearable < result.weight) {
    diagnosis.cause = FailureCause::kWeakGrip;
    diagnosis.text = "The grip was too weak: friction could bear " + Newtons(loads.bearable) +
                     " of the weight of " + Newtons(result.weight) + ".";
  } else {
    diagnosis.cause = FailureCause::kNoBalance;
    diagnosis.text = "Friction could have borne the weight (" + Newtons(loads.bearable) + " of " +
                     Newtons(result.weight) + "), but the forces did not balance.";
  }
  if (loss) {
    diagnosis.text += fmt::format(
        " {} gave way first for good, at {}: it pressed with {}, {} % of its friction cone in use; "
        "the others pressed with {}.",
        diagnosis.lost, Times(lost_at), Newtons(diagnosis.force),
        FormatFixed(100.0 * before.parts[loss->part].cone_share, 0), Newtons(diagnosis.others));
  }
  return diagnosis;
}

}  // namespace graspbench
