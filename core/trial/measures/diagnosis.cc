#include "core/trial/measures/diagnosis.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/base/text/text.h"
#include "core/base/units.h"
#include "core/trial/measures/load_recorder.h"
#include "core/trial/trial_result.h"

namespace graspbench {
namespace {

constexpr double kSampleInterval = 0.01;    // of samples [s]
constexpr double kMostInterruption = 0.03;  // of a run of slipping [s]
constexpr double kLookBack = 0.3;           // from the loss to its cause [s]
constexpr double kLookAhead = 0.1;          // to a slip that shows the cause [s]
constexpr double kLeastPush = 0.2;          // [N]
constexpr double kLeastPushWeights = 0.5;
constexpr float kBehind = 0.08f;      // of the closing
constexpr float kBehindShare = 0.5f;  // of the closing of the one that touched
constexpr double kClosed = 0.99;      // of the way to the target posture
constexpr double kLowFriction = 0.75;
constexpr double kPushedAside = 0.005;   // [m]
constexpr double kOpposingForce = 0.05;  // of each of two parts [N]
constexpr double kOpposingTime = 0.02;   // [s]
const double kOpposingCosine = std::cos(RadFromDeg(110.0));

std::string Seconds(double time) { return FormatFixed(time, 3) + " s"; }
std::string Newtons(double force) { return FormatFixed(force, force < 0.1 ? 3 : 2) + " N"; }

bool IsOpposing(const PartSample& a, const PartSample& b) {
  const double force_a = a.normal_W.norm(), force_b = b.normal_W.norm();
  return std::min(force_a, force_b) >= kOpposingForce &&
         a.normal_W.dot(b.normal_W) < kOpposingCosine * force_a * force_b;
}

/** Two parts that press against each other through the object, for kOpposingTime or longer. */
struct Opposing {
  size_t a, b;  // parts
  double from, until;
};

struct PushingDigit {
  size_t digit;
  double time;  // at which the object had moved by kPushedAside
};

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

