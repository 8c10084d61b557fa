#include <memory>
#include <string>

#include "datasets/judged_grasps/profile_file.h"
#include "reports/grasp_page.h"
#include "workbench/commands/command.h"
#include "workbench/commands/options/foreign_grasp_options.h"

namespace graspbench {
namespace {

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

void AddGraspsShowCommand(Command& program, ExitCode&) {
  const auto options = std::make_shared<ShowGraspOptions>();
  Command& command = AddSubcommand(
      program.Subcommand("grasps"), "show",
      "Draw one grasp under a profile: a page with a 3-D view of its course.",
      "  graspbench grasps show mug.npy --objects meshes --out mug.html\n"
      "  graspbench grasps show mug.npy --grasp 3 --profile own --objects meshes --out mug.html");
  options->inputs.AddTo(command);
  command.AddOption("--grasp", options->number, "which of the files' grasps, from 0 on")
      ->Within(0, 100000000)
      ->ValueName("N")
      ->ShowDefault();
  command.AddOption("--profile", options->profile, "profile by name or file")
      ->ValueName("P")
      ->ShowDefault();
  command.AddOption("--out", options->out, "new page")->Require()->ValueName("FILE");
  AddJsonOption(command, options->json);
  command.SetAction([options] { Show(*options); });
}

}  // namespace graspbench
