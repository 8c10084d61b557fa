#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <utility>

#include "core/base/text/text.h"
#include "core/base/units.h"
#include "core/base/version.h"
#include "core/grasp/placement.h"
#include "core/render/hand_scene.h"
#include "core/shape/primitives.h"
#include "datasets/analysis/transfer_summary.h"
#include "datasets/plan/grasp_choice.h"
#include "objects/catalogue.h"
#include "reports/kind_pages.h"
#include "reports/page/layout.h"
#include "reports/plots/line_plot.h"

namespace graspbench {
namespace {

constexpr int kTransferWidth = 320, kTransferHeight = 280;  // [pixels]

/** Makes a rod between two points. */
Drawable MakeBone(const Eigen::Vector3d& p_WA, const Eigen::Vector3d& p_WB) {
  constexpr double kRadius = 0.004;  // [m]
  constexpr int kSegments = 12;
  const Eigen::Vector3d along = p_WB - p_WA;
  const double length = std::max(along.norm(), 1e-6);
  Drawable bone;
  bone.mesh = std::make_shared<const TriMesh>(MakeRevolution(
      {{0.0, -kRadius}, {kRadius, 0.0}, {kRadius, length}, {0.0, length + kRadius}}, kSegments));
  const Eigen::Quaterniond turn =
      Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), along / length);
  bone.X_WM = MakePose(turn.toRotationMatrix(), p_WA);
  bone.colour = Eigen::Vector3f(0.75f, 0.45f, 0.3f);
  return bone;
}

/** Draws a person's digits as bones between joints, with the knuckles connected. A digit with one
marker is drawn as a point.
@param places joints in the open hand or at contact */
Scene DrawPerson(const TransferRow& row, Eigen::VectorXd TransferPerson::*places,
                 const std::shared_ptr<const GraspObject>& object, const Pose& X_WO) {
  Scene scene;
  AddObject(object, X_WO, &scene);
  std::optional<Eigen::Vector3d> knuckle;
  for (const TransferPerson& digit : row.person) {
    const Eigen::VectorXd& chain = digit.*places;
    std::vector<Eigen::Vector3d> points;
    for (Eigen::Index k = 0; k + 3 <= chain.size(); k += 3) {
      points.emplace_back(X_WO * Eigen::Vector3d(chain.segment<3>(k)));
    }
    if (points.empty()) continue;
    if (points.size() == 1) scene.drawables.push_back(MakeBone(points[0], points[0]));
    for (size_t k = 0; k + 1 < points.size(); ++k) {
      scene.drawables.push_back(MakeBone(points[k], points[k + 1]));
    }
    if (points.size() > 1 && knuckle) scene.drawables.push_back(MakeBone(*knuckle, points[0]));
    if (points.size() > 1) knuckle = points[0];
  }
  return scene;
}

/** Pictures of one person on one object and of the hands that take over the grasp. */
class TransferFilm {
 public:
  TransferFilm(const Session& session, const TransferFile& file)
      : file_(file),
        inputs_(LoadSessionInputs(session.config, FieldUse::kLater, session.folder)),
        renderer_(kTransferWidth, kTransferHeight) {}

  /** Draws for each object the first person whose grasp the most hands can take over. */
  Html Draw() {
    Html html;
    for (const auto& object : inputs_.objects) {
      std::map<std::string, std::vector<const TransferRow*>> rows;  // rows of each grasp
      for (const TransferRow& row : file_.rows) {
        if (row.object == object->id && row.not_transferable.empty()) {
          rows[row.grasp].push_back(&row);
        }
      }
      const auto best = std::max_element(
          rows.begin(), rows.end(),
          [](const auto& a, const auto& b) { return a.second.size() < b.second.size(); });
      if (best == rows.end()) continue;
      Html frames = DrawFrames("person " + best->second.front()->participant, [&](bool is_open) {
        return DrawPerson(*best->second.front(),
                          is_open ? &TransferPerson::open : &TransferPerson::contact, object,
                          RestingPose(*object));
      });
      for (const TransferRow* row : best->second) frames += DrawHand(*row, object);
      html += Element("h3", {}, object->id) + Element("div", {{"class", "film"}}, frames);
    }
    return html;
  }

 private:
  static Pose RestingPose(const GraspObject& object) {
    return MakePose(Eigen::Vector3d(0.0, 0.0, 0.5 * object.size.z()));
  }

