#include "tests/bench/validation_main.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdio>

#include "core/base/error.h"
#include "core/base/text/text.h"
#include "core/statistics/summary.h"

namespace graspbench {
namespace {

/** Prints as always, and keeps what it is told. */
class KeepingReporter : public benchmark::ConsoleReporter {
 public:
  void ReportRuns(const std::vector<Run>& reports) override {
    benchmark::ConsoleReporter::ReportRuns(reports);
    for (const Run& run : reports) {
      if (run.error_occurred) has_error = true;
      if (run.error_occurred || run.run_type != Run::RT_Iteration) continue;
      BenchmarkRuns::Runs& kept =
          runs.by_name[run.run_name.function_name + (run.run_name.args.empty() ? "" : "/") +
                       run.run_name.args];
      kept.cpu_times.push_back(run.GetAdjustedCPUTime());
      for (const auto& [name, counter] : run.counters) kept.counters[name].push_back(counter.value);
    }
  }

  BenchmarkRuns runs;
  bool has_error = false;
};

}  // namespace

void SetFigure(ValidationRow& row, const std::vector<double>& values, const std::string& unit) {
  row.figure = FormatSignificant(CalcMedian(values), 3) + unit;
  if (values.size() < 2) return;
  row.figure += ", median of " + std::to_string(values.size());
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  row.interval = FormatSignificant(*least, 3) + " to " + FormatSignificant(*most, 3) + unit;
}

int RunBenchmarks(
    int argc, char** argv,
    const std::function<std::vector<ValidationRow>(const BenchmarkRuns&)>& make_rows) {
  std::string file;
  std::vector<char*> arguments;
  for (int i = 0; i < argc; ++i) {
    if (std::string(argv[i]) != "--validation") {
      arguments.push_back(argv[i]);
    } else if (++i < argc) {
      file = argv[i];
    } else {
      std::fprintf(stderr,
                   "--validation needs a FILE of rows, e.g. of workbench/manual/validation\n");
      return kExitUsage;
    }
  }
  int count = static_cast<int>(arguments.size());
  benchmark::Initialize(&count, arguments.data());
  if (benchmark::ReportUnrecognizedArguments(count, arguments.data())) return kExitUsage;
  KeepingReporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  benchmark::Shutdown();
  if (reporter.has_error) return kExitFailed;
  if (file.empty()) return kExitOk;
  try {
    const std::vector<ValidationRow> rows = make_rows(reporter.runs);
    if (rows.empty()) {
      std::fprintf(stderr, "no row for %s: no benchmark that makes one has run\n", file.c_str());
      return kExitFailed;
    }
    UpdateValidationFile(file, rows);
  } catch (const Error& error) {
    std::fprintf(stderr, "--validation %s: %s\n", file.c_str(), error.what());
    return ExitCodeOf(error.kind());
  }
  return kExitOk;
}

}  // namespace graspbench
