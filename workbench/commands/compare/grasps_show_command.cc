#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "datasets/judged_grasps/profile_file.h"
#include "reports/grasp_page.h"
#include "workbench/commands/command.h"
#include "workbench/commands/options/foreign_grasp_options.h"

namespace graspbench {
namespace {

constexpr double kInterval = 0.01;  // of the instants that are shown [s]

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
  data.traced = TraceFreeSpace(MakeInputScene(inputs, input, profile), profile, kInterval);
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

void AddGraspsShowCommand(CLI::App& program, ExitCode&) {
  const auto options = std::make_shared<ShowGraspOptions>();
  CLI::App& command = AddSubcommand(
      *program.get_subcommand("grasps"), "show",
      "Draw one grasp under a profile: a page with a 3-D view of its course.",
      "  graspbench grasps show mug.npy --objects meshes --out mug.html\n"
      "  graspbench grasps show mug.npy --grasp 3 --profile own --objects meshes --out mug.html");
  options->inputs.AddTo(command);
  command.add_option("--grasp", options->number, "which of the files' grasps, from 0 on")
      ->check(CLI::Range(0, 100000000))
      ->option_text("N")
      ->capture_default_str();
  command.add_option("--profile", options->profile, "profile by name or file")
      ->option_text("P")
      ->capture_default_str();
  command.add_option("--out", options->out, "new page")->required()->option_text("FILE");
  AddJsonOption(command, options->json);
  command.callback([options] { Show(*options); });
}

}  // namespace graspbench
