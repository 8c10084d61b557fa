#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "core/base/files.h"
#include "core/hand/load_hand.h"
#include "core/render/hand_scene.h"
#include "core/trial/trial_runner.h"
#include "objects/catalogue.h"
#include "workbench/commands/command.h"
#include "workbench/experiments/output_folder.h"

namespace graspbench {
namespace {

constexpr int kWidth = 960;
constexpr int kHeight = 720;

struct RenderOptions {
  std::string hand, object, grasp;
  std::string phase = NameOf(Moment::kClosed);
  std::string out;
};

StandardGrasp LoadGrasp(const Hand& hand, const std::string& id) {
  std::vector<std::string> known;
  for (const StandardGrasp& grasp : LoadStandardGrasps(hand)) {
    if (grasp.id == id) return grasp;
    known.push_back(grasp.id);
  }
  throw Error(ErrorKind::kNotFound,
              "the " + hand.name + " has no grasp \"" + id + "\"" + SuggestNames(id, known));
}

/** A trial without any variation: object and drives exactly where they should be. */
TrialResult RunNominalTrial(const std::shared_ptr<const Hand>& hand,
                            const std::shared_ptr<const GraspObject>& object,
                            const StandardGrasp& grasp) {
  TrialSetup setup;
  setup.hand = hand;
  setup.object = object;
  setup.grasp = grasp;
  setup.draw.joint_error = Eigen::VectorXd::Zero(hand->num_joints());
  return TrialRunner(hand, object).Run(setup);
}

void Render(const RenderOptions& options) {
  CheckOutputFile(options.out);
  const auto hand = std::make_shared<const Hand>(LoadHand(options.hand));
  const StandardGrasp grasp = LoadGrasp(*hand, options.grasp);
  const auto object = LoadObject(options.object);
  const TrialResult result = RunNominalTrial(hand, object, grasp);

  std::vector<Scene> scenes;
  const SceneSnapshot* shown = nullptr;
  size_t shown_index = 0;
  for (const SceneSnapshot& snapshot : result.snapshots) {
    if (NameOf(snapshot.moment) == options.phase) {
      shown = &snapshot;
      shown_index = scenes.size();
    }
    scenes.push_back(MakeGraspScene(hand, snapshot.q, snapshot.X_WH, object, snapshot.X_WO));
  }
  if (!shown) {
    throw Error(ErrorKind::kUnsupported, "the trial ended before the phase \"" + options.phase +
                                             "\": " + NameOf(result.outcome) + ", " +
                                             result.reason);
  }
  // One camera for all phases of a trial, so that pictures of a series can be compared.
  const Eigen::Vector3d to_eye =
      FindGraspView(*hand, result.snapshots.front().q, result.snapshots.front().X_WH);
  const Camera camera = FrameScenes(scenes, to_eye, static_cast<double>(kWidth) / kHeight);
  Renderer renderer(kWidth, kHeight);
  WriteFileAtomically(options.out, EncodePng(renderer.Render(scenes[shown_index], camera)));
  PrintResult(options.out + "\n");
  PrintMessage(hand->name + ", " + object->name + ", " + grasp.id + ": " + NameOf(result.outcome));
}

}  // namespace

void AddRenderCommand(CLI::App& program, ExitCode&) {
  CLI::App& command =
      AddSubcommand(program, "render", "Run one trial without variation and draw it.",
                    "  graspbench render shadow can g3 --phase closed --out can.png\n"
                    "  graspbench render tum golf_ball g1 --phase lifted --out ball.png");
  const auto options = std::make_shared<RenderOptions>();
  command.add_option("hand", options->hand, "hand by id or folder")
      ->required()
      ->option_text("HAND");
  command.add_option("object", options->object, "object by id or folder")
      ->required()
      ->option_text("OBJECT");
  command.add_option("grasp", options->grasp, "standard grasp: g1..g5")
      ->required()
      ->option_text("GRASP");
  command.add_option("--phase", options->phase, "when: " + ListNames(ListNames(kMoments)))
      ->check(CLI::IsMember(ListNames(kMoments)))
      ->option_text("PHASE")
      ->capture_default_str();
  command.add_option("--out", options->out, "the picture (PNG)")
      ->required()
      ->option_text("FILE.PNG");
  command.callback([options] { Render(*options); });
}

}  // namespace graspbench
