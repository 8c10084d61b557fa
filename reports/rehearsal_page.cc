#include <algorithm>

#include "core/base/text/text.h"
#include "core/base/version.h"
#include "core/grasp/placement.h"
#include "core/render/hand_scene.h"
#include "objects/catalogue.h"
#include "reports/kind_pages.h"
#include "reports/page/layout.h"
#include "reports/page/models.h"

namespace graspbench {
namespace {

constexpr int kRehearsedWidth = 360, kRehearsedHeight = 300;  // [px]
constexpr size_t kMostPictured = 4;                           // candidates per pair
constexpr size_t kMostPairs = 12;                             // pairs that have all their pictures

std::string NameOfPair(const RehearsedPair& pair) { return pair.hand + ", " + pair.object; }
std::string IdOfPair(const RehearsedPair& pair) {
  return "pair-" + std::to_string(pair.request + 1);
}

/** Lists the chosen candidate first, then the others by decreasing run length. */
std::vector<size_t> ListBest(const Rehearsal& rehearsal) {
  std::vector<size_t> order;
  const auto chosen = static_cast<size_t>(rehearsal.chosen);
  for (size_t i = 0; i < rehearsal.tried.size(); ++i) order.push_back(i);
  std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) {
    if ((a == chosen) != (b == chosen)) return a == chosen;
    return rehearsal.tried[a].FindRun() > rehearsal.tried[b].FindRun();
  });
  return order;
}

Html DrawChoices(const RehearsalPageData& data) {
  Table table("Chosen grasps. Held: share of the rehearsal draws, which belong to no session.",
              {"hand", "object", "chosen", "held", "95 % interval", "candidates tried", "trials"});
  for (const RehearsedPair& pair : data.pairs) {
    const RehearsedCandidate& choice = pair.result.choice();
    table.AddRow({pair.hand, LinkTo(IdOfPair(pair), pair.object), Describe(choice.candidate),
                  choice.FormatHeld(), choice.FormatInterval(),
                  static_cast<int>(pair.result.tried.size()), pair.result.num_trials});
  }
  return table.ToHtml();
}

Html DrawCandidates(const Rehearsal& rehearsal) {
  Table table("Candidates in the order of testing.", {"candidate", "held", "first failure"});
  for (const RehearsedCandidate& tried : rehearsal.tried) {
    const auto failed = std::find_if(tried.outcomes.begin(), tried.outcomes.end(),
                                     [](Outcome outcome) { return !IsSuccess(outcome); });
    const std::string why =
        failed == tried.outcomes.end()
            ? ""
            : WordsOf(*failed) + (tried.reason.empty() ? "" : ": ") + tried.reason;
    table.AddRow({Describe(tried.candidate), tried.FormatHeld(), why});
  }
  return table.ToHtml();
}

Html DrawPairPictures(const RehearsalTask& task, const Rehearsal& rehearsal, size_t most,
                      Renderer& renderer) {
  const std::shared_ptr<const GraspObject> object = CompleteObject(task.object);
  const CandidateMaker maker(*task.hand, task.grasps, *object);
  const Pose X_WO =
      MakePose(Eigen::Matrix3d::Identity(), Eigen::Vector3d(0.0, 0.0, 0.5 * object->size.z()));
  Html frames;
  const std::vector<size_t> best = ListBest(rehearsal);
  for (size_t i = 0; i < best.size() && i < most; ++i) {
    const RehearsedCandidate& tried = rehearsal.tried[best[i]];
    const Grasp grasp = maker.Make(tried.candidate);
    const Pose& X_WH = grasp.placement->X_WH;
    const Eigen::VectorXd q =
        CalcClosingPosture(*task.hand, grasp, grasp.placement->closing_at_contact);
    const Scene scene = MakeGraspScene(task.hand, q, X_WH, object, X_WO);
    const Camera camera = FrameScenes({scene}, FindGraspView(*task.hand, q, X_WH),
                                      static_cast<double>(kRehearsedWidth) / kRehearsedHeight);
    const std::string text = (i == 0 ? "Chosen: " : "Next: ") + Describe(tried.candidate) +
                             ", held " + tried.FormatHeld();
    frames += Element(
        "figure", {},
        Element("img",
                {{"src", MakeDataUri("image/webp", EncodeWebp(renderer.Render(scene, camera)))},
                 {"width", std::to_string(kRehearsedWidth)},
                 {"height", std::to_string(kRehearsedHeight)},
                 {"alt", text}}) +
            Element("figcaption", {}, text));
  }
  return Element("div", {{"class", "film"}}, frames);
}

