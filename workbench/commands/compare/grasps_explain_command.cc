#include <memory>
#include <string>

#include "core/base/text/text.h"
#include "core/base/units.h"
#include "datasets/judged_grasps/profile_file.h"
#include "reports/kind_pages.h"
#include "workbench/command.h"
#include "workbench/commands/options/foreign_grasp_options.h"
#include "workbench/experiments/judge_grasps.h"
#include "workbench/experiments/output_folder.h"
#include "workbench/tables/text_table.h"

namespace graspbench {
namespace {

struct ExplainOptions {
  GraspInputOptions inputs;
  std::string from = "dexgraspbench-fc", to = "own";
  int number = 0;
  bool json = false;
};

const char* NameVerdict(const FreeSpaceResult& result) { return result.passed ? "pass" : "fail"; }

std::string FormatSteps(const std::vector<ExplainStep>& steps) {
  TextTable table({"value", "from", "to", "verdict", "failed at", "moved [mm]", "turned [deg]"});
  std::string turns;
  for (const ExplainStep& step : steps) {
    table.AddRow({step.key.empty() ? "(as it is)" : step.key, step.from, step.to,
                  std::string(NameVerdict(step.result)) + (step.turns ? " *" : ""),
                  step.result.failed_stage.empty() ? "-" : step.result.failed_stage,
                  FormatFixed(MmFromM(step.result.worst_shift), 1),
                  FormatFixed(step.result.worst_turn_deg, 1)});
    if (!step.turns) continue;
    turns += "* " + step.key + " from " + step.from + " to " + step.to +
             " changes the verdict to " + NameVerdict(step.result) +
             (step.result.reason.empty() ? "" : ": " + step.result.reason) + "\n";
  }
  return table.Format() + (turns.empty() ? "no value changes the verdict\n" : turns);
}

void Explain(const ExplainOptions& options) {
  const std::vector<FreeSpaceProfile> profiles = LoadProfiles({options.from, options.to});
  const GraspInputs inputs = options.inputs.Load(profiles);
  const GraspInput& input = FindGraspInput(inputs, options.number);
  const std::vector<ExplainStep> steps = ExplainGrasp(inputs, input, profiles[0], profiles[1]);
  if (!options.json) return PrintResult(FormatSteps(steps));
  Json json = Json::array();
  for (const ExplainStep& step : steps) {
    json.push_back({{"key", step.key},
                    {"from", step.from},
                    {"to", step.to},
                    {"turns", step.turns},
                    {"result", RecordToJson(step.result)}});
  }
  PrintJson({{"grasp", input.grasp.source}, {"index", input.grasp.index}, {"steps", json}});
}

constexpr double kShownInterval = 0.01;  // of the instants that are shown [s]

struct ShowGraspOptions {
  GraspInputOptions inputs;
  std::string profile = "dexgraspbench-fc";
  int number = 0;
  std::string out;
  bool json = false;
};

void Show(const ShowGraspOptions& options) {
  CheckOutputFile(options.out);
  const FreeSpaceProfile profile = LoadProfile(options.profile);
  const GraspInputs inputs = options.inputs.Load({profile});
  const GraspInput& input = FindGraspInput(inputs, options.number);
  GraspPageData data;
  data.name = NameGrasp(input.grasp);
  data.object_name = input.grasp.object;
  data.hand = inputs.hand;
  data.object = input.object;
  data.profile = profile;
  data.traced = TraceFreeSpace(MakeInputScene(inputs, input, profile), profile, kShownInterval);
  data.assumptions = input.grasp.assumptions;
  data.commands = {"graspbench grasps show FILES --grasp " + std::to_string(options.number) +
                   " --objects DIR --profile " + profile.name + " --out ANOTHER.html"};
  WriteOutputFile(options.out, MakeGraspPage(data));
  const FreeSpaceResult& result = data.traced.result;
  if (options.json) {
    return PrintJson({{"grasp", input.grasp.source},
                      {"index", input.grasp.index},
                      {"profile", profile.name},
                      {"result", RecordToJson(result)},
                      {"page", options.out}});
  }
  PrintResult(data.name + ", " + profile.name + ": " +
              (result.passed ? "pass" : "fail at " + result.failed_stage + ": " + result.reason) +
              "\npage     " + options.out + "\n");
}

}  // namespace

void AddGraspsExplainCommand(Command& program) {
  const auto options = std::make_shared<ExplainOptions>();
  Command& explain = AddSubcommand(
      program.Subcommand("grasps"), "explain",
      "Find the profile value that changes the verdict on a grasp.",
      "  graspbench grasps explain mug.npy --objects meshes\n"
      "  graspbench grasps explain mug.npy --grasp 3 --from own --to mine.yaml --objects meshes");
  options->inputs.AddTo(explain);
  AddGraspNumberOption(explain, options->number);
  explain.AddOption("--from", options->from, "first profile, by name or file", "P")->ShowDefault();
  explain.AddOption("--to", options->to, "second profile, by name or file", "P")->ShowDefault();
  AddJsonOption(explain, options->json);
  explain.SetAction([options] { Explain(*options); });

  const auto shown = std::make_shared<ShowGraspOptions>();
  Command& show = AddSubcommand(
      program.Subcommand("grasps"), "show",
      "Write a page about one grasp under a profile, with a 3-D view of the test.",
      "  graspbench grasps show mug.npy --objects meshes --out mug.html\n"
      "  graspbench grasps show mug.npy --grasp 3 --profile own --objects meshes --out mug.html");
  shown->inputs.AddTo(show);
  AddGraspNumberOption(show, shown->number);
  show.AddOption("--profile", shown->profile, "profile by name or file", "P")->ShowDefault();
  show.AddRequired("--out", shown->out, "new page", "FILE");
  AddJsonOption(show, shown->json);
  show.SetAction([shown] { Show(*shown); });
}

}  // namespace graspbench
