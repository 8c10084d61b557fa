#include "human_study/study/inference/independence_null.h"

#include <algorithm>
#include <map>
#include <numeric>

#include "core/base/random.h"
#include "core/base/text/text.h"
#include "core/base/units.h"
#include "core/statistics/distributions.h"
#include "core/statistics/summary.h"
#include "human_study/study/run/run_study.h"

namespace graspbench {
namespace {

constexpr int kNumDealings = 999;
constexpr size_t kMinTrials = 3;       // of a person in a condition
constexpr size_t kMinNullPersons = 5;  // for an interval over persons
constexpr double kSignificant = 0.05;
constexpr double kRounding = 1e-9;
constexpr double kSteepestPace = 1.5;  // of a touch over the movement's length

struct TimedTrial {
  size_t person = 0;
  std::vector<double> contacts;  // in the order of the study's digits [s]
  double shared_variance = 0.0;  // of the errors that all contacts share [s^2]
  EventTime onset, end, widest;
  const Movement* movement = nullptr;
};
using Stratum = std::vector<TimedTrial>;

/** Where each digit's clock stands at zero in each trial, and the errors of those places. */
struct ClockZeros {
  std::vector<std::vector<double>> times;  // [digit][trial] [s]
  std::vector<double> variances;           // [digit], mean over the trials [s^2]
};

double Square(double value) { return value * value; }

double CalcLength(const TimedTrial& trial) { return trial.end.time - trial.onset.time; }

/** How a digit's time since the onset goes with the movement's length, over one person's trials,
means of conditions taken out. */
double CalcPaceSlope(const std::vector<const Stratum*>& of_person, size_t digit) {
  double products = 0.0, squares = 0.0;
  for (const Stratum* stratum : of_person) {
    double length = 0.0, time = 0.0;
    for (const TimedTrial& trial : *stratum) {
      length += CalcLength(trial) / static_cast<double>(stratum->size());
      time += (trial.contacts[digit] - trial.onset.time) / static_cast<double>(stratum->size());
    }
    for (const TimedTrial& trial : *stratum) {
      products += (CalcLength(trial) - length) * (trial.contacts[digit] - trial.onset.time - time);
      squares += Square(CalcLength(trial) - length);
    }
  }
  // A touch comes at a share of the movement; where lengths hardly differ a slope is mostly noise.
  const double length = CalcLength(of_person.front()->front());
  const bool has_slope = squares > Square(1e-6 * length);
  return has_slope ? std::clamp(products / squares, 0.0, kSteepestPace) : 0.0;
}

/** @param of_person  all strata of the same person, for clock 2. */
ClockZeros ReadClock(const Stratum& stratum, size_t clock,
                     const std::vector<const Stratum*>& of_person) {
  ClockZeros zeros;
  for (size_t digit = 0; digit < stratum.front().contacts.size(); ++digit) {
    const double slope = clock == 2 ? CalcPaceSlope(of_person, digit) : 0.0;
    std::vector<double>& times = zeros.times.emplace_back();
    double& variance = zeros.variances.emplace_back(0.0);
    for (const TimedTrial& trial : stratum) {
      double error = Square(trial.widest.uncertainty);
      if (clock == 1) {
        times.push_back(trial.widest.time);
      } else {
        times.push_back(trial.onset.time + slope * CalcLength(trial));
        error =
            Square((1.0 - slope) * trial.onset.uncertainty) + Square(slope * trial.end.uncertainty);
      }
      variance += (error + trial.shared_variance) / static_cast<double>(stratum.size());
    }
  }
  return zeros;
}

struct Measures {
  double gft = 0.0, ratio = 0.0;
};

/** @pre the last contact comes after the widest opening. */
Measures CalcMeasuresOf(const double* times, size_t count, double widest) {
  const auto [first, last] = std::minmax_element(times, times + count);
  return {*last - *first, (*last - *first) / (*last - widest)};
}

/** What one digit's clock shows in the trials of a stratum. */
struct Readings {
  double mean = 0.0;
  double variance = 0.0;           // within the stratum
  std::vector<double> deviations;  // from the mean, in the order in which they are dealt
};

Readings ReadDigit(const Stratum& stratum, size_t digit, const ClockZeros& zeros) {
  Readings readings;
  for (size_t i = 0; i < stratum.size(); ++i) {
    readings.deviations.push_back(stratum[i].contacts[digit] - zeros.times[digit][i]);
  }
  const Moments moments = CalcMoments(readings.deviations);
  readings.mean = moments.mean;
  readings.variance = moments.sum_of_squares / (static_cast<double>(stratum.size()) - 1.0);
  for (double& deviation : readings.deviations) deviation -= moments.mean;
  return readings;
}

/** Sums over the trials of one person. */
struct PersonSum {
  double gft = 0.0, ratio = 0.0;
};

/** Independent digits with all their spread, and without what may be the clock's error. */
enum Spread : size_t { kWhole, kReduced, kNumSpreads };
template <class T>
using PerSpread = std::array<T, kNumSpreads>;

class Dealer {
 public:
  Dealer(const std::vector<Stratum>& strata, size_t clock, size_t num_persons, RandomStream& random)
      : strata_(strata), random_(random) {
    for (std::vector<PersonSum>& sums : sums_) sums.resize(num_persons);
    for (const Stratum& stratum : strata) {
      std::vector<const Stratum*> of_person;
      for (const Stratum& other : strata) {
        if (other.front().person == stratum.front().person) of_person.push_back(&other);
      }
      zeros_.push_back(ReadClock(stratum, clock, of_person));
      std::vector<Readings>& digits = readings_.emplace_back();
      for (size_t digit = 0; digit < stratum.front().contacts.size(); ++digit) {
        digits.push_back(ReadDigit(stratum, digit, zeros_.back()));
      }
      ones_.assign(stratum.front().contacts.size(), 1.0);
    }
  }

