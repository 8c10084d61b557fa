// Epsilon of random grasps (eight edges): the expanding polytope against the whole hull by Qhull,
// the largest force along a direction, the smallest grip of four digits and the least of six pulls,
// with the exact cones. Argument: contacts. Target: ten contacts in at most 3
// ms.
//   build/release/tests/bench/quality_bench --validation workbench/manual/validation/physics.yaml

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <string>
#include <vector>

#include "core/quality/epsilon_fast.h"
#include "core/quality/grasp_quality.h"
#include "core/quality/holding_force.h"
#include "core/quality/wrench_hull.h"
#include "core/statistics/summary.h"
#include "tests/bench/validation_main.h"
#include "tests/core/quality/grasp_samples.h"

namespace graspbench {
namespace {

constexpr int kNumGrasps = 32;

std::vector<ConeWrenches> MakeGrasps(int num_contacts) {
  RandomStream stream("quality bench", std::to_string(num_contacts));
  std::vector<ConeWrenches> grasps;
  for (int i = 0; i < kNumGrasps; ++i) {
    grasps.push_back(CalcConeWrenches(MakeRandomGrasp(stream, num_contacts), {}));
  }
  return grasps;
}

void BM_EpsilonFast(benchmark::State& state) {
  const std::vector<ConeWrenches> grasps = MakeGrasps(state.range(0));
  double worst = 0.0;
  for (const ConeWrenches& grasp : grasps) {
    const double epsilon = CalcEpsilon(CalcWrenchHull(grasp.wrenches));
    worst = std::max(worst, std::abs(CalcEpsilonBounds(grasp.wrenches).upper - epsilon));
  }
  if (worst > 1e-9) state.SkipWithError("the fast epsilon is not the hull's");
  size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(CalcEpsilonBounds(grasps[i++ % kNumGrasps].wrenches).upper);
  }
  state.counters["worst_difference"] = worst;
}

// Also counts how many times the hull takes as long as the fast method on the same grasps.
void BM_EpsilonHull(benchmark::State& state) {
  const std::vector<ConeWrenches> grasps = MakeGrasps(state.range(0));
  const std::clock_t start = std::clock();
  size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(CalcEpsilon(CalcWrenchHull(grasps[i++ % kNumGrasps].wrenches)));
  }
  const std::clock_t middle = std::clock();
  for (size_t k = 0; k < i; ++k) {
    benchmark::DoNotOptimize(CalcEpsilonBounds(grasps[k % kNumGrasps].wrenches).upper);
  }
  state.counters["times_fast"] =
      static_cast<double>(middle - start) / std::max<std::clock_t>(std::clock() - middle, 1);
}

void BM_TaskForce(benchmark::State& state) {
  const std::vector<ConeWrenches> grasps = MakeGrasps(state.range(0));
  const Eigen::Matrix<double, 6, 1> direction = Eigen::Matrix<double, 6, 1>::Unit(2);
  for (const ConeWrenches& grasp : grasps) {
    const double epsilon = CalcEpsilonBounds(grasp.wrenches).lower;
    if (CalcTaskForce(grasp, direction, ForceLimit::kSum) < epsilon - 1e-9) {
      state.SkipWithError("a direction is weaker than epsilon");
    }
  }
  size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(CalcTaskForce(grasps[i++ % kNumGrasps], direction, ForceLimit::kEach));
  }
}

/** Digits in turn, digit 0 free; 1 N at each contact, a weight of 1 N. */
std::vector<LoadedGrasp> MakeLoadedGrasps(int num_contacts) {
  RandomStream stream("quality bench loaded", std::to_string(num_contacts));
  std::vector<LoadedGrasp> grasps(kNumGrasps);
  for (LoadedGrasp& grasp : grasps) {
    grasp.contacts = MakeRandomGrasp(stream, num_contacts);
    grasp.normal_forces.assign(grasp.contacts.size(), 1.0);
    for (int i = 0; i < num_contacts; ++i) grasp.digits.push_back(i % 4);
    grasp.weight = MakeRandomDirection(stream);
    grasp.radius = 1.0;
  }
  return grasps;
}

void BM_SmallestGrip(benchmark::State& state) {
  const std::vector<LoadedGrasp> grasps = MakeLoadedGrasps(state.range(0));
  std::vector<bool> is_free;
  for (const int digit : grasps.front().digits) is_free.push_back(digit == 0);
  size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(CalcSmallestGrip(grasps[i++ % kNumGrasps], is_free));
  }
}

void BM_WeakestOfSixPulls(benchmark::State& state) {
  const std::vector<LoadedGrasp> grasps = MakeLoadedGrasps(state.range(0));
  std::vector<Eigen::Vector3d> directions;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {1.0, -1.0})
      directions.emplace_back(sign * Eigen::Vector3d::Unit(axis));
  }
  size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(CalcWeakestHoldingForce(grasps[i++ % kNumGrasps], directions));
  }
}

BENCHMARK(BM_EpsilonFast)->Arg(3)->Arg(5)->Arg(10)->Arg(20)->Unit(benchmark::kMillisecond);
BENCHMARK(BM_EpsilonHull)->Arg(3)->Arg(5)->Arg(10)->Arg(20)->Unit(benchmark::kMillisecond);
BENCHMARK(BM_TaskForce)->Arg(3)->Arg(5)->Arg(10)->Arg(20)->Unit(benchmark::kMillisecond);
BENCHMARK(BM_SmallestGrip)->Arg(4)->Arg(8)->Arg(16)->Arg(32)->Unit(benchmark::kMicrosecond);
BENCHMARK(BM_WeakestOfSixPulls)->Arg(4)->Arg(8)->Arg(16)->Arg(32)->Unit(benchmark::kMicrosecond);

std::vector<ValidationRow> MakeRows(const BenchmarkRuns& all) {
  const auto runs = all.by_name.find("BM_EpsilonFast/10");
  if (runs == all.by_name.end()) return {};
  ValidationRow time = MakeValidationRow("Physics", false);
  time.command = "build/release/tests/bench/quality_bench --benchmark_filter=EpsilonFast/10";
  ValidationRow difference = time;
  time.claim = "epsilon of 10 contacts with 8 edges, time";
  SetFigure(time, runs->second.cpu_times, " ms");
  time.bar = "3 ms";
  time.met = CalcMedian(runs->second.cpu_times) <= 3.0 ? "yes" : "no";
  difference.claim = "epsilon of 10 contacts with 8 edges, largest difference from the 6-D hull";
  const std::vector<double>& differences = runs->second.counters.at("worst_difference");
  SetFigure(difference, differences, "");
  difference.bar = "1e-9";
  difference.met = CalcMedian(differences) <= 1e-9 ? "yes" : "no";
  return {time, difference};
}

}  // namespace
}  // namespace graspbench

int main(int argc, char** argv) {
  return graspbench::RunBenchmarks(argc, argv, graspbench::MakeRows);
}
