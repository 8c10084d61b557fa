#pragma once
/** @file
The main function of a Google Benchmark program that also writes what it measured as validation
rows:   quality_bench --validation workbench/manual/validation/physics.yaml
In the place of BENCHMARK_MAIN, with libbenchmark instead of libbenchmark_main. */

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "tests/validation/validation_rows.h"

namespace graspbench {

/** What ran, by the benchmark's name without its aggregates and options: "BM_EpsilonFast/10". */
struct BenchmarkRuns {
  struct Runs {
    std::vector<double> cpu_times;  ///< one for each repetition, in the benchmark's unit
    std::map<std::string, std::vector<double>> counters;
  };
  std::map<std::string, Runs> by_name;
};

/** Sets figure and interval from several values: median and, of more than one, their range.
@param unit  with a space before it, or empty. */
void SetFigure(ValidationRow& row, const std::vector<double>& values, const std::string& unit);

/** @param make_rows  asked once, with --validation only, after all benchmarks have run; rows of
benchmarks that a filter left out are not made. A benchmark that found its answer wrong makes the
exit code 1, and no row is written. */
int RunBenchmarks(int argc, char** argv,
                  const std::function<std::vector<ValidationRow>(const BenchmarkRuns&)>& make_rows);

}  // namespace graspbench
