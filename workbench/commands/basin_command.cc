#include <CLI/CLI.hpp>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>

#include "core/base/files.h"
#include "core/base/text.h"
#include "datasets/analysis/basin_summary.h"
#include "datasets/session/session_inputs.h"
#include "datasets/session/session_plan.h"
#include "reports/basin_page.h"
#include "workbench/commands/command.h"
#include "workbench/experiments/batch_runner.h"
#include "workbench/experiments/interrupt.h"
#include "workbench/progress.h"

namespace graspbench {
namespace {

struct BasinOptions {
  std::string hand, object, out;
  std::string grasp = "best";
  int num_samples = 200;
  int num_workers = 1;
};

/** Tries every sample; the n-th of the planned trials is the n-th sample. */
void RunSamples(const BasinOptions& options, const TrialSetup& nominal,
                std::vector<BasinSample>& samples) {
  std::vector<PlannedTrial> trials;
  for (size_t i = 0; i < samples.size(); ++i) {
    trials.push_back({std::to_string(i), nominal.hand->id, nominal.object->id, nominal.grasp.id,
                      static_cast<int>(i)});
  }
  const auto make_worker = [&](int) {
    const auto runner = std::make_shared<TrialRunner>(nominal.hand, nominal.object);
    return BatchWorker{[&, runner](const PlannedTrial& trial) {
                         const BasinSample& sample = samples[static_cast<size_t>(trial.trial)];
                         TrialSetup setup = nominal;
                         setup.draw.offset_x = sample.offset_x;
                         setup.draw.offset_y = sample.offset_y;
                         setup.draw.offset_yaw = sample.yaw;
                         return runner->Run(setup);
                       },
                       [&](const TrialRecord& record) {  // every sample belongs to one worker
                         BasinSample& sample = samples[static_cast<size_t>(record.plan.trial)];
                         sample.outcome = record.result.outcome;
                         sample.sigma = record.result.stability.sigma;
                       }};
  };
  Progress progress(stderr, static_cast<int>(samples.size()), {});
  const auto start = std::chrono::steady_clock::now();
  const auto show = [&](const BatchStatus& status) {
    progress.Show(status,
                  std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  };
  const bool is_complete =
      RunBatch(trials, options.num_workers, make_worker, show, CatchInterrupts());
  progress.Finish();
  if (!is_complete) throw Error(ErrorKind::kInterrupted, "stopped; nothing was written");
}

void Run(const BasinOptions& options) {
  SessionConfig config;
  config.hands = {options.hand};
  config.objects = {options.object};
  config.grasps = {options.grasp};
  config.trials = 1;
  const SessionInputs inputs = LoadSessionInputs(config);
  const std::vector<PlannedTrial> plan = MakePlan(config, inputs);
  if (plan.size() != 1) {
    throw Error(ErrorKind::kUsage, "found " + std::to_string(plan.size()) +
                                       " cells; a basin is that of one hand, one object and one "
                                       "grasp");
  }
  TrialSetup nominal = MakeTrialSetup(config, inputs, plan.front());
  nominal.draw = TrialDraw();
  nominal.draw.joint_error = Eigen::VectorXd::Zero(nominal.hand->num_joints());

  std::vector<BasinSample> samples = MakeBasinSamples(options.num_samples);
  RunSamples(options, nominal, samples);
  const std::filesystem::path folder = options.out;
  MakeFolder(folder);
  const std::string title =
      nominal.hand->name + ", " + nominal.object->name + ", " + nominal.grasp.id;
  WriteFileAtomically(folder / "basin.csv", FormatBasinCsv(samples));
  WriteFileAtomically(folder / "index.html", MakeBasinPage(title, samples));
  const double radius = CalcBasinRadius(samples);
  std::cout << title << ": basin radius " << FormatFixed(radius, 2) << " ("
            << FormatFixed(MmFromM(radius * kBasinOffset), 1) << " mm, "
            << FormatFixed(DegFromRad(radius * kBasinYaw), 1) << " deg)\n"
            << "map      " << (folder / "index.html").string() << '\n';
}

}  // namespace

void AddBasinCommand(CLI::App& program, ExitCode&) {
  CLI::App& command = AddSubcommand(
      program, "basin", "Maps how far an object may stand from where a hand expects it.",
      "  graspbench basin --hand tum --object golf_ball --out ball_basin\n"
      "  graspbench basin --hand shadow --object can --grasp g3 --samples 400 --out can_basin");
  const auto options = std::make_shared<BasinOptions>();
  command.add_option("--hand", options->hand, "hand by id or folder")
      ->required()
      ->option_text("HAND");
  command.add_option("--object", options->object, "object by id or folder")
      ->required()
      ->option_text("OBJECT");
  command.add_option("--grasp", options->grasp, "best (default), an id or a grasp file")
      ->option_text("GRASP");
  command.add_option("--samples", options->num_samples, "offsets to try (default 200)")
      ->check(CLI::Range(1, 100000))
      ->option_text("N");
  AddJobsOption(command, options->num_workers);
  command.add_option("--out", options->out, "folder for index.html and basin.csv")
      ->required()
      ->option_text("DIR");
  command.callback([options] { Run(*options); });
}

}  // namespace graspbench
