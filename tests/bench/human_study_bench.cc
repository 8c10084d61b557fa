// Time to analyse five-digit trials with all detectors; checks the contact times it finds.
#include <benchmark/benchmark.h>

#include <cmath>

#include "human_study/measures/trial_analysis.h"
#include "human_study/synthetic/synthetic_study.h"

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

}  // namespace
}  // namespace graspbench
