#include <filesystem>
#include <memory>
#include <optional>

#include "core/base/files/files.h"
#include "human_study/study/run/run_study.h"
#include "human_study/study/synthetic/demo_study.h"
#include "reports/study/study_report.h"
#include "workbench/command.h"
#include "workbench/experiments/output_folder.h"
#include "workbench/terminal/terminal_observer.h"
#include "workbench/text/study_text.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

constexpr const char* kWrittenByR = "tidy/r_statistics.csv";  // by tidy/analysis.R

struct StudyOptions {
  std::string study_file;
  std::string data;  ///< folder of the recordings; empty: that of study.yaml
  std::string out;
  std::string robot;  ///< folder of a session; empty: what study.yaml says
  bool replace = false, json = false;
  std::vector<std::string> settings;
};

std::optional<RobotSession> LoadRobot(const StudyOptions& options, const Study& study) {
  fs::path folder = options.robot;
  if (folder.empty() && !study.config.robot.empty()) folder = study.folder / study.config.robot;
  if (folder.empty()) return std::nullopt;
  return RobotSession{folder.lexically_normal().filename().string(), LoadSession(folder)};
}

void StopIfAsked(const std::atomic<bool>& stop) {
  if (!stop) return;
  throw Error(ErrorKind::kInterrupted,
              "stopped; nothing was written. Repeat the command to start again");
}

/** A line for every tenth of the trials, once there are enough for it to matter. */
void ShowProgress(size_t num_done, size_t num_planned) {
  const size_t step = num_planned / 10;
  if (num_planned < 100 || num_done % step != 0) return;
  PrintMessage(std::to_string(num_done) + " of " + std::to_string(num_planned) + " trials");
}

/** Analyses the study into the folder that will become --out. @throws Error(kInterrupted). */
StudyResult RunAndWrite(const StudyOptions& options, StagedFolder& staged,
                        const std::atomic<bool>& stop) {
  const Study study = LoadStudy(options.study_file, options.data, options.settings);
  if (!study.warnings.entries().empty()) PrintMessage(study.warnings.Format());
  const std::optional<RobotSession> robot = LoadRobot(options, study);
  StudyResult result = AnalyseStudy(study, staged.path(), [&](size_t num_done, size_t num_planned) {
    StopIfAsked(stop);
    ShowProgress(num_done, num_planned);
  });
  StopIfAsked(stop);
  const fs::path page = WriteStudyReport(staged.path(), result, robot ? &*robot : nullptr);
  const fs::path out = options.out;
  const fs::path report = out / page.lexically_relative(staged.path());
  StopIfAsked(stop);
  staged.Commit();
  options.json ? PrintJson(MakeStudyJson(result, out, report))
               : PrintResult(FormatStudy(result, out, report));
  return result;
}

StudyResult RunStudyFile(const StudyOptions& options) {
  const std::atomic<bool>& stop = CatchInterrupts();  // before there is a folder to leave behind
  const std::vector<fs::path> read = {options.study_file, options.data, options.robot};
  StagedFolder staged({options.out, "study", options.replace, read, "", {kWrittenByR}});
  return RunAndWrite(options, staged, stop);
}

/** Writes the choices beside study.yaml, once. */
void Freeze(const StudyOptions& options) {
  const fs::path file = FindFreezePath(options.study_file);
  CheckOutputFile(file);
  WriteFileAtomically(file, MakeFreeze(options.study_file, options.data));
  PrintResult("frozen   " + file.string() + "\n");
}

void RunDemo(StudyOptions options) {
  const std::atomic<bool>& stop = CatchInterrupts();
  StagedFolder staged({options.out, "study", options.replace, {options.robot}, "", {kWrittenByR}});
  const fs::path input = staged.path() / "input";
  const std::vector<SyntheticTrial> trials = MakeSyntheticStudy(MakeDemoOptions());
  WriteDemoStudy(trials, input);
  options.study_file = (input / "study.yaml").string();
  PrintResult(FormatTruth(CompareWithTruth(RunAndWrite(options, staged, stop), trials)));
}

}  // namespace

void AddStudyCommand(Command& program) {
  Command& group =
      AddSubcommand(program, "study", "Analyse recordings of human reach-to-grasp movements.",
                    "  graspbench study demo --out demo\n"
                    "  graspbench study freeze study.yaml\n"
                    "  graspbench study run study.yaml --out results/pilot");
  group.RequireSubcommand();
  const auto options = std::make_shared<StudyOptions>();
  const auto add_study = [&](Command& command, const char* about) {
    command.AddRequired("study", options->study_file, about, "STUDY.YAML");
    command.AddOption("--data", options->data, "folder of the recordings", "DIR")
        ->ShowDefault("that of study.yaml");
  };
  const auto add_common = [&](Command& command) {
    command.AddRequired("--out", options->out, "folder for tables, BIDS derivative and report",
                        "DIR");
    command.AddOption("--robot", options->robot,
                      "session of graspbench run to compare with the participants", "SESSION");
    AddReplaceOption(command, options->replace);
  };

  Command& run = AddSubcommand(
      group, "run", "Turn recordings into tables, statistics and a report.",
      "  graspbench study run study.yaml --out results/pilot\n"
      "  graspbench study run study.yaml --data /data/mocap --out out --robot results/benchmark");
  add_study(run, "study file: recordings and all choices");
  AddSettingsOption(run, options->settings, "contact.detector=surface");
  add_common(run);
  AddJsonOption(run, options->json);
  run.SetAction(
      [options] { return RunStudyFile(*options).CountKept() == 0 ? kExitFailed : kExitOk; });

  Command& freeze = AddSubcommand(
      group, "freeze", "Freeze all choices before data collection; a run lists deviations.",
      "  graspbench study freeze study.yaml");
  add_study(freeze, "study file: planned recordings and all choices");
  freeze.SetAction([options] { Freeze(*options); });

  Command& demo = AddSubcommand(
      group, "demo",
      "Generate a synthetic study with known contacts, analyse it and report the errors.",
      "  graspbench study demo --out demo\n"
      "  graspbench study demo --out demo --robot results/benchmark-1a2b3c4d");
  add_common(demo);
  demo.SetAction([options] { RunDemo(*options); });
}

}  // namespace graspbench