  /** The digit whose command was farthest behind that of another when that one first touched. */
  std::optional<size_t> FindLateDigit() const {
    std::optional<size_t> late;
    float farthest = 0.0f;
    for (size_t other = 0; other < num_digits(); ++other) {
      const double touch = FindTouch(other);
      if (std::isnan(touch)) continue;
      const std::vector<PartSample>& parts =
          At(touch - kSampleInterval).parts;  // before it is held back
      const float ahead = parts[other].closing;
      for (size_t digit = 0; digit < num_digits(); ++digit) {
        // Regulation holds back the command of a digit whose drive gives all it can.
        if (FindTouch(digit) <= touch || IsAtLimit(digit, touch - kLookBack, touch)) {
          continue;
        }
        const float behind = ahead - parts[digit].closing;
        const bool is_late = behind > kBehind || parts[digit].closing < kBehindShare * ahead;
        if (!is_late || behind <= farthest) continue;
        late = digit;
        farthest = behind;
      }
    }
    return late;
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

  /** Whether a drive of it was at its limit in most of the time between. */
  bool IsAtLimit(size_t digit, double from, double until) const {
    int num_samples = 0, num_at_limit = 0;
    for (const LoadSample& sample : samples_) {
      if (sample.time > until || sample.time < from) continue;
      ++num_samples;
      num_at_limit += sample.parts[digit].is_at_limit;
    }
    return 2 * num_at_limit > num_samples;
  }

  /** "The drive of FFJ3 of FF": the last at its limit up to then. */
  std::string NameFullDrive(size_t digit, double until) const {
    std::string_view joint;
    for (const LoadSample& sample : samples_) {
      if (sample.time > until) break;
      if (sample.parts[digit].is_at_limit) joint = sample.parts[digit].limit_joint;
    }
    return joint.empty() ? "A drive of " + NameOfPart(digit)
                         : fmt::format("The drive of {} of {}", joint, NameOfPart(digit));
  }

  /** The first that goes on after a time. */
  std::optional<Opposing> FindOpposing(double after) const {
    std::optional<Opposing> first;
    for (size_t a = 0; a < samples_.front().parts.size(); ++a) {
      for (size_t b = 0; b < a; ++b) {
        double from = kUnset;
        for (const LoadSample& sample : samples_) {
          if (!IsOpposing(sample.parts[a], sample.parts[b])) {
            from = kUnset;
            continue;
          }
          if (std::isnan(from)) from = sample.time;
          if (sample.time < after || sample.time - from < kOpposingTime - 1e-9) continue;
          if (!first || from < first->from) first = Opposing{a, b, from, sample.time};
          break;
        }
      }
    }
    return first;
  }

  /** The digit that pressed most until the object had moved by kPushedAside, with no two parts that
  pressed against each other before; none: another part did. */
  std::optional<PushingDigit> FindPushingDigit() const {
    const std::optional<Opposing> opposing = FindOpposing(0.0);
    std::vector<double> pressed(samples_.front().parts.size(), 0.0);
    for (const LoadSample& sample : samples_) {
      if (opposing && sample.time >= opposing->from) break;
      for (size_t part = 0; part < pressed.size(); ++part) {
        pressed[part] += sample.parts[part].force;
      }
      if (sample.shift <= kPushedAside) continue;
      const auto most = std::max_element(pressed.begin(), pressed.end());
      const auto part = static_cast<size_t>(most - pressed.begin());
      if (*most > 0.0 && part < num_digits()) return PushingDigit{part, sample.time};
      break;
    }
    return std::nullopt;
  }

  /** Along the table [m]. */
  double FindLargestShift() const {
    double largest = 0.0;
    for (const LoadSample& sample : samples_) largest = std::max<double>(largest, sample.shift);
    return largest;
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

/** Digits with a drive at its limit in most of the time just before, or since the first touch, where
not all are: the one that presses least. */
std::optional<size_t> FindWeakDigit(const Course& course, double until) {
  const std::vector<PartSample>& parts = course.At(until).parts;
  const std::optional<size_t> first = course.FindFirstDigit();
  const double first_touch = first ? course.FindTouch(*first) : until;
  std::optional<size_t> weak;
  size_t num_weak = 0;
  for (size_t digit = 0; digit < course.num_digits(); ++digit) {
    if (!course.IsAtLimit(digit, until - kLookBack, until) &&
        !course.IsAtLimit(digit, first_touch, until)) {
      continue;
    }
    ++num_weak;
    if (!weak || parts[digit].force < parts[*weak].force) weak = digit;
  }
  return num_weak < course.num_digits() ? weak : std::nullopt;
}

struct SlipperyPart {
  size_t part;
  double friction;  // in the sample in which it slips
};

/** A part that slipped up to then with much less friction than the others have. */
std::optional<SlipperyPart> FindSlipperyPart(const std::vector<LoadSample>& samples, double until) {
  std::vector<float> most(samples.front().parts.size(), 0.0f);  // friction; 0: never touched
  for (const LoadSample& sample : samples) {
    for (size_t part = 0; part < most.size(); ++part) {
      most[part] = std::max(most[part], sample.parts[part].friction);
    }
  }
  for (const LoadSample& sample : samples) {
    if (sample.time > until + kLookAhead) break;
    for (size_t part = 0; part < most.size(); ++part) {
      const PartSample& one = sample.parts[part];
      if (!one.is_sliding || one.force == 0.0f) continue;
      float least = std::numeric_limits<float>::infinity();
      for (size_t other = 0; other < most.size(); ++other) {
        if (other != part && most[other] > 0.0f) least = std::min(least, most[other]);
      }
      if (std::isfinite(least) && one.friction < kLowFriction * least) {
        return SlipperyPart{part, one.friction};
      }
    }
  }
  return std::nullopt;
}

struct Loads {
  double others = 0.0;    // [N]
  double bearable = 0.0;  // [N]
  double pressing = 0.0;  // weight and normal forces together, which friction has to bear [N]
};

Loads CalcLoads(const LoadSample& sample, size_t part, double weight) {
  Loads loads;
  Eigen::Vector3d rest_W(0.0, 0.0, -weight);
  for (size_t at = 0; at < sample.parts.size(); ++at) {
    if (at != part) loads.others += sample.parts[at].force;
    loads.bearable += sample.parts[at].friction * sample.parts[at].force;
    rest_W += sample.parts[at].normal_W.cast<double>();
  }
  if (sample.is_on_table) rest_W.z() = std::max(0.0, rest_W.z());
  loads.pressing = rest_W.norm();
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
  const Loads loads = CalcLoads(before, loss ? loss->part : before.parts.size(), result.weight);
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

  const bool is_lifted = !std::isnan(course.lift_off());
  const LoadSample* push = course.FindPush();
  if (push) {
    diagnosis.cause = FailureCause::kPush;
    diagnosis.time = push->time;
    diagnosis.text = "Something other than hand and table pushed the object with " +
                     Newtons(push->push) + " at " + Seconds(push->time) + ".";
  } else if (const auto late = course.FindLateDigit()) {
    const double touch = course.FindTouch(*late);
    const size_t first = *course.FindFirstDigit();
    const LoadSample& then = course.At(std::isnan(touch) ? course.FindEndOfClosing() : touch);
    diagnosis.time = course.FindTouch(first);
    blame(FailureCause::kLateDigit, *late,
          course.NameOfPart(*late) +
              (std::isnan(touch)
                   ? std::string(" was late and had not touched when the ") +
                         (std::isnan(course.lift_off()) ? "trial ended" : "hand was lifted")
                   : fmt::format(" touched {} ms after {}",
                                 FormatFixed(1e3 * (touch - course.FindTouch(first)), 0),
                                 course.NameOfPart(first))) +
              fmt::format("; by then the object had been moved by {} mm.",
                          FormatFixed(1e3 * then.shift, 1)));
  } else if (const auto slippery = FindSlipperyPart(samples, lost_at)) {
    blame(FailureCause::kLowFriction, slippery->part,
          fmt::format("{} slipped: its friction is {}, much less than that of the others.",
                      course.NameOfPart(slippery->part), FormatSignificant(slippery->friction, 2)));
  } else if (const auto weak = FindWeakDigit(course, lost_at)) {
    blame(FailureCause::kWeakDigit, *weak,
          fmt::format("{} gave all it could, which pressed with {}.",
                      course.NameFullDrive(*weak, lost_at), Newtons(before.parts[*weak].force)));
  } else if (const auto missing = course.FindMissingDigit(lost_at)) {
    diagnosis.time = course.FindEndOfClosing();
    blame(FailureCause::kNoTouch, *missing,
          fmt::format("{} never touched the object; its nearest was {} mm.",
                      course.NameOfPart(*missing),
                      FormatFixed(1e3 * result.touches[*missing].smallest_gap, 1)));
  } else if (is_lifted && loads.bearable < result.weight && !before.is_on_table) {
    diagnosis.cause = FailureCause::kWeakGrip;
    diagnosis.text = "The grip was too weak: friction could bear " + Newtons(loads.bearable) +
                     " of the weight of " + Newtons(result.weight) + ".";
  } else if (is_lifted && loads.bearable >= result.weight && loads.bearable < loads.pressing) {
    diagnosis.cause = FailureCause::kPressedOut;
    diagnosis.text = "The object was pressed out of the grip: normal forces and weight left " +
                     Newtons(loads.pressing) + " to friction, which could bear " +
                     Newtons(loads.bearable) + ".";
  } else if (is_lifted && loads.bearable >= result.weight) {
    diagnosis.cause = FailureCause::kTurned;
    diagnosis.text = "The object turned in the grip: friction could have borne the forces (" +
                     Newtons(loads.bearable) + " of " + Newtons(loads.pressing) +
                     "), but their moments did not balance.";
  } else if (const auto pushing = course.FindPushingDigit()) {
    diagnosis.time = pushing->time;
    blame(FailureCause::kPushedByDigit, pushing->digit,
          fmt::format(
              "{} pushed the object aside, by more than {:.0f} mm at {}, before two parts of "
              "the hand pressed against each other.",
              course.NameOfPart(pushing->digit), MmFromM(kPushedAside), Seconds(diagnosis.time)));
  } else if (const auto squeeze = course.FindOpposing(lost_at - kMostInterruption);
             squeeze && squeeze->from <= lost_at && course.FindLargestShift() > kPushedAside) {
    const std::vector<PartSample>& parts = course.At(squeeze->until).parts;
    diagnosis.cause = FailureCause::kSqueezedOut;
    diagnosis.text = fmt::format(
        "The object was squeezed out while both sides pressed: {} with {} and {} with {} at {}, "
        "against each other from {} on.",
        course.NameOfPart(squeeze->b), Newtons(parts[squeeze->b].force),
        course.NameOfPart(squeeze->a), Newtons(parts[squeeze->a].force), Seconds(squeeze->until),
        Seconds(squeeze->from));
  } else {
    diagnosis.cause = FailureCause::kNotIdentified;
    const bool is_opposed = squeeze && squeeze->from <= lost_at;
    diagnosis.text =
        is_opposed ? fmt::format(
                         "The cause was not identified: two parts of the hand pressed against each "
                         "other, and the object moved by {} mm at most.",
                         FormatFixed(1e3 * course.FindLargestShift(), 1))
                   : "The cause was not identified: no two parts of the hand pressed against each "
                     "other at " +
                         Seconds(lost_at) + ".";
  }
  if (loss) {
    diagnosis.text += fmt::format(
        " {} gave way first for good, at {}: it pressed with {}, {} % of its friction cone in use; "
        "the others pressed with {}.",
        diagnosis.lost, Seconds(lost_at), Newtons(diagnosis.force),
        FormatFixed(100.0 * before.parts[loss->part].cone_share, 0), Newtons(diagnosis.others));
  }
  return diagnosis;
}

}  // namespace graspbench
