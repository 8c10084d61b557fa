#include <filesystem>
#include <memory>
#include <string>

#include "core/base/error.h"
#include "core/base/text/text.h"
#include "core/base/units.h"
#include "datasets/analysis/conditions/basin_summary.h"
#include "datasets/plan/session_inputs.h"
#include "workbench/command.h"
#include "workbench/experiments/output_folder.h"
#include "workbench/experiments/session_experiment.h"
#include "workbench/result_page.h"
#include "workbench/terminal/terminal_observer.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

struct BasinRequest {
  std::string hand, object;
  std::string grasp = "best";
  int num_samples = 200;
  std::filesystem::path out;
  bool replace = false;  ///< another basin there, unchanged since it was written
};

struct BasinOptions {
  BasinRequest request;
  ExperimentRequest run;
  bool json = false;
};

SessionConfig MakeBasinConfig(const BasinRequest& request) {
  SessionConfig config;
  config.hands = {request.hand};
  config.objects = {request.object};
  config.grasps = {request.grasp};
  config.trials = 1;
  config.draws = "halton";
  config.variation.offset = kBasinOffset;
  config.variation.yaw = kBasinYaw;
  return config;
}

/** A basin is a session of such draws; another session is no result of this command. */
std::string FindKindToReplace(const fs::path& folder) {
  const bool is_basin = HasSession(folder) && LoadPlannedSession(folder).config.draws == "halton";
  return is_basin ? kSessionStore.name : "basin";
}

/** Makes the session in `out`, or finds it there. */
PreparedSession PrepareBasin(const BasinRequest& request) {
  const std::vector<fs::path> read = {request.hand, request.object, request.grasp};
  const bool is_there = HasSession(request.out);
  OutputRequest output = {request.out, FindKindToReplace(request.out), request.replace, read};
  if (!is_there) CheckOutputFolder(output);  // before anything is read
  SessionConfig config = MakeBasinConfig(request);
  const SessionInputs inputs = LoadSessionInputs(config, FieldUse::kLater);
  if (const size_t num_cells = MakePlan(config, inputs).size(); num_cells != 1) {
    throw Error(ErrorKind::kUsage,
                "found " + std::to_string(num_cells) +
                    " conditions; a basin needs one hand, one object and one grasp");
  }
  config.trials = request.num_samples;
  const std::vector<PlannedTrial> plan = MakePlan(config, inputs);
  if (!is_there || !(LoadPlannedSession(request.out).plan == plan)) {
    if (is_there) output.derived = ListStoreFiles(request.out);
    StagedFolder staged(output, StagedFolder::Mark::kOwn);
    CopyInputs(config, staged.path());
    CopyRehearsed(inputs, staged.path());
    CreateSession(staged.path(), config, plan);
    staged.Commit();
  }
  SessionRequest session;
  session.config = config;
  session.out = request.out;
  session.resume = true;
  session.inputs = read;
  return PrepareSession(session);
}

void Run(const BasinOptions& options) {
  const PreparedSession basin = PrepareBasin(options.request);
  if (options.run.plan_only) {
    RecordPlanning(basin.folder);
    return PrintExperimentPlan(basin, options.json);
  }
  TerminalObserver observer;
  DemandFinished(RunExperiment(basin, options.run, observer));
  const Session session = LoadSession(basin.folder, OnDamage::kRefuse, RecordParts::kBrief);
  const std::filesystem::path report = WriteResults(session);
  const BasinSummary summary = SummariseBasin(ListBasinSamples(session));
  if (options.json) {
    return PrintJson({{"folder", basin.folder.string()},
                      {"report", report.string()},
                      {"samples", summary.num_samples},
                      {"successes", summary.num_successes},
                      {"radius", summary.radius},
                      {"radius_offset_mm", MmFromM(summary.radius_offset)},
                      {"radius_yaw_deg", DegFromRad(summary.radius_yaw)}});
  }
  PrintResult(NameBasin(basin.inputs, session.plan.front()) + ": basin radius " +
              FormatFixed(summary.radius, 2) + " (" +
              FormatFixed(MmFromM(summary.radius_offset), 1) + " mm, " +
              FormatFixed(DegFromRad(summary.radius_yaw), 1) + " deg)" + FormatPlaces(report));
}

}  // namespace

void AddBasinCommand(Command& program) {
  Command& command = AddSubcommand(
      program, "basin", "Map the placement error that a grasp tolerates.",
      "  graspbench basin --hand tum --object golf_ball --out ball_basin\n"
      "  graspbench basin --hand shadow --object can --grasp g3 --samples 400 --out can_basin");
  const auto options = std::make_shared<BasinOptions>();
  BasinRequest& request = options->request;
  command.AddRequired("--hand", request.hand, "hand by id or folder", "HAND");
  command.AddRequired("--object", request.object, "object by id or folder", "OBJECT");
  command.AddOption("--grasp", request.grasp, "best, an id or a grasp file", "GRASP")
      ->ShowDefault();
  command.AddOption("--samples", request.num_samples, "offsets to try", "N")
      ->Within(1, 100000)
      ->ShowDefault();
  AddJobsOption(command, options->run.num_workers);
  AddTrialTimeoutOption(command, options->run.trial_time_limit);
  AddPlanOnlyOption(command, options->run.plan_only);
  command.AddRequired("--out", request.out, "folder for report and basin.csv", "DIR");
  AddReplaceOption(command, request.replace);
  AddJsonOption(command, options->json);
  command.SetAction([options] { Run(*options); });
}

}  // namespace graspbench
