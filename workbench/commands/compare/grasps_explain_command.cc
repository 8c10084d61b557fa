#include <memory>
#include <string>

#include "core/base/text/text.h"
#include "core/base/units.h"
#include "datasets/judged_grasps/profile_file.h"
#include "workbench/commands/command.h"
#include "workbench/commands/options/foreign_grasp_options.h"
#include "workbench/experiments/explain_grasp.h"
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
    turns += "* " + step.key + " from " + step.from + " to " + step.to + " turns the verdict to " +
             NameVerdict(step.result) +
             (step.result.reason.empty() ? "" : ": " + step.result.reason) + "\n";
  }
  return table.Format() + (turns.empty() ? "no value turns the verdict\n" : turns);
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

}  // namespace

void AddGraspsExplainCommand(Command& program, ExitCode&) {
  const auto options = std::make_shared<ExplainOptions>();
  Command& command = AddSubcommand(
      program.Subcommand("grasps"), "explain",
      "Say which value of a profile turns the verdict on a grasp.",
      "  graspbench grasps explain mug.npy --objects meshes\n"
      "  graspbench grasps explain mug.npy --grasp 3 --from own --to mine.yaml --objects meshes");
  options->inputs.AddTo(command);
  command.AddOption("--grasp", options->number, "which of the files' grasps, from 0 on")
      ->Within(0, 100000000)
      ->ValueName("N")
      ->ShowDefault();
  command.AddOption("--from", options->from, "profile to begin with, by name or file")
      ->ValueName("P")
      ->ShowDefault();
  command.AddOption("--to", options->to, "profile to arrive at")->ValueName("P")->ShowDefault();
  AddJsonOption(command, options->json);
  command.SetAction([options] { Explain(*options); });
}

}  // namespace graspbench
