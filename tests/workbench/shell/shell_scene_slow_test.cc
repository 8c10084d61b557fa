/** @file
Every trial of the benchmark in the shell's scene: the bytes of the session's, and what it costs. */

#include <gtest/gtest.h>

#include <algorithm>
#include <ctime>
#include <iostream>
#include <map>

#include "core/base/random.h"
#include "core/statistics/summary.h"
#include "datasets/plan/session_plan.h"
#include "workbench/shell/shell_scene.h"

namespace graspbench {
namespace {

/** Of this process [s]. */
double ReadProcessorTime() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

TEST(ShellSceneSlow, AllTrialsOfTheBenchmarkAreThoseOfASession) {
  const SessionConfig config;
  const SessionInputs inputs = LoadSessionInputs(config);
  const std::vector<PlannedTrial> plan = MakePlan(config, inputs);
  std::map<std::string, std::unique_ptr<TrialRunner>> runners;
  std::vector<double> ratios, jumps;
  RandomStream random("shell", "jumps");
  for (const PlannedTrial& planned : plan) {
    const TrialSetup setup = MakeTrialSetup(config, inputs, planned);
    auto& runner = runners[planned.hand + planned.object];
    if (!runner) {
      runner = std::make_unique<TrialRunner>(setup.hand, setup.object);
      runner->Prepare(setup.sim);
    }
    SceneChoice choice;
    choice.config.hands = {planned.hand};
    choice.config.objects = {planned.object};
    choice.config.grasps = {planned.grasp};
    choice.draw = planned.trial;
    ShellScene scene;
    scene.Choose(choice);

    const double start = ReadProcessorTime();
    const TrialResult result = runner->Run(setup);
    const double middle = ReadProcessorTime();
    while (scene.Advance()) {
    }
    ratios.push_back((ReadProcessorTime() - middle) / (middle - start));
    EXPECT_EQ(ToJson(scene.course().End()), ToJson(result)) << DescribeTrial(planned);

    const double jump_start = ReadProcessorTime();
    scene.GoTo(random.NextUniform(0.0, scene.time()), [] { return false; });
    jumps.push_back(1e3 * (ReadProcessorTime() - jump_start));
  }
  std::sort(jumps.begin(), jumps.end());
  std::cout << plan.size() << " trials; stepped over batch: median " << CalcMedian(ratios)
            << " of the pairs; a jump: median " << CalcMedian(jumps) << " ms, 95 % "
            << CalcSortedQuantile(jumps, 0.95) << " ms, longest " << jumps.back() << " ms\n";
}

}  // namespace
}  // namespace graspbench
