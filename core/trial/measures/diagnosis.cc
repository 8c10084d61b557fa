#include "core/trial/measures/diagnosis.h"

#include <algorithm>
#include <cmath>

#include "core/trial/measures/load_recorder.h"
#include "core/trial/trial_result.h"

namespace graspbench {
namespace {

constexpr double kMostInterruption = 0.03;  // of a run of opposition [s]
constexpr double kOpposingForce = 0.05;     // of each of two parts [N]
constexpr double kOpposingTime = 0.02;      // [s]
const double kOpposingCosine = std::cos(RadFromDeg(110.0));
constexpr double kPushedAside = 0.005;  // [m]
constexpr double kGraspedTime = 0.5;    // duration of opposition after which the object counts as
                                        // grasped [s]
constexpr double kLeastPush = 0.2;      // [N]
constexpr double kLeastPushWeights = 0.5;
constexpr double kLeastFall = 0.0002;  // fall whose work counts [m]
constexpr double kGaveWay = 0.5;       // share of the work of all others
const double kSagging = RadFromDeg(15.0);
constexpr double kTimeRounding = 1e-9;  // [s]

bool AreOpposed(const PartSample& a, const PartSample& b) {
  const double force_a = a.normal_W.norm(), force_b = b.normal_W.norm();
  return std::min(force_a, force_b) >= kOpposingForce &&
         a.normal_W.dot(b.normal_W) < kOpposingCosine * force_a * force_b;
}

bool HasOpposition(const LoadSample& sample) {
  for (size_t a = 0; a < sample.parts.size(); ++a) {
    for (size_t b = 0; b < a; ++b) {
      if (AreOpposed(sample.parts[a], sample.parts[b])) return true;
    }
  }
  return false;
}

/** First and last sample with opposition. */
struct OpposedRun {
  size_t first, last;
};

std::vector<OpposedRun> ListOpposedRuns(const std::vector<LoadSample>& samples) {
  std::vector<OpposedRun> runs;
  const auto length = [&](const OpposedRun& run) {
    return samples[run.last].time - samples[run.first].time;
  };
  for (size_t at = 0; at < samples.size(); ++at) {
    if (!HasOpposition(samples[at])) continue;
    if (!runs.empty() &&
        samples[at].time - samples[runs.back().last].time < kMostInterruption + kTimeRounding) {
      runs.back().last = at;
    } else {
      runs.push_back({at, at});
    }
  }
  runs.erase(std::remove_if(runs.begin(), runs.end(),
                            [&](const OpposedRun& run) {
                              return length(run) < kOpposingTime - kTimeRounding;
                            }),
             runs.end());
  return runs;
}

/** Evaluates the samples of one trial. */
class LossFinder {
 public:
  LossFinder(const TrialResult& result, const std::vector<LoadSample>& samples,
             double closure_start, double window)
      : result_(result), samples_(samples), closure_start_(closure_start), window_(window) {}

  Diagnosis Find();

 private:
  size_t num_digits() const { return result_.contacts.size(); }
  std::string NameOfPart(size_t part) const {
    return part < num_digits() ? result_.contacts[part].digit.str() : "palm";
  }
  double FindLiftOff() const;  // NaN: not reached
  size_t FindLastTouch() const;
  double CalcTurn(size_t since, size_t at) const;
  void SetTime(double time);
  void AddLoss(const std::vector<OpposedRun>& runs);
  void AddWorks();
  bool IsPushedFromOutside();
  bool IsGrasped(const std::vector<OpposedRun>& runs) const;
  bool IsPushed(const std::vector<OpposedRun>& runs);
  bool IsNotReached(const std::vector<OpposedRun>& runs);
  void BlameDrive();
  void CompareWorks();
  /** The part with the largest value. */
  template <class Value>
  std::string FindPart(Value value) const;

