#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/trial/trial_runner.h"
#include "datasets/plan/session_plan.h"
#include "workbench/command.h"
#include "workbench/experiments/output_folder.h"
#include "workbench/pictures/trial_picture.h"

namespace graspbench {
namespace {

constexpr double kSearchInterval = 0.01;  // of the instants to choose from [s]

struct RenderOptions {
  std::string hand, object, grasp;
  std::string at;
  std::vector<std::string> view;
  std::string size = "960x720";
  std::string out;
};

/** The trial of a session without any variation: object and drives exactly where they should be. */
TrialSetup MakeNominalSetup(const RenderOptions& options) {
  for (const std::string* name : {&options.hand, &options.object, &options.grasp}) {
    if (*name == "all") throw Error(ErrorKind::kUsage, "\"all\" is for sessions; expected one");
  }
  SessionConfig config;
  config.hands = {options.hand};
  config.objects = {options.object};
  config.grasps = {options.grasp};
  config.trials = 1;
  config.variation = {0.0, 0.0};
  const SessionInputs inputs = LoadSessionInputs(config);
  TrialSetup setup = MakeTrialSetup(config, inputs, MakePlan(config, inputs).front());
  setup.draw.joint_error.setZero();
  return ChooseGraspBySight(std::move(setup));
}

void Render(const RenderOptions& options) {
  CheckOutputFile(options.out);
  const PictureSize size = ParsePictureSize(options.size);
  CheckInstantName(options.at);
  const SceneView view = ParseSceneView(options.view, "render --help");
  const TrialSetup setup = MakeNominalSetup(options);
  TrialRunner runner(setup.hand, setup.object);
  const TracedTrial traced = TraceTrial(runner, setup, kSearchInterval);
  const TraceInstant& instant = FindNamedInstant(traced, options.at);
  WriteOutputFile(options.out, EncodePng(DrawTrial(setup, traced, instant, view, size)));
  PrintResult(options.out + "\n");
  PrintMessage(setup.hand->name + ", " + setup.object->name + ", " + setup.grasp.id + ": " +
               NameOf(traced.result.outcome));
}

}  // namespace

void AddRenderCommand(Command& program) {
  Command& command = AddSubcommand(
      program, "render", "Run one trial without variation and draw it with its forces.",
      "  graspbench render shadow can g3 --at closed --out can.png\n"
      "  graspbench render tum golf_ball best --at 1.25s --camera top --out ball.png");
  const auto options = std::make_shared<RenderOptions>();
  command.AddRequired("hand", options->hand, "hand by id or folder", "HAND");
  command.AddRequired("object", options->object, "object by id or folder", "OBJECT");
  command.AddRequired("grasp", options->grasp, "an id such as g1, best, by-sight, or a grasp file",
                      "GRASP");
  AddPictureOptions(command, options->at, options->view, options->size);
  command.AddRequired("--out", options->out, "the picture (PNG)", "FILE.PNG");
  command.SetAction([options] { Render(*options); });
}

}  // namespace graspbench
