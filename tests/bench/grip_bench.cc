/** @file
How well hands regulate their grip: the benchmark's cells under one setting of the grip.

    grip_bench [--threads N] [--list] [--thresholds] [KEY=VALUE ...]       as graspbench run --set

prints the shares of held trials whose sum, and whose digits by their number, are within a band of
what was asked, and whose peak is below its bar. The band is 20 %, twice that by sensed touch; there
the same of what the hand feels, too: a digit that presses beside its elements is regulated by none.
With --thresholds it bisects each draw instead, over margins, or over forces where strategy.grip is
force, and prints the median of each hand and object, with those that are not monotone. */

#include <fmt/core.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <map>
#include <string>
#include <thread>
#include <vector>

#include "core/base/error.h"
#include "core/trial/trial_runner.h"
#include "datasets/analysis/conditions/threshold_summary.h"
#include "datasets/plan/session_inputs.h"
#include "datasets/plan/session_plan.h"

namespace graspbench {
namespace {

constexpr double kExcess = 1.5;  // of the true sum over that asked

struct Share {
  int num = 0, of = 0;
  void Add(bool is_in) {
    num += is_in ? 1 : 0;
    ++of;
  }
  std::string Format() const {
    return fmt::format("{} of {} ({:.1f} %)", num, of, of > 0 ? 100.0 * num / of : 0.0);
  }
};

bool IsWithin(double reached, double asked, double band) {
  return std::abs(reached - asked) <= band * asked;
}

void PrintTrial(const PlannedTrial& planned, const TrialResult& result) {
  std::string text = DescribeTrial(planned) + ": " + NameOf(result.outcome);
  if (result.grip) {
    const GripRecord& grip = *result.grip;
    text += fmt::format(
        ", asked {:.2f} closed {:.2f} held {:.2f} true {:.2f} peak {:.2f} smallest {:.2f}{}",
        grip.asked, grip.closed, grip.held, result.stability.hold.normal_force, grip.peak,
        grip.smallest, grip.was_in_band ? "" : ", not in band");
    for (const DigitGripRecord& digit : grip.digits) {
      text += fmt::format("; {} {:.2f}/{:.2f} s {:.2f} {}", digit.digit, digit.held, digit.asked,
                          digit.closing, NameOf(digit.fault));
    }
  }
  fmt::print("{}\n", text);
}

/** Shares of held trials, and of digits, that keep their bars. */
struct GripShares {
  Share sum, peak, in_band;
  std::map<size_t, Share> digits;