  const TrialResult& result_;
  const std::vector<LoadSample>& samples_;
  double closure_start_, window_;
  Diagnosis found_;
  bool is_held_ = false;        // opposed to the end, and lifted
  size_t since_ = 0;            // sample from which its rotation counts
  size_t lost_ = 0;             // sample in which it was lost
  size_t begin_ = 0, end_ = 0;  // samples of the window
};

double LossFinder::FindLiftOff() const {
  for (const PhaseStart& phase : result_.phases) {
    if (phase.name == NameOf(Phase::kLiftOff)) return phase.time + closure_start_;
  }
  return kUnset;
}

size_t LossFinder::FindLastTouch() const {
  for (size_t at = samples_.size(); at-- > 0;) {
    for (const PartSample& part : samples_[at].parts) {
      if (part.force > 0.0f) return at;
    }
  }
  return samples_.size() - 1;
}

template <class Value>
std::string LossFinder::FindPart(Value value) const {
  const auto most =
      std::max_element(found_.parts.begin(), found_.parts.end(),
                       [&](const PartWork& a, const PartWork& b) { return value(a) < value(b); });
  return most == found_.parts.end() ? "" : most->part;
}

double LossFinder::CalcTurn(size_t since, size_t at) const {
  const Eigen::Matrix3d turned =
      (samples_[since].R_HO.transpose() * samples_[at].R_HO).cast<double>();
  return Eigen::AngleAxisd(turned).angle();
}

void LossFinder::SetTime(double time) {
  found_.time = time;
  found_.phase = NameOf(Phase::kPlacing);
  for (const PhaseStart& phase : result_.phases) {
    if (phase.time + closure_start_ < time && phase.name != NameOf(Phase::kDone)) {
      found_.phase = phase.name;
    }
  }
}

void LossFinder::AddLoss(const std::vector<OpposedRun>& runs) {
  lost_ = runs.empty() ? FindLastTouch() : runs.back().last;
  end_ = lost_ + 1;
  begin_ = runs.empty() ? lost_ : runs.back().first;
  SetTime(samples_[lost_].time);
  if (!runs.empty()) {
    found_.opposed_since = samples_[runs.front().first].time;
    since_ = runs.front().first;
    const double lift_off = FindLiftOff();
    if (samples_[lost_].time > lift_off) {
      while (samples_[since_].time < lift_off) ++since_;
      is_held_ = samples_.back().time - samples_[lost_].time < kMostInterruption;
    }
    found_.turn = CalcTurn(since_, lost_);
  }
  if (is_held_) {
    begin_ = since_;
  } else {
    while (samples_[begin_].time < samples_[lost_].time - window_ - kTimeRounding) ++begin_;
  }
}

void LossFinder::AddWorks() {
  double table = 0.0;
  std::vector<PartWork> parts(samples_.front().parts.size());
  for (size_t at = begin_; at < end_; ++at) {
    table += samples_[at].table_force;
    found_.gravity_work += samples_[at].gravity_work;
    for (size_t part = 0; part < parts.size(); ++part) {
      const PartSample& sample = samples_[at].parts[part];
      parts[part].force = std::max<double>(parts[part].force, sample.force);
      parts[part].normal_work += sample.normal_work;
      parts[part].friction_work += sample.friction_work;
    }
  }
  found_.table_share = table / static_cast<double>(end_ - begin_) / result_.weight;
  for (size_t part = 0; part < parts.size(); ++part) {
    parts[part].part = NameOfPart(part);
    if (parts[part].force > 0.0) found_.parts.push_back(parts[part]);
  }
}

/** For an object that was lifted, considers only the time while the hand touched it. */
bool LossFinder::IsPushedFromOutside() {
  const double least = std::max(kLeastPush, kLeastPushWeights * result_.weight);
  const double until =
      std::isnan(FindLiftOff()) ? samples_.back().time : samples_[FindLastTouch()].time;
  for (const LoadSample& sample : samples_) {
    if (sample.time > until + kMostInterruption) break;
    if (sample.push <= least) continue;
    found_.mechanism = Mechanism::kOutsidePush;
    SetTime(sample.time);
    found_.push = sample.push;
    return true;
  }
  return false;
}

/** Whether two parts once opposed each other for kGraspedTime. */
bool LossFinder::IsGrasped(const std::vector<OpposedRun>& runs) const {
  return std::any_of(runs.begin(), runs.end(), [&](const OpposedRun& run) {
    return samples_[run.last].time - samples_[run.first].time >= kGraspedTime - kTimeRounding;
  });
}

/** Names the part that pressed most until the object had moved by kPushedAside, dated to its first
touch. An object that was grasped afterwards has another mechanism. */
bool LossFinder::IsPushed(const std::vector<OpposedRun>& runs) {
  const size_t until = runs.empty() ? samples_.size() : runs.front().first;
  std::vector<double> pressed(samples_.front().parts.size(), 0.0);
  std::vector<double> touched(pressed.size(), kUnset);
  found_.shift = 0.0;
  for (size_t at = 0; at < until; ++at) {
    found_.shift = std::max(found_.shift, samples_[at].shift);
    if (found_.mechanism == Mechanism::kPushed || IsGrasped(runs)) continue;
    for (size_t part = 0; part < pressed.size(); ++part) {
      const double force = samples_[at].parts[part].force;
      pressed[part] += force;
      if (force > 0.0) touched[part] = std::fmin(touched[part], samples_[at].time);
    }
    const auto most = std::max_element(pressed.begin(), pressed.end());
    if (*most == 0.0 || found_.shift <= kPushedAside) continue;
    found_.mechanism = Mechanism::kPushed;
    const auto part = static_cast<size_t>(most - pressed.begin());
    SetTime(touched[part]);
    found_.part = NameOfPart(part);
  }
  return found_.mechanism == Mechanism::kPushed;
}

bool LossFinder::IsNotReached(const std::vector<OpposedRun>& runs) {
  if (!runs.empty()) return false;
  found_.mechanism = Mechanism::kNotReached;
  for (size_t digit = 0; digit < num_digits() && found_.part.empty(); ++digit) {
    if (std::isnan(result_.contacts[digit].time)) found_.part = NameOfPart(digit);
  }
  return true;
}

/** Blames a drive for an object that was squeezed out, sagged or slid. */
void LossFinder::BlameDrive() {
  std::vector<size_t> full;  // digits
  for (size_t digit = 0; digit < num_digits(); ++digit) {
    size_t num_full = 0;
    for (size_t at = begin_; at < end_; ++at) num_full += samples_[at].parts[digit].is_at_limit;
    if (2 * num_full > end_ - begin_) full.push_back(digit);
  }
  if (full.size() == num_digits()) return;
  double driving = std::max(0.0, found_.gravity_work);
  for (const PartWork& part : found_.parts) driving += std::max(0.0, part.normal_work);
  const bool is_heavy = found_.mechanism != Mechanism::kSqueezedOut;
  for (const size_t digit : full) {
    const auto part = std::find_if(found_.parts.begin(), found_.parts.end(),
                                   [&](const PartWork& p) { return p.part == NameOfPart(digit); });
    if (part == found_.parts.end()) continue;
    if (!is_heavy && !(-part->normal_work >= kGaveWay * driving)) continue;
    found_.mechanism = Mechanism::kDriveAtLimit;
    found_.part = part->part;
    for (size_t at = begin_; at < end_; ++at) {
      const PartSample& sample = samples_[at].parts[digit];
      if (sample.is_at_limit) found_.joint = sample.limit_joint;
    }
    return;
  }
}

void LossFinder::CompareWorks() {
  const double normal = found_.CalcNormalWork(), gravity = found_.gravity_work;
  const double most = std::max(normal, gravity);
  if (most < kLeastFall * result_.weight) return;  // not identified
  if (found_.CalcFrictionWork() > most) return;    // it was dragged
  if (normal > gravity) {
    found_.mechanism = Mechanism::kSqueezedOut;
    found_.part = FindPart([](const PartWork& part) { return part.normal_work; });
    return;
  }
  found_.mechanism = found_.turn > kSagging ? Mechanism::kSagged : Mechanism::kSlid;
  if (is_held_ && found_.mechanism == Mechanism::kSagged) {
    size_t at = since_;
    while (CalcTurn(since_, at) <= kSagging) ++at;
    SetTime(samples_[at].time);
  }
  found_.part = FindPart([](const PartWork& part) { return -part.friction_work; });
}

Diagnosis LossFinder::Find() {
  const std::vector<OpposedRun> runs = ListOpposedRuns(samples_);
  AddLoss(runs);
  AddWorks();
  if (result_.outcome == Outcome::kArmOverloaded) {
    found_.mechanism = Mechanism::kArmAtLimit;
    if (result_.arm) found_.joint = result_.arm->torque_joint;
    SetTime(samples_.back().time);
    return found_;
  }
  if (IsPushedFromOutside() || IsPushed(runs) || IsNotReached(runs)) return found_;
  CompareWorks();
  if (found_.mechanism != Mechanism::kNotIdentified) BlameDrive();
  return found_;
}

bool SaysItAll(Outcome outcome) {
  switch (outcome) {
    case Outcome::kNotRun:
    case Outcome::kSuccess:
    case Outcome::kUnreachable:
    case Outcome::kArmOutOfReach:
    case Outcome::kNoStraightPath:
    case Outcome::kNearSingularity:
    case Outcome::kNotSeen:
    case Outcome::kNotPhysical:
    case Outcome::kWrongAnswer:
    case Outcome::kNumericalFailure:
      return true;
    default:
      return false;
  }
}

}  // namespace

double Diagnosis::CalcNormalWork() const {
  double work = 0.0;
  for (const PartWork& one : parts) work += one.normal_work;
  return work;
}

double Diagnosis::CalcFrictionWork() const {
  double work = 0.0;
  for (const PartWork& one : parts) work += one.friction_work;
  return work;
}

std::optional<Diagnosis> FindDiagnosis(const TrialResult& result,
                                       const std::vector<LoadSample>& samples, double closure_start,
                                       double window) {
  if (SaysItAll(result.outcome) || samples.empty()) return std::nullopt;
  return LossFinder(result, samples, closure_start, window).Find();
}

}  // namespace graspbench
