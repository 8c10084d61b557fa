// Time to analyse five-digit trials, and how well each detector finds known contacts.
#include <benchmark/benchmark.h>

#include <cmath>

#include "core/base/units.h"
#include "core/statistics/summary.h"
#include "human_study/study/synthetic/bias_card.h"

namespace graspbench {
namespace {

void BenchAnalyseTrial(benchmark::State& state) {
  SyntheticOptions synthetic;
  synthetic.seed = "bench";
  synthetic.has_force = true;
  std::vector<ReachTrial> reaches;
  const std::vector<SyntheticTrial> trials = MakeSyntheticStudy(synthetic);
  for (const SyntheticTrial& trial : trials) reaches.push_back(MakeReachTrial(trial));
  const AnalysisOptions options;
  double error = 0.0;
  size_t i = 0;
  for (auto _ : state) {
    const TrialAnalysis analysis = AnalyseTrial(reaches[i], options);
    error =
        std::max(error, std::abs(analysis.contacts[0].contact.time - trials[i].truth.contacts[0]));
    i = (i + 1) % reaches.size();
  }
  if (!(error < 0.03)) state.SkipWithError("a thumb's contact is off by more than 30 ms");
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(BenchAnalyseTrial)->Unit(benchmark::kMillisecond);

void BenchMakeReachTrial(benchmark::State& state) {
  SyntheticOptions synthetic;
  synthetic.seed = "bench";
  synthetic.num_people = 1;
  synthetic.trials_per_size = 1;
  const std::vector<SyntheticTrial> trials = MakeSyntheticStudy(synthetic);
  for (auto _ : state) benchmark::DoNotOptimize(MakeReachTrial(trials[0]));
}
BENCHMARK(BenchMakeReachTrial)->Unit(benchmark::kMillisecond);

void SetCounters(const BiasRow& row, benchmark::State& state) {
  state.counters["bias_ms"] = MsFromS(row.contact_bias);
  state.counters["sd_ms"] = MsFromS(row.contact_sd);
  state.counters["gft_ms"] = MsFromS(row.mean_gft);
  state.counters["gft_sd_ms"] = MsFromS(row.sd_gft);
  state.counters["coverage"] = row.coverage;
  state.counters["missing"] = row.num_missing;
}

/** 200 trials at 200 Hz with 0.3 mm noise on rigid objects. */
SyntheticOptions MakeOptions(const char* seed) {
  SyntheticOptions synthetic;
  synthetic.seed = seed;
  synthetic.num_people = 10;
  synthetic.trials_per_size = 5;
  return synthetic;
}

// True GFT 30 ms.
void BenchAccuracy(benchmark::State& state) {
  const ContactDetector& detector = ContactDetectorList()[static_cast<size_t>(state.range(0))];
  SyntheticOptions synthetic = MakeOptions("bench accuracy");
  synthetic.forming_time = 0.03;
  synthetic.has_force = true;
  const std::vector<SyntheticTrial> trials = MakeSyntheticStudy(synthetic);
  AnalysisOptions options;
  options.contact.detector = detector.id;
  BiasRow row;
  for (auto _ : state) row = CalcBiasRow(trials, options);
  state.SetLabel(detector.id);
  SetCounters(row, state);
}
BENCHMARK(BenchAccuracy)->DenseRange(0, 4)->Iterations(1)->Unit(benchmark::kMillisecond);

// The same without a lift: the hold is found from the hand, the way back is in the recording.
void BenchAccuracyWithoutLift(benchmark::State& state) {
  const bool rests = state.range(0) == 1, has_object = state.range(1) == 1;
  SyntheticOptions synthetic = MakeOptions("bench without lift");
  synthetic.forming_time = 0.03;
  synthetic.lifts = false;
  synthetic.rests = rests;
  const std::vector<SyntheticTrial> trials = MakeSyntheticStudy(synthetic);
  BiasRow row;
  for (auto _ : state) row = CalcBiasRow(trials, AnalysisOptions(), has_object);
  state.SetLabel(std::string(rests ? "rest before, " : "no rest before, ") +
                 (has_object ? "object recorded" : "object not recorded"));
  SetCounters(row, state);
}
BENCHMARK(BenchAccuracyWithoutLift)
    ->ArgsProduct({{0, 1}, {0, 1}})
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);

// Onset of the wrist's movement where the hand comes from the reach before without resting.
void BenchOnsetWithoutRest(benchmark::State& state) {
  const MovementRule& rule = MovementRuleList()[static_cast<size_t>(state.range(0))];
  SyntheticOptions synthetic = MakeOptions("bench onset");
  synthetic.lifts = false;
  synthetic.rests = false;
  const std::vector<SyntheticTrial> trials = MakeSyntheticStudy(synthetic);
  AnalysisOptions options;
  options.movement.rule = rule.id;
  std::vector<double> errors;
  for (auto _ : state) {
    for (const SyntheticTrial& trial : trials) {
      const EventTime onset = AnalyseTrial(MakeReachTrial(trial), options).movement.onset;
      if (onset.IsFound()) errors.push_back(MsFromS(onset.time - trial.truth.onset));
    }
  }
  const Moments moments = CalcMoments(errors);
  state.SetLabel(rule.id);
  state.counters["bias_ms"] = moments.mean;
  state.counters["sd_ms"] =
      std::sqrt(moments.sum_of_squares / static_cast<double>(errors.size() - 1));
  state.counters["missing"] = static_cast<double>(trials.size() - errors.size());
}
BENCHMARK(BenchOnsetWithoutRest)->DenseRange(0, 5)->Iterations(1)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace graspbench
