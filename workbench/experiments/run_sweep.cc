#include "workbench/experiments/run_sweep.h"

#include <chrono>
#include <map>
#include <string>

#include "datasets/analysis/conditions/threshold_summary.h"
#include "workbench/experiments/pool/trial_bench.h"

namespace graspbench {
namespace {

constexpr double kJudgeTrials = 5.0;  // what the judge takes, in trials

}  // namespace

bool RunSweep(const PreparedSession& sweep, const ThresholdScale* scale, ExperimentRequest request,
              int num_workers, Observer& observer, const std::atomic<bool>& stop) {
  if (!RunExperiment(sweep, request, num_workers, observer, stop)) return false;
  if (!scale) return true;
  request.folder = sweep.folder;
  request.with_judge = false;
  return RunExperiment(PrepareThresholds(request, *scale), request, num_workers, observer, stop);
}

double EstimateSweepTime(const PreparedSession& sweep, bool with_judge, bool with_thresholds) {
  std::map<std::string, double> times;
  TrialBench bench;
  double sum = 0.0;
  for (const PlannedTrial& planned : FindUnfinished(sweep.session)) {
    if (times.count(planned.hand) == 0) {
      TrialSetup setup = MakeTrialSetup(sweep.config, sweep.inputs, planned);
      TrialRunner& runner = bench.Prepare(setup);
      const auto start = std::chrono::steady_clock::now();
      runner.Run(setup);
      times[planned.hand] =
          std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }
    sum += times[planned.hand];
  }
  return sum *
         (1.0 + (with_judge ? kJudgeTrials : 0.0) + (with_thresholds ? kMostThresholdTrials : 0.0));
}

}  // namespace graspbench