  void AddTrial(const GripRecord& grip, double band) {
    sum.Add(IsWithin(grip.held, grip.asked, band));
    peak.Add(grip.peak <= 1.2 * grip.asked + 0.2);
    in_band.Add(grip.was_in_band);
  }
  void AddDigit(const GripRecord& grip, const DigitGripRecord& digit, double band) {
    digits[grip.digits.size()].Add(IsWithin(digit.held, digit.asked, band));
  }
  void Print(const std::string& which) const {
    fmt::print("{}: sum {}, peak {}, settled in band {}\n", which, sum.Format(), peak.Format(),
               in_band.Format());
    for (const auto& [number, share] : digits) {
      fmt::print("digits of {}: {}\n", number, share.Format());
    }
  }
};

bool IsFelt(const DigitGripRecord& digit) { return digit.fault != GripFault::kNotFelt; }

void PrintShares(const std::vector<TrialResult>& results, double band) {
  Share success, excess;
  GripShares all, felt;
  std::map<std::string, int> faults;
  for (const TrialResult& result : results) {
    success.Add(IsSuccess(result.outcome));
    if (!result.grip || !IsSuccess(result.outcome)) continue;
    const GripRecord& grip = *result.grip;
    all.AddTrial(grip, band);
    excess.Add(result.stability.hold.normal_force > kExcess * grip.asked);
    if (std::all_of(grip.digits.begin(), grip.digits.end(), IsFelt)) felt.AddTrial(grip, band);
    for (const DigitGripRecord& digit : grip.digits) {
      all.AddDigit(grip, digit, band);
      if (IsFelt(digit)) felt.AddDigit(grip, digit, band);
      if (digit.fault != GripFault::kNone) ++faults[NameOf(digit.fault)];
    }
  }
  fmt::print("success {}\n", success.Format());
  all.Print("held trials");
  fmt::print("true sum above {} times what was asked: {}\n", kExcess, excess.Format());
  if (felt.sum.of < all.sum.of) felt.Print("those whose digits all feel what they press");
  for (const auto& [fault, number] : faults) fmt::print("{}: {}\n", fault, number);
}

const ThresholdScale& FindScale(const SessionConfig& config) {
  const bool is_force = config.strategy.grip == RowOf(kGripModes, GripMode::kForce).name;
  return kThresholdScales[is_force ? 1 : 0];
}

GripThreshold FindThreshold(const ThresholdScale& scale, TrialRunner& runner, TrialSetup setup) {
  return FindGripThreshold([&](int place) {
    const double grip = CalcGripAt(scale, place);
    (scale.mode == GripMode::kForce ? setup.strategy.grip_force : setup.strategy.grip_margin) =
        grip;
    return IsSuccess(runner.Run(setup).outcome);
  });
}

void PrintThresholds(const ThresholdScale& scale, const std::vector<PlannedTrial>& plan,
                     const std::vector<GripThreshold>& thresholds, size_t cell) {
  size_t num_trials = 0, num_not_monotone = 0;
  for (size_t first = 0; first < plan.size(); first += cell) {
    std::vector<double> values;
    int num_never = 0, num_below = 0;
    std::string not_monotone;
    for (size_t i = first; i < std::min(plan.size(), first + cell); ++i) {
      const GripThreshold& found = thresholds[i];
      num_trials += found.failed.size() + found.succeeded.size();
      // One that never succeeds is above all others in the order.
      values.push_back(found.place ? CalcGripAt(scale, *found.place) : HUGE_VAL);
      num_never += found.place ? 0 : 1;
      num_below += found.is_below_range ? 1 : 0;
      if (found.is_monotone) continue;
      ++num_not_monotone;
      not_monotone += fmt::format(" {}", plan[i].trial);
    }
    std::sort(values.begin(), values.end());
    const size_t n = values.size();
    fmt::print("{} {} {}: median {:.2f}, from {:.2f} to {:.2f}, never {}, at the least {}{}\n",
               plan[first].hand, plan[first].object, plan[first].grasp,
               0.5 * (values[(n - 1) / 2] + values[n / 2]), values.front(), values.back(),
               num_never, num_below, not_monotone.empty() ? "" : ", not monotone:" + not_monotone);
  }
  fmt::print("{} draws, {} trials, not monotone {}\n", plan.size(), num_trials, num_not_monotone);
}

int Run(int argc, char** argv) {
  SessionConfig config;
  size_t num_threads = 2;
  bool lists = false, finds_thresholds = false;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument == "--threads" && i + 1 < argc) {
      num_threads = static_cast<size_t>(std::max(1, std::atoi(argv[++i])));
    } else if (argument == "--list") {
      lists = true;
    } else if (argument == "--thresholds") {
      finds_thresholds = true;
    } else {
      ApplySetting(argument, config);
    }
  }
  const SessionInputs inputs = LoadSessionInputs(config);
  const std::vector<PlannedTrial> plan = MakePlan(config, inputs);
  std::vector<TrialResult> results(plan.size());
  std::vector<GripThreshold> thresholds(plan.size());
  std::atomic<size_t> next_cell{0};
  const size_t cell = static_cast<size_t>(config.trials);  // trials of one hand and object in a row
  const auto work = [&] {
    for (size_t first; (first = cell * next_cell++) < plan.size();) {
      const TrialSetup setup = MakeTrialSetup(config, inputs, plan[first]);
      TrialRunner runner(setup.hand, setup.object);
      for (size_t i = first; i < std::min(plan.size(), first + cell); ++i) {
        const TrialSetup drawn = MakeTrialSetup(config, inputs, plan[i]);
        if (finds_thresholds) {
          thresholds[i] = FindThreshold(FindScale(config), runner, drawn);
        } else {
          results[i] = runner.Run(drawn);
        }
      }
    }
  };
  std::vector<std::thread> threads;
  for (size_t i = 0; i < num_threads; ++i) threads.emplace_back(work);
  for (std::thread& thread : threads) thread.join();
  if (finds_thresholds) {
    PrintThresholds(FindScale(config), plan, thresholds, cell);
    return 0;
  }
  for (size_t i = 0; lists && i < plan.size(); ++i) PrintTrial(plan[i], results[i]);
  PrintShares(results, config.touch == SessionConfig().touch ? 0.2 : 0.4);
  return 0;
}

}  // namespace
}  // namespace graspbench

int main(int argc, char** argv) {
  try {
    return graspbench::Run(argc, argv);
  } catch (const graspbench::Error& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
}
