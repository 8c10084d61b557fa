#include <CLI/CLI.hpp>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>

#include "human_study/statistics/tidy_export.h"
#include "human_study/study/demo_study.h"
#include "human_study/study/motion_bids.h"
#include "human_study/study/run_study.h"
#include "human_study/study/study_tables.h"
#include "human_study/study/trial_removal.h"
#include "reports/format.h"
#include "reports/study/study_report.h"
#include "workbench/commands/command.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

struct StudyOptions {
  std::string study_file;
  std::string data;  ///< folder of the recordings; empty: that of study.yaml
  std::string out;
  std::string robot;  ///< folder of a session; empty: what study.yaml says
};

std::optional<RobotSession> LoadRobot(const StudyOptions& options, const Study& study) {
  fs::path folder = options.robot;
  if (folder.empty() && !study.config.robot.empty()) folder = study.folder / study.config.robot;
  if (folder.empty()) return std::nullopt;
  return RobotSession{folder.lexically_normal().filename().string(), LoadSession(folder)};
}

/** A line for every tenth of the trials, once there are enough for it to matter. */
void ShowProgress(size_t num_done, size_t num_planned) {
  const size_t step = num_planned / 10;
  if (num_planned < 100 || num_done % step != 0) return;
  std::cerr << num_done << " of " << num_planned << " trials\n";
}

std::vector<MeasureTable> ListTables(const StudyResult& result) {
  std::vector<MeasureTable> tables;
  for (const TrialMeasure& measure : TrialMeasureList()) {
    tables.push_back(MakeMeasureTable(result, measure));
  }
  return tables;
}

/** First of all what is not there. */
void PrintRemoved(const StudyResult& result) {
  if (result.CountKept() == 0) std::cout << "no trial counts:\n";
  for (const RemovalGroup& group : GroupRemoved(result.trials)) {
    std::cout << "removed  " << group.trials.size() << " [" << group.code << "] " << group.text
              << '\n';
  }
}

StudyResult RunAndWrite(const StudyOptions& options) {
  const Study study = LoadStudy(options.study_file, options.data);
  if (!study.warnings.entries().empty()) std::cerr << study.warnings.Format() << '\n';
  const std::optional<RobotSession> robot = LoadRobot(options, study);
  const fs::path out = options.out;
  MotionBidsWriter bids(out / "bids", study);
  StudyWatch watch;
  watch.on_row = ShowProgress;
  watch.on_trial = [&](const StudyTrial& trial, const ReachTrial& reach) {
    bids.WriteTrial(trial, reach);
  };
  StudyResult result = RunStudy(study, watch);
  PrintRemoved(result);
  bids.Finish();
  WriteStudyTables(result, out);
  SaveTidyExport(ListTables(result), out / "tidy");
  const fs::path report = WriteStudyReport(out, result, robot ? &*robot : nullptr);
  std::cout << "kept     " << result.CountKept() << " of "
            << FormatCount(static_cast<int>(result.trials.size()), "trial") << "\ntables   "
            << (out / "measures.csv").string() << "\nR        " << (out / "tidy").string()
            << "\nBIDS     " << (out / "bids").string() << "\nreport   " << report.string() << '\n';
  return result;
}

void PrintError(const char* name, const Answer<Summary>& errors) {
  std::cout << "  " << name;
  if (!errors) {
    std::cout << errors.reason() << '\n';
    return;
  }
  std::cout << "bias " << FormatFixed(1e3 * errors->mean, 1) << " ms, SD "
            << FormatFixed(1e3 * errors->standard_deviation.value_or(std::nan("")), 1) << " ms, n "
            << errors->count << '\n';
}

void RunDemo(StudyOptions options) {
  const fs::path input = fs::path(options.out) / "input";
  const std::vector<SyntheticTrial> trials = MakeSyntheticStudy(MakeDemoOptions());
  WriteDemoStudy(trials, input);
  options.study_file = (input / "study.yaml").string();
  const TruthComparison comparison = CompareWithTruth(RunAndWrite(options), trials);
  std::cout << "truth    found - true over the trials that count\n";
  PrintError("movement onset  ", comparison.onset);
  PrintError("widest opening  ", comparison.closure_start);
  PrintError("first contacts  ", comparison.contact);
  PrintError("GFT             ", comparison.gft);
}

}  // namespace

void AddStudyCommand(CLI::App& program, ExitCode& exit_code) {
  CLI::App& group =
      AddSubcommand(program, "study", "Analyses people's reaching and grasping from recordings.",
                    "  graspbench study demo --out demo\n"
                    "  graspbench study run study.yaml --out results/pilot");
  group.require_subcommand(1);
  const auto options = std::make_shared<StudyOptions>();
  const auto add_common = [&](CLI::App& command) {
    command.add_option("--out", options->out, "folder for tables, BIDS derivative and report")
        ->required()
        ->option_text("DIR");
    command
        .add_option("--robot", options->robot,
                    "a session of graspbench run to put beside the people")
        ->option_text("SESSION");
  };

  CLI::App& run = AddSubcommand(
      group, "run", "From recordings to tables, statistics and a report.",
      "  graspbench study run study.yaml --out results/pilot\n"
      "  graspbench study run study.yaml --data /data/mocap --out out --robot results/benchmark");
  run.add_option("study", options->study_file, "what was recorded and every choice")
      ->required()
      ->option_text("STUDY.YAML");
  run.add_option("--data", options->data, "folder of the recordings (default: that of study.yaml)")
      ->option_text("DIR");
  add_common(run);
  run.callback([options, &exit_code] {
    if (RunAndWrite(*options).CountKept() == 0) exit_code = kExitFailed;
  });

  CLI::App& demo = AddSubcommand(
      group, "demo", "Makes up a study with known contacts, analyses it and tells the errors.",
      "  graspbench study demo --out demo\n"
      "  graspbench study demo --out demo --robot results/benchmark-1a2b3c4d");
  add_common(demo);
  demo.callback([options] { RunDemo(*options); });
}

}  // namespace graspbench