  /** One permutation; the means over all trials. */
  PerSpread<Measures> Deal() {
    PerSpread<Measures> means;
    int count = 0;
    for (const Stratum& stratum : strata_) count += static_cast<int>(stratum.size());
    for (size_t s = 0; s < strata_.size(); ++s) {
      const std::vector<double> kept = DrawKept(s);
      for (Readings& readings : readings_[s]) Shuffle(readings.deviations);
      for (size_t i = 0; i < strata_[s].size(); ++i) {
        for (const Spread spread : {kWhole, kReduced}) {
          const Measures dealt = MeasureDealt(s, i, spread == kReduced ? kept : ones_);
          means[spread].gft += dealt.gft / count;
          means[spread].ratio += dealt.ratio / count;
          PersonSum& sum = sums_[spread][strata_[s][i].person];
          sum.gft += dealt.gft / kNumDealings;
          sum.ratio += dealt.ratio / kNumDealings;
        }
      }
    }
    return means;
  }

  /** Means over the permutations so far. */
  const PerSpread<std::vector<PersonSum>>& sums() const { return sums_; }

 private:
  /** @param kept  of each digit's deviation. */
  Measures MeasureDealt(size_t s, size_t i, const std::vector<double>& kept) {
    times_.clear();
    for (size_t digit = 0; digit < readings_[s].size(); ++digit) {
      const Readings& readings = readings_[s][digit];
      times_.push_back(zeros_[s].times[digit][i] + readings.mean +
                       kept[digit] * readings.deviations[i]);
    }
    Measures dealt = CalcMeasuresOf(times_.data(), times_.size(), strata_[s][i].widest.time);
    // Dealt before the widest opening: all of the closure, as near as a share can say.
    if (!(dealt.ratio >= 0.0 && dealt.ratio <= 1.0)) dealt.ratio = 1.0;
    return dealt;
  }

  /** Share of each digit's spread that is not the clock's error. These trials have one sample of
  the errors, of which only the expected variance is known. Each permutation therefore draws
  another sample, with its chance correlation with the digit's own spread. */
  std::vector<double> DrawKept(size_t s) {
    const size_t n = strata_[s].size();
    normals_.clear();
    for (size_t i = 0; i < n; ++i) normals_.push_back(random_.NextNormal());
    const double df = static_cast<double>(n) - 1.0;
    const double factor = CalcMoments(normals_).sum_of_squares / df;
    std::vector<double> kept;
    for (size_t digit = 0; digit < readings_[s].size(); ++digit) {
      const double variance = readings_[s][digit].variance;
      const double error = factor * zeros_[s].variances[digit];
      const double own = std::max(0.0, variance - zeros_[s].variances[digit]);
      const double product = 2.0 * std::sqrt(error * own / df) * random_.NextNormal();
      kept.push_back(
          variance > 0.0 ? std::sqrt(std::max(0.0, variance - error - product) / variance) : 0.0);
    }
    return kept;
  }