Html DrawRehearsalMethods(const RehearsalPageData& data) {
  return MakeParagraph(
      "Candidates are the standard grasps of the hand at the rule's placement, from the opposite "
      "approach, turned about the vertical to the object's axes, and variations of the longest "
      "runs. Each was tested on up to " +
      std::to_string(data.config.num_draws) +
      " sampled initial poses until the first failure. Every second pose has friction times 0.8 "
      "and mass times 1.2. " +
      (data.config.num_draws < kNumProofDraws
           ? "A candidate that holds all of them is tested on " + std::to_string(kNumProofDraws) +
                 " in all, of which it may lose one. "
           : "") +
      "The first candidate that passes is chosen, else the best share among the longest runs, and "
      "among equal shares the lowest grip threshold. The poses belong to no session. At "
      "most " +
      std::to_string(data.config.num_candidates) + " candidates were tried. " +
      (data.config.num_postures > 0
           ? "If no candidate held all poses, " + std::to_string(data.config.num_postures) +
                 " target postures were searched from the choice, and the best of them were "
                 "compared with it on four times as many poses. "
           : "") +
      "graspbench " + program_version() +
      " proposes this rule; the thesis (4.2) tests every grasp on every object.");
}

}  // namespace

std::string MakeRehearsalPage(const RehearsalPageData& data) {
  const auto num_robust =
      std::count_if(data.pairs.begin(), data.pairs.end(),
                    [](const RehearsedPair& pair) { return pair.result.is_robust(); });
  std::vector<PageLink> contents = {{"choices", "Choices"}, {"methods", "Methods"}};
  Html body = Element(
      "section", {{"id", "choices"}},
      Element("h2", {}, "Choices") +
          MakeParagraph(std::to_string(num_robust) + " of " +
                        FormatCount(static_cast<int>(data.pairs.size()), "pair") +
                        " held every rehearsal draw. The intervals are Wilson's at 95 %. On new "
                        "draws expect a share in the lower half, because the grasp was selected on "
                        "these draws; a session measures the rate.") +
          DrawChoices(data));
  body += Element("section", {{"id", "methods"}},
                  Element("h2", {}, "Methods") + DrawRehearsalMethods(data));
  std::unique_ptr<Renderer> renderer;
  try {
    renderer = std::make_unique<Renderer>(kRehearsedWidth, kRehearsedHeight);
  } catch (const Error& error) {
    body += MakeNote("warning", "There are no pictures", MakeParagraph(error.what()));
  }
  const size_t most = data.pairs.size() <= kMostPairs ? kMostPictured : 1;
  for (const RehearsedPair& pair : data.pairs) {
    const RehearsedCandidate& choice = pair.result.choice();
    contents.push_back({IdOfPair(pair), NameOfPair(pair)});
    Html section = Element("h2", {}, NameOfPair(pair));
    section +=
        MakeParagraph(pair.result.is_robust()
                          ? "Chosen: " + Describe(choice.candidate) + ". It held every draw."
                          : "No candidate held every draw. The best, " +
                                Describe(choice.candidate) + ", held " + choice.FormatHeld() + ".");
    if (renderer) {
      const RehearsalTask& task = data.tasks[static_cast<size_t>(pair.request)];
      section += MakeFigure("The hand at contact with the object at its nominal pose.",
                            "pads on opposite sides of the object.",
                            DrawPairPictures(task, pair.result, most, *renderer));
    }
    section += DrawCandidates(pair.result);
    body += Element("section", {{"id", IdOfPair(pair)}}, section);
  }
  PageFrame frame = {"Rehearsed grasps", FormatCount(static_cast<int>(data.pairs.size()), "pair") +
                                             " of hand and object"};
  frame.facts = {{"Candidates", "at most " + std::to_string(data.config.num_candidates)},
                 {"Draws", std::to_string(data.config.num_draws)}};
  return MakePage(frame, contents, body);
}

}  // namespace graspbench
