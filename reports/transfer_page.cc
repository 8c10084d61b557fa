#include <algorithm>
#include <set>

#include "core/base/text/text.h"
#include "core/base/version.h"
#include "core/grasp/placement.h"
#include "core/render/hand_scene.h"
#include "datasets/analysis/transfer_summary.h"
#include "datasets/plan/grasp_choice.h"
#include "objects/catalogue.h"
#include "reports/kind_pages.h"
#include "reports/page/layout.h"

namespace graspbench {
namespace {

constexpr int kTransferWidth = 320, kTransferHeight = 280;  // [pixels]
constexpr size_t kMostTransferPictures = 24;

/** The first transferred grasp of each hand on each object, at contact. */
Html DrawTransferPictures(const Session& session, const TransferFile& file) {
  const SessionInputs inputs = LoadSessionInputs(session.config, FieldUse::kLater, session.folder);
  Renderer renderer(kTransferWidth, kTransferHeight);
  std::set<std::string> drawn;
  Html frames;
  for (const TransferRow& row : file.rows) {
    if (!row.not_transferable.empty() || drawn.size() >= kMostTransferPictures) continue;
    if (!drawn.insert(row.hand + "/" + row.object).second) continue;
    for (const SessionHand& hand : inputs.hands) {
      for (const auto& object : inputs.objects) {
        if (hand.hand->id != row.hand || object->id != row.object) continue;
        const Grasp* grasp = FindGrasp(hand, *object, row.grasp);
        if (!grasp || !grasp->placement) continue;
        const Pose& X_WH = grasp->placement->X_WH;
        const Eigen::VectorXd q =
            CalcClosingPosture(*hand.hand, *grasp, grasp->placement->closing_at_contact);
        const Pose X_WO = MakePose(Eigen::Vector3d(0.0, 0.0, 0.5 * object->size.z()));
        const Scene scene = MakeGraspScene(hand.hand, q, X_WH, object, X_WO);
        const Camera camera = FrameScenes({scene}, FindGraspView(*hand.hand, q, X_WH),
                                          static_cast<double>(kTransferWidth) / kTransferHeight);
        const std::string text = row.hand + ", " + row.object + ", " + row.grasp;
        frames += Element(
            "figure", {},
            Element("img",
                    {{"src", MakeDataUri("image/webp", EncodeWebp(renderer.Render(scene, camera)))},
                     {"width", std::to_string(kTransferWidth)},
                     {"height", std::to_string(kTransferHeight)},
                     {"alt", text}}) +
                Element("figcaption", {}, text));
      }
    }
  }
  return Element("div", {{"class", "film"}}, frames);
}

Html DrawReasons(const TransferFile& file, const std::vector<std::string>& hands) {
  Table table(
      "Grasps that a hand cannot take over, with the reason; numbers are those of the first.",
      {"Hand", "Reason", "Grasps"});
  for (const std::string& hand : hands) {
    for (const auto& [reason, count] : CountTransferReasons(file, hand)) {
      table.AddRow({hand, reason, count});
    }
  }
  return table.ToHtml();
}

}  // namespace

bool IsTransfer(const Session& session) {
  std::error_code status;
  return std::filesystem::exists(session.folder / kTransferPath, status);
}

std::string MakeTransferPage(const Session& session) {
  const TransferFile file = LoadTransferFile(session.folder);
  std::vector<TransferSummary> all = SummariseTransfers(file, session), by_object;
  const auto first_object =
      std::stable_partition(all.begin(), all.end(),
                            [](const TransferSummary& summary) { return summary.object.empty(); });
  by_object.assign(first_object, all.end());
  all.erase(first_object, all.end());
  std::vector<std::string> hands;
  for (const TransferSummary& summary : all) hands.push_back(summary.hand);
  const auto section = [](const char* anchor, const char* title, const Html& content) {
    return Element("section", {{"id", anchor}}, Element("h2", {}, title) + content);
  };
  Html body = section(
      "hands", "Hands",
      MakeParagraph(
          "How far each hand can put its pads where people's digits touched, and what such grasps "
          "lift. Success: with 95 % interval (Wilson). Points: difference of success on the same "
          "draws, with 95 % interval over objects.") +
          MakeTable("People's grasps on each hand.", ShowTable(ListTransferColumns(), all)));
  body += section("objects", "Objects",
                  MakeTable("The same by object.", ShowTable(ListTransferColumns(), by_object)));
  body += section("digits", "Digits",
                  MakeTable("Pads of transferred grasps beside the contacts of the digits that "
                            "they stand for.",
                            ShowTable(ListTransferDigitColumns(), ListTransferDigits(file))));
  body += section("reasons", "Not transferable", DrawReasons(file, hands));
  Html pictures;
  try {
    pictures =
        MakeFigure("The first transferred grasp of each hand on each object, at contact.",
                   "pads on opposite sides of the object.", DrawTransferPictures(session, file));
  } catch (const Error& error) {
    pictures = MakeNote("warning", "There are no pictures", MakeParagraph(error.what()));
  }
  body += section("pictures", "Pictures", pictures);
  body += section(
      "methods", "Methods",
      MakeParagraph(
          std::string(
              "A person's contact is the point of the object's surface nearest to the digit's "
              "marker "
              "after the last digit touched. Pads are placed there by least squares over the "
              "hand's "
              "pose and joints, within limits and couplings and clear of object and table; joints "
              "that "
              "the pads leave open go to the hand's standard grasp. The pre-grasp has the person's "
              "widest opening. A grasp is not transferable when no two opposing pads come within 5 "
              "mm "
              "or the hand would start inside something. Standard grasps are the session's "
              "\"best\", "
              "rehearsed ones those of imagined trials on other draws. Proposed by graspbench ") +
          program_version() + "."));
  PageFrame frame = {"People's grasps on robot hands",
                     file.study + ", " + FormatCount(static_cast<int>(hands.size()), "hand")};
  frame.commands = {"graspbench report DIR"};
  frame.facts = {{"Seed", std::to_string(session.config.seed)},
                 {"Trials", std::to_string(session.records.size())}};
  return MakePage(frame,
                  {{"hands", "Hands"},
                   {"objects", "Objects"},
                   {"digits", "Digits"},
                   {"reasons", "Not transferable"},
                   {"pictures", "Pictures"},
                   {"methods", "Methods"}},
                  body);
}

}  // namespace graspbench
