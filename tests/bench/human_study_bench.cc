// Time to analyse five-digit trials, and how well each detector finds known contacts.
#include <benchmark/benchmark.h>

#include <cmath>

#include "core/base/units.h"
#include "human_study/synthetic/bias_card.h"

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

// 200 trials at 200 Hz with 0.3 mm noise on rigid objects; true GFT 30 ms.
void BenchAccuracy(benchmark::State& state) {
  const ContactDetector& detector = ContactDetectorList()[static_cast<size_t>(state.range(0))];
  SyntheticOptions synthetic;
  synthetic.seed = "bench accuracy";
  synthetic.num_people = 10;
  synthetic.trials_per_size = 5;
  synthetic.forming_time = 0.03;
  synthetic.has_force = true;
  const std::vector<SyntheticTrial> trials = MakeSyntheticStudy(synthetic);
  AnalysisOptions options;
  options.contact.detector = detector.id;
  BiasRow row;
  for (auto _ : state) row = CalcBiasRow(trials, options);
  state.SetLabel(detector.id);
  state.counters["bias_ms"] = MsFromS(row.contact_bias);
  state.counters["sd_ms"] = MsFromS(row.contact_sd);
  state.counters["gft_ms"] = MsFromS(row.mean_gft);
  state.counters["gft_sd_ms"] = MsFromS(row.sd_gft);
  state.counters["coverage"] = row.coverage;
  state.counters["missing"] = row.num_missing;
}
BENCHMARK(BenchAccuracy)->DenseRange(0, 4)->Iterations(1)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace graspbench
