#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "core/base/files.h"
#include "core/hand/load_hand.h"
#include "core/trial/trial_runner.h"
#include "objects/catalogue.h"
#include "reports/cell_pictures.h"
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

std::vector<std::string> ListPhases() {
  std::vector<std::string> phases;
  for (const MomentRow& row : kMoments) phases.emplace_back(NameOf(row.value));
  return phases;
}

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

  const auto shown = std::find_if(
      result.snapshots.begin(), result.snapshots.end(),
      [&](const SceneSnapshot& snapshot) { return NameOf(snapshot.moment) == options.phase; });
  if (shown == result.snapshots.end()) {
    throw Error(ErrorKind::kUnsupported, "the trial ended before the phase \"" + options.phase +
                                             "\": " + NameOf(result.outcome) + ", " +
                                             result.reason);
  }
  const auto index = static_cast<size_t>(shown - result.snapshots.begin());
  WriteFileAtomically(options.out,
                      RenderSnapshotAsPng(result.snapshots, index, hand, object, kWidth, kHeight));
  PrintResult(options.out + "\n");
  PrintMessage(hand->name + ", " + object->name + ", " + grasp.id + ": " + NameOf(result.outcome));
}

}  // namespace

void AddRenderCommand(CLI::App& program, ExitCode&) {
  CLI::App& command =
      AddSubcommand(program, "render", "Run one trial without variation and draw it.",
                    "  graspbench render shadow can g3 --phase stabilisation --out can.png\n"
                    "  graspbench render tum golf_ball g1 --phase hold --out ball.png");
  const auto options = std::make_shared<RenderOptions>();
  command.add_option("hand", options->hand, "hand by id or folder")
      ->required()
      ->option_text("HAND");
  command.add_option("object", options->object, "object by id or folder")
      ->required()
      ->option_text("OBJECT");
  command.add_option("grasp", options->grasp, "standard grasp of the hand, as g1")
      ->required()
      ->option_text("GRASP");
  command.add_option("--phase", options->phase, "at the end of which: " + ListNames(ListPhases()))
      ->check(CLI::IsMember(ListPhases()))
      ->option_text("PHASE")
      ->capture_default_str();
  command.add_option("--out", options->out, "the picture (PNG)")
      ->required()
      ->option_text("FILE.PNG");
  command.callback([options] { Render(*options); });
}

}  // namespace graspbench
