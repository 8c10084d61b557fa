// Time of `graspbench study run` on 1,000 five-digit trials: the whole command with its multiverse,
// tables, BIDS derivative and report. The recordings stay in the temporary folder that the label
// names, for runs by hand: /usr/bin/time -v graspbench study run FOLDER/input/study.yaml --out OUT
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include "core/base/files/files.h"
#include "core/base/text/delimited_text.h"
#include "core/statistics/summary.h"
#include "human_study/study/synthetic/demo_study.h"
#include "workbench/program.h"

namespace graspbench {
namespace {

namespace fs = std::filesystem;

/** True GFT of every trial, by the id it has in measures.csv [s]. */
std::map<std::string, double> ListTrueGfts(const std::vector<SyntheticTrial>& trials) {
  std::map<std::string, double> gfts;
  for (const SyntheticTrial& trial : trials) {
    const auto [first, last] =
        std::minmax_element(trial.truth.contacts.begin(), trial.truth.contacts.end());
    gfts[trial.person + "-" + std::to_string(trial.trial)] = *last - *first;
  }
  return gfts;
}

/** What measures.csv says. */
struct Found {
  size_t num_kept = 0;
  std::vector<double> errors;  ///< of GFT [s]; none where a contact is not resolved
};

Found CompareGfts(const fs::path& out, const std::vector<SyntheticTrial>& trials) {
  const std::map<std::string, double> truth = ListTrueGfts(trials);
  Diagnostics problems;
  DataTable table(ReadFile(out / "measures.csv"), "measures.csv", problems);
  Found found;
  found.num_kept = table.num_rows();
  for (size_t row = 0; row < table.num_rows(); ++row) {
    const double gft = table.Number(row, "grasp_forming_time_s");
    if (std::isfinite(gft)) found.errors.push_back(gft - truth.at(table.Text(row, "trial_id")));
  }
  return found;
}

void BenchStudyRun(benchmark::State& state) {
  SyntheticOptions options = MakeDemoOptions();
  options.seed = "study bench";
  options.num_people = 10;
  options.trials_per_size = static_cast<int>(state.range(0)) / 40;
  const fs::path folder = fs::temp_directory_path() / "graspbench_study_bench";
  const fs::path out = folder / "out";
  fs::remove_all(folder);
  const std::vector<SyntheticTrial> trials = MakeSyntheticStudy(options);
  WriteDemoStudy(trials, folder / "input");
  const std::string study = (folder / "input" / "study.yaml").string();
  const std::string out_text = out.string();
  const char* const arguments[] = {"graspbench",  "study", "run",
                                   study.c_str(), "--out", out_text.c_str()};
  int exit_code = 0;
  for (auto _ : state) exit_code = RunProgram(std::size(arguments), arguments);
  if (exit_code != 0) {
    state.SkipWithError("the command failed");
    return;
  }
  const Found found = CompareGfts(out, trials);
  const double bias = CalcMoments(found.errors).mean;
  if (found.num_kept < 0.99 * static_cast<double>(trials.size()) || !(std::abs(bias) < 0.005)) {
    state.SkipWithError("more than 1 % of the trials were removed or GFT is off by 5 ms");
  }
  state.counters["gft_bias_ms"] = 1e3 * bias;
  state.counters["gfts"] = static_cast<double>(found.errors.size());
  state.SetItemsProcessed(state.range(0));
  state.SetLabel(folder.string());
}
BENCHMARK(BenchStudyRun)->Arg(1000)->Iterations(1)->Unit(benchmark::kSecond);

}  // namespace
}  // namespace graspbench