  void Shuffle(std::vector<double>& values) {
    for (size_t i = values.size(); i > 1; --i) {
      std::swap(values[i - 1], values[static_cast<size_t>(random_.NextIndex(static_cast<int>(i)))]);
    }
  }

  const std::vector<Stratum>& strata_;
  std::vector<ClockZeros> zeros_;
  std::vector<std::vector<Readings>> readings_;  // [stratum][digit]
  std::vector<double> times_, normals_, ones_;
  PerSpread<std::vector<PersonSum>> sums_;
  RandomStream& random_;
};

/** The set that people are told from, if from any. */
Spread ChooseSpread(double observed, const PerSpread<std::vector<double>>& dealt) {
  return observed < CalcMean(dealt[kReduced]) ? kReduced : kWhole;
}

/** @param diluted  share of trials that a permutation leaves as they were. */
void SetTest(double observed, PerSpread<std::vector<double>> sets, double diluted,
             IndependenceTest& test) {
  const Spread spread = ChooseSpread(observed, sets);
  for (std::vector<double>& set : sets) std::sort(set.begin(), set.end());
  const std::vector<double>& dealt = sets[spread];
  test.observed = observed;
  test.expected = CalcMean(dealt);
  const bool is_between = spread == kWhole && observed < test.expected;
  test.low = CalcSortedQuantile(sets[is_between ? kReduced : spread], 0.025);
  test.high = CalcSortedQuantile(dealt, 0.975);
  // A difference that is rounding is none.
  const auto is_as_extreme = [&](double value) {
    return spread == kReduced ? value <= observed * (1.0 + kRounding)
                              : value >= observed * (1.0 - kRounding);
  };
  const double count = 1.0 + std::count_if(dealt.begin(), dealt.end(), is_as_extreme);
  test.p = std::min(1.0, 2.0 * count / (kNumDealings + 1.0));
  const double n = static_cast<double>(dealt.size());
  const double sd = std::sqrt(CalcMoments(dealt).sum_of_squares / (n - 1.0));
  test.detectable =
      (CalcNormalQuantile(0.975) + CalcNormalQuantile(0.8)) * sd / test.expected / (1.0 - diluted);
}

Answer<JackknifeInterval> CompareOverPersons(const std::vector<PersonSum>& observed,
                                             const std::vector<PersonSum>& expected,
                                             double PersonSum::*field) {
  if (observed.size() < kMinNullPersons) {
    return NoAnswer{FormatCount(observed.size(), "person") + "; expected " +
                    std::to_string(kMinNullPersons) + " or more"};
  }
  return CalcJackknife(observed.size(), [&](const std::vector<size_t>& members) {
    double sum = 0.0;
    for (const size_t member : members) {
      sum += std::log(observed[member].*field / expected[member].*field);
    }
    return sum / static_cast<double>(members.size());
  });
}

void CalcClock(const std::vector<Stratum>& strata, size_t clock, const std::string& id,
               IndependenceNull& null) {
  const auto num_persons = static_cast<size_t>(null.num_persons);
  std::vector<PersonSum> observed(num_persons);
  Measures means;
  for (const Stratum& stratum : strata) {
    for (const TimedTrial& trial : stratum) {
      const Measures own =
          CalcMeasuresOf(trial.contacts.data(), trial.contacts.size(), trial.widest.time);
      observed[trial.person].gft += own.gft;
      observed[trial.person].ratio += own.ratio;
      means.gft += own.gft / null.num_trials;
      means.ratio += own.ratio / null.num_trials;
    }
  }
  const double diluted = static_cast<double>(strata.size()) / null.num_trials;
  RandomStream random(id, std::string("independent digits, ") + ListClocks()[clock]);
  Dealer dealer(strata, clock, num_persons, random);
  PerSpread<std::vector<double>> gfts, ratios;
  for (int i = 0; i < kNumDealings; ++i) {
    const PerSpread<Measures> dealt = dealer.Deal();
    for (const Spread spread : {kWhole, kReduced}) {
      gfts[spread].push_back(dealt[spread].gft);
      ratios[spread].push_back(dealt[spread].ratio);
    }
  }
  null.gft[clock].over_persons =
      CompareOverPersons(observed, dealer.sums()[ChooseSpread(means.gft, gfts)], &PersonSum::gft);
  null.gft_ratio[clock].over_persons = CompareOverPersons(
      observed, dealer.sums()[ChooseSpread(means.ratio, ratios)], &PersonSum::ratio);
  SetTest(means.gft, std::move(gfts), diluted, null.gft[clock]);
  SetTest(means.ratio, std::move(ratios), diluted, null.gft_ratio[clock]);
}

/** Whether the wrist's rise was seen. */
bool HasRise(const Movement& movement) {
  const std::array<double, 3>& rise = movement.rise;
  return std::isfinite(rise[0] + rise[1] + rise[2] + movement.distance);
}

SharedTimingTrial MakeShared(const TimedTrial& timed, bool by_rise) {
  SharedTimingTrial shared;
  shared.contacts = timed.contacts;
  shared.shared_variance = timed.shared_variance;
  shared.clock = timed.onset.time;
  shared.clock_noise = timed.onset.uncertainty;
  if (!by_rise) return shared;
  const Movement& movement = *timed.movement;
  shared.clock = movement.rise[0];
  shared.clock_noise = movement.rise_noise;
  shared.start = movement.start.time;
  shared.transport = {movement.rise[1] - movement.rise[0], movement.rise[2] - movement.rise[1],
                      movement.distance};
  return shared;
}

/** Where a trial's rise was not seen the onset is the clock of all, its uncertainty what bounds
it. */
std::vector<SharedTimingRun> ListRuns(const std::vector<Stratum>& strata) {
  bool by_rise = true;
  for (const Stratum& stratum : strata) {
    for (const TimedTrial& trial : stratum) by_rise &= HasRise(*trial.movement);
  }
  std::vector<SharedTimingRun> runs;
  for (const Stratum& stratum : strata) {
    SharedTimingRun& run = runs.emplace_back();
    for (const TimedTrial& trial : stratum) run.push_back(MakeShared(trial, by_rise));
  }
  return runs;
}

/** None when a digit, a clock or the start of closure is missing. */
std::optional<TimedTrial> MakeTimedTrial(const TrialAnalysis& analysis, size_t num_digits) {
  TimedTrial timed;
  timed.onset = analysis.movement.onset;
  timed.end = analysis.movement.end;
  timed.widest = analysis.closure_start;
  timed.movement = &analysis.movement;
  for (const DigitContactEvents& digit : analysis.contacts) {
    if (!digit.contact.IsFound()) return std::nullopt;
    timed.contacts.push_back(digit.contact.time);
    const double all = digit.contact.uncertainty, own = digit.own_uncertainty;
    const double shared = all * all - own * own;
    if (shared > 0.0) timed.shared_variance += shared / static_cast<double>(num_digits);
  }
  if (timed.contacts.size() != num_digits) return std::nullopt;
  if (!timed.onset.IsFound() || !timed.end.IsFound() || !timed.widest.IsFound()) {
    return std::nullopt;
  }
  const double last = *std::max_element(timed.contacts.begin(), timed.contacts.end());
  if (!(timed.end.time > timed.onset.time) || !(last > timed.widest.time)) return std::nullopt;
  return timed;
}

/** Natural logarithm of the number of different permutations. */
double CountPermutations(const std::vector<Stratum>& strata, size_t num_digits) {
  double log_count = 0.0;
  for (const Stratum& stratum : strata) {
    log_count += static_cast<double>(num_digits - 1) *
                 std::lgamma(static_cast<double>(stratum.size()) + 1.0);
  }
  return log_count;
}

bool IsMore(const IndependenceTest& test) {
  return test.p < kSignificant && test.observed < test.expected;
}
bool IsLess(const IndependenceTest& test) {
  return test.p < kSignificant && test.observed >= test.expected;
}

std::string FormatTest(const char* name, const IndependenceTest& test, double factor,
                       const std::string& unit) {
  return std::string(name) + " " + FormatFixed(factor * test.observed, 1) + unit +
         " on average, independent digits would have " + FormatFixed(factor * test.expected, 1) +
         unit + " (95 % range under permutation " + FormatFixed(factor * test.low, 1) + " to " +
         FormatFixed(factor * test.high, 1) + unit + ", p " +
         (test.p < 0.005 ? FormatFixed(test.p, 3) : FormatFixed(test.p, 2)) + ")";
}

std::string FormatClocks(const std::array<IndependenceTest, kNumClocks>& tests) {
  constexpr std::array<const char*, kNumClocks> kFrom = {
      "movement onset", "the widest opening", "onset adjusted for the movement duration"};
  std::string text;
  for (size_t i = 0; i < kNumClocks; ++i) {
    text += (i == 0 ? "counted from " : "; from ") + std::string(kFrom[i]) + ": " +
            (tests[i].p >= kSignificant              ? "no difference"
             : tests[i].observed < tests[i].expected ? "more simultaneous"
                                                     : "less simultaneous");
  }
  return text;
}

std::string FormatShared(const Answer<SharedTiming>& shared) {
  if (!shared) return shared.reason();
  return "the digits share " + FormatFixed(MsFromS(shared->shared_sd), 1) + " ms (SD; at least " +
         FormatFixed(MsFromS(shared->shared_low_sd), 1) +
         " with 95 %), an error of the clock may be " + FormatFixed(MsFromS(shared->clock_sd), 1) +
         " ms";
}

/** What follows each "not decided". */
constexpr const char* kNotSeparable =
    " If a whole movement is slower, all its digits touch later, which looks like coordination: "
    "the "
    "onset and the widest opening move with the digits. This design cannot separate the two. A "
    "design that can: a start signal from outside the hand with its time recorded, or trials in "
    "which one digit alone is delayed at random.";

std::string FormatVerdict(const IndependenceNull& null,
                          const std::array<IndependenceTest, kNumClocks>& tests) {
  constexpr const char* kThan = " than digits that move independently";
  switch (null.Judge(tests)) {
    case IndependenceVerdict::kMore:
      return std::string("more simultaneous") + kThan + " (" + FormatShared(null.shared) + ")";
    case IndependenceVerdict::kLess:
      return std::string("less simultaneous") + kThan;
    case IndependenceVerdict::kNoDifference:
      return "no difference from digits that move independently was found";
    case IndependenceVerdict::kNotDecided:
      break;
  }
  const bool all_more = std::all_of(tests.begin(), tests.end(), IsMore);
  return std::string("not decided whether more simultaneous") + kThan + " (" +
         (all_more ? FormatShared(null.shared) : FormatClocks(tests) + "; all three must agree") +
         ")";
}

}  // namespace

const std::array<const char*, kNumClocks>& ListClocks() {
  static const std::array<const char*, kNumClocks> clocks = {"onset", "widest", "movement"};
  return clocks;
}

size_t IndependenceNull::FindStrictest(const std::array<IndependenceTest, kNumClocks>& tests) {
  // For "smaller"; a larger observed mean speaks against it more than p = 1. Where all are larger
  // the question is whether they are.
  const bool all_larger = std::all_of(tests.begin(), tests.end(), [](const IndependenceTest& test) {
    return test.observed >= test.expected;
  });
  const auto evidence = [&](const IndependenceTest& test) {
    return all_larger || test.observed < test.expected ? 1.0 - test.p : test.p - 1.0;
  };
  const auto strictest = std::min_element(
      tests.begin(), tests.end(),
      [&](const auto& one, const auto& other) { return evidence(one) < evidence(other); });
  return static_cast<size_t>(strictest - tests.begin());
}

IndependenceVerdict IndependenceNull::Judge(
    const std::array<IndependenceTest, kNumClocks>& tests) const {
  if (std::all_of(tests.begin(), tests.end(), IsMore)) {
    return shared && shared->IsShown() ? IndependenceVerdict::kMore
                                       : IndependenceVerdict::kNotDecided;
  }
  if (std::all_of(tests.begin(), tests.end(), IsLess)) return IndependenceVerdict::kLess;
  const bool is_any = std::any_of(tests.begin(), tests.end(),
                                  [](const auto& test) { return test.p < kSignificant; });
  return is_any ? IndependenceVerdict::kNotDecided : IndependenceVerdict::kNoDifference;
}

Answer<IndependenceNull> CalcIndependenceNull(const std::vector<StudyTrial>& trials,
                                              size_t num_digits) {
  if (num_digits < 2) return NoAnswer{FormatCount(num_digits, "digit") + "; expected 2 or more"};
  IndependenceNull null;
  std::map<std::pair<std::string, std::vector<std::string>>, Stratum> cells;
  std::string id;
  for (const StudyTrial& trial : trials) {
    if (!trial.IsKept() || !trial.analysis) continue;
    const std::optional<TimedTrial> timed = MakeTimedTrial(*trial.analysis, num_digits);
    if (!timed) {
      ++null.num_incomplete;
      continue;
    }
    cells[{trial.participant, trial.levels}].push_back(*timed);
    id += trial.id + "\n";
  }
  std::vector<Stratum> strata;
  std::map<std::string, size_t> persons;
  for (auto& [key, stratum] : cells) {
    if (stratum.size() < kMinTrials) continue;
    const size_t person = persons.insert({key.first, persons.size()}).first->second;
    for (TimedTrial& trial : stratum) trial.person = person;
    null.num_trials += static_cast<int>(stratum.size());
    strata.push_back(std::move(stratum));
  }
  // Below 40 even the rarest permutation has a two-sided p above 0.05.
  if (CountPermutations(strata, num_digits) < std::log(40.0)) {
    return NoAnswer{"only " + FormatCount(null.num_trials, "trial") + " in which all " +
                    FormatCount(num_digits, "digit") + " touched and that have " +
                    std::to_string(kMinTrials - 1) +
                    " others of the same person and condition; too few to permute"};
  }
  null.num_persons = static_cast<int>(persons.size());
  for (size_t clock = 0; clock < kNumClocks; ++clock) CalcClock(strata, clock, id, null);
  null.shared = CalcSharedTiming(ListRuns(strata));
  return null;
}

std::string SayIndependence(const Answer<IndependenceNull>& null) {
  if (!null) return "Simultaneity of people: not testable, " + null.reason() + ".";
  const std::string text = "Simultaneity of people: " + FormatVerdict(*null, null->gft) + ".";
  return null->Judge(null->gft) == IndependenceVerdict::kNotDecided ? text + kNotSeparable : text;
}

std::string DescribeIndependence(const Answer<IndependenceNull>& null) {
  if (!null) return SayIndependence(null);
  const size_t of_gft = IndependenceNull::FindStrictest(null->gft);
  const size_t of_ratio = IndependenceNull::FindStrictest(null->gft_ratio);
  const IndependenceTest& gft = null->gft[of_gft];
  std::string text = SayIndependence(null) + " " + FormatTest("GFT is", gft, MsFromS(1.0), " ms") +
                     ". By GFT%: " + FormatVerdict(*null, null->gft_ratio) + "; " +
                     FormatTest("it is", null->gft_ratio[of_ratio], 100.0, " %") + ". ";
  if (gft.over_persons) {
    const JackknifeInterval& ratio = *gft.over_persons;
    text += "Over persons GFT is " + FormatFixed(std::exp(ratio.estimate), 2) +
            " times that of independent digits (95 % " +
            FormatFixed(std::exp(ratio.interval.low), 2) + " to " +
            FormatFixed(std::exp(ratio.interval.high), 2) + "). ";
  }
  return text + FormatCount(null->num_trials, "trial") + " of " +
         FormatCount(null->num_persons, "person") +
         "; the strictest of three clocks; a GFT smaller by " +
         FormatFixed(100.0 * gft.detectable, 0) + " % would be found in 8 of 10 such studies.";
}

}  // namespace graspbench