  Html DrawHand(const TransferRow& row, const std::shared_ptr<const GraspObject>& object) {
    for (const SessionHand& hand : inputs_.hands) {
      const Grasp* grasp =
          hand.hand->id == row.hand ? FindGrasp(hand, *object, row.grasp) : nullptr;
      if (!grasp || !grasp->placement) continue;
      const Pose& X_WH = grasp->placement->X_WH;
      return DrawFrames(row.hand, [&](bool is_open) {
        const double s = is_open ? 0.0 : grasp->placement->closing_at_contact;
        return MakeGraspScene(hand.hand, CalcClosingPosture(*hand.hand, *grasp, s), X_WH, object,
                              RestingPose(*object));
      });
    }
    return {};
  }

  /** Draws the widest opening and the contact, seen from the side that the person came from. */
  template <class MakeScene>
  Html DrawFrames(const std::string& who, const MakeScene& make_scene) {
    const Eigen::Vector3d to_eye(0.5, -1.0, 0.7);
    Html frames;
    for (const bool is_open : {true, false}) {
      const Scene scene = make_scene(is_open);
      const Camera camera =
          FrameScenes({scene}, to_eye, static_cast<double>(kTransferWidth) / kTransferHeight);
      const std::string text = who + (is_open ? ", widest opening" : ", contact");
      const std::string picture = EncodeWebp(renderer_.Render(scene, camera));
      frames += Element("figure", {},
                        Element("img", {{"src", MakeDataUri("image/webp", picture)},
                                        {"width", std::to_string(kTransferWidth)},
                                        {"height", std::to_string(kTransferHeight)},
                                        {"alt", text}}) +
                            Element("figcaption", {}, text));
    }
    return frames;
  }

  const TransferFile& file_;
  SessionInputs inputs_;
  Renderer renderer_;
};

/** Plots medians with ranges. */
Html DrawLags(const std::vector<TransferLags>& lags) {
  IntervalPlot plot;
  plot.text.title = "Contact times after the first contact";
  plot.text.description =
      "Of each digit of each hand: people, transferred, played and standard grasps, medians with "
      "quartiles.";
  plot.axis = "time after the first contact [ms]";
  std::string hand;
  for (const TransferLags& digit : lags) {
    if (digit.hand != hand) plot.AddHeading(digit.hand);
    hand = digit.hand;
    const std::pair<const char*, const std::vector<double>*> sides[] = {
        {"people", &digit.person},
        {"transferred", &digit.transferred},
        {"played", &digit.played},
        {"standard", &digit.standard}};
    int series = 0;
    for (const auto& [name, values] : sides) {
      if (!values->empty()) {
        const Spread spread = CalcSpread(*values);
        plot.rows.push_back({digit.digit + ", " + name, MsFromS(spread.median),
                             MsFromS(spread.lowest), MsFromS(spread.highest),
                             FormatFixed(MsFromS(spread.median), 0) + " ms"});
        plot.rows.back().series = series;
      }
      ++series;
    }
  }
  return MakeFigure(
      plot.text.title + ": people, transferred, played and standard grasps, medians with ranges.",
      "digits that touch much later than the person's.",
      MakeScroll(plot.text.title, DrawIntervalPlot(plot)));
}

/** Tabulates the loads, or states how to obtain them. */
Html DrawLoads(const std::vector<TransferSummary>& hands) {
  const bool has_any = std::any_of(hands.begin(), hands.end(), [](const TransferSummary& summary) {
    return !std::isnan(summary.loads.threshold) || !std::isnan(summary.loads.breaking_force);
  });
  if (!has_any) {
    return MakeParagraph(
        "None in this session: graspbench threshold DIR finds the smallest grip with which each "
        "draw succeeds, graspbench judge DIR the load at which a held grasp breaks.");
  }
  return MakeTable("Medians over the trials of transferred, played, rehearsed and standard grasps.",
                   ShowTable(ListTransferLoadColumns(), hands));
}

Html DrawReasons(const TransferFile& file, const std::vector<std::string>& hands) {
  Table table(
      "Grasps that a hand cannot take over, with the reason; numbers are those of the first.",
      {"Hand", "Reason", "Grasps"});
  bool has_any = false;
  for (const std::string& hand : hands) {
    for (const auto& [reason, count] : CountTransferReasons(file, hand)) {
      table.AddRow({hand, reason, count});
      has_any = true;
    }
  }
  return has_any ? table.ToHtml() : MakeParagraph("Every grasp is transferable to every hand.");
}

/** Grasps along the person's course; or how to have them. */
Html DrawPlayed(const TransferFile& file, const std::vector<TransferSummary>& hands) {
  Table reasons(
      "Grasps whose course the hand cannot follow, with the reason; numbers are those of "
      "the first.",
      {"Hand", "Reason", "Grasps"});
  bool has_played = false, has_reason = false;
  for (const TransferSummary& summary : hands) {
    has_played = has_played || summary.played.finished > 0;
    for (const auto& [reason, count] :
         CountTransferReasons(file, summary.hand, &TransferRow::not_played)) {
      reasons.AddRow({summary.hand, reason, count});
      has_reason = true;
    }
  }
  if (!has_played && !has_reason) {
    return MakeParagraph("None in this session: graspbench transfer --play adds them.");
  }
  return MakeParagraph(
             "The same grasps with the person's reach: the hand follows the midpoint of thumb and "
             "fingers, each digit its own opening, in the person's time until the last contact. "
             "The hand does not turn.") +
         MakeTable("Success with 95 % interval, and its change by playing on the same draws.",
                   ShowTable(ListPlayedColumns(), hands)) +
         (has_reason ? reasons.ToHtml() : Html());
}

}  // namespace

bool IsTransfer(const Session& session) {
  std::error_code status;
  return std::filesystem::exists(session.folder / kTransferPath, status);
}

std::string MakeTransferPage(const Session& session) {
  const TransferFile file = LoadTransferFile(session.folder);
  std::vector<TransferSummary> all, by_object, by_type;
  for (const TransferSummary& summary : SummariseTransfers(file, session)) {
    (!summary.object.empty() ? by_object
     : !summary.type.empty() ? by_type
                             : all)
        .push_back(summary);
  }
  std::vector<std::string> hands;
  for (const TransferSummary& summary : all) hands.push_back(summary.hand);
  const auto section = [](const char* anchor, const char* title, const Html& content) {
    return Element("section", {{"id", anchor}}, Element("h2", {}, title) + content);
  };
  Html body;
  for (const std::string& doubt : file.doubts) {
    body += MakeNote("warning", "Doubt", MakeParagraph(doubt));
  }
  body += section(
      "hands", "Hands",
      MakeParagraph(
          "How far each hand can put its pads where people's digits touched, and what such grasps "
          "lift. Success: with 95 % interval (Wilson). Points: difference of success on the same "
          "draws, with 95 % interval over objects.") +
          MakeTable("People's grasps on each hand.", ShowTable(ListTransferColumns(), all)));
  body += section("objects", "Objects",
                  MakeTable("The same by object.", ShowTable(ListTransferColumns(), by_object)));
  body += section("types", "Grasp types",
                  MakeTable("Transferred grasps by the type of the standard grasp that they go "
                            "towards.",
                            ShowTable(ListTransferColumns(), by_type)));
  body += section("loads", "Grip thresholds and breaking loads", DrawLoads(all));
  body += section("played", "Played reaches", DrawPlayed(file, all));
  body += section("times", "Contact times", DrawLags(ListTransferLags(file, session)));
  body += section("digits", "Digits",
                  MakeTable("Pads of transferred grasps beside the contacts of the digits that "
                            "they stand for.",
                            ShowTable(ListTransferDigitColumns(), ListTransferDigits(file))));
  body += section("reasons", "Not transferable", DrawReasons(file, hands));
  Html pictures;
  try {
    pictures = MakeFigure(
        "A person's hand and the hands that take its grasp over, at the widest opening and at "
        "contact, one grasp of each object.",
        "pads where the person's digits are.", TransferFilm(session, file).Draw());
  } catch (const Error& error) {
    pictures = MakeNote("warning", "There are no pictures", MakeParagraph(error.what()));
  }
  body += section("pictures", "Pictures", pictures);
  body += section(
      "methods", "Methods",
      MakeParagraph(
          std::string(
              "A person's contact is the point of the object's surface nearest to the digit's "
              "marker after the last digit touched. Pads are placed there by least squares over "
              "the hand's pose and joints, within limits and couplings and clear of object and "
              "table; joints that the pads leave open go to the hand's standard grasp. The "
              "pre-grasp has the person's widest opening. A grasp is not transferable when no two "
              "opposing pads come within 5 mm or the hand would start inside something. Standard "
              "grasps are the session's \"best\", rehearsed ones those of imagined trials on "
              "other draws. Proposed by graspbench ") +
          program_version() + "."));
  PageFrame frame = {"People's grasps on robot hands",
                     file.study + ", " + FormatCount(static_cast<int>(hands.size()), "hand")};
  frame.commands = {"graspbench report DIR"};
  frame.facts = {{"Seed", std::to_string(session.config.seed)},
                 {"Trials", std::to_string(session.records.size())}};
  return MakePage(frame,
                  {{"hands", "Hands"},
                   {"objects", "Objects"},
                   {"types", "Grasp types"},
                   {"loads", "Loads"},
                   {"played", "Played reaches"},
                   {"times", "Contact times"},
                   {"digits", "Digits"},
                   {"reasons", "Not transferable"},
                   {"pictures", "Pictures"},
                   {"methods", "Methods"}},
                  body);
}

}  // namespace graspbench
