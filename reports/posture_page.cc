#include <algorithm>
#include <cmath>

#include "core/base/text/text.h"
#include "core/base/units.h"
#include "core/develop/development_warnings.h"
#include "core/develop/hand_pads.h"
#include "core/develop/write_grasps.h"
#include "core/grasp/placement.h"
#include "core/render/contact_marks.h"
#include "core/render/hand_scene.h"
#include "reports/kind_pages.h"
#include "reports/page/layout.h"
#include "reports/page/models.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr int kWidth = 480, kHeight = 400;  // size of a picture [px]
constexpr double kArrow = 0.02;             // length of a pad's normal arrow [m]

/** Geometry of the pads in a posture; heights are measured along the approach. */
struct PadStand {
  std::vector<PadState> pads;  // pads of the grasp's digits, the opposing one first
  double opening = 0.0;        // distance from the thumb to the mean of the fingers, across the
                               // approach [m]
  double off_facing = 0.0;     // largest angle between a finger pad's normal and the thumb pad's
                               // facing direction [rad]
  double off_level = 0.0;      // height difference of the highest and lowest pad [m]
  double off_down = 0.0;       // largest angle between a fingertip and the approach [rad]
  double reach = 0.0;          // mean height of the pads beyond the middle of the palm [m]
  double gap = 0.0;            // least distance of pads of neighbouring fingers; 0 for one finger
                               // [m]
};

double CalcAngle(const Vector3d& a, const Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

PadStand CalcStand(const Hand& hand, const Grasp& grasp, const VectorXd& q) {
  const std::vector<Pose> X_HL = CalcLinkPoses(hand, q);
  const Vector3d approach_H = CalcApproachDirection(hand, grasp.tilt);
  const auto opposing = static_cast<size_t>(FindOpposingDigit(hand, grasp));
  PadStand stand;
  stand.pads.push_back(CalcPadState(hand, hand.digits[opposing], X_HL));
  Vector3d p_HFingers = Vector3d::Zero();
  for (size_t d = 0; d < hand.digits.size(); ++d) {
    const bool grasps =
        std::count(grasp.digits.begin(), grasp.digits.end(), hand.digits[d].id) != 0;
    if (!grasps || d == opposing) continue;
    stand.pads.push_back(CalcPadState(hand, hand.digits[d], X_HL));
    p_HFingers += stand.pads.back().p_HPad;
  }
  const size_t num_fingers = stand.pads.size() - 1;
  const PadState& thumb = stand.pads.front();
  Vector3d across = p_HFingers / static_cast<double>(num_fingers) - thumb.p_HPad;
  across -= across.dot(approach_H) * approach_H;
  stand.opening = across.norm();
  double highest = -1.0, lowest = 1.0, sum = 0.0;
  for (size_t i = 0; i < stand.pads.size(); ++i) {
    const PadState& pad = stand.pads[i];
    const double height = (pad.p_HPad - hand.p_HCentre).dot(approach_H);
    highest = std::max(highest, height);
    lowest = std::min(lowest, height);
    sum += height;
    stand.off_down = std::max(stand.off_down, CalcAngle(pad.axis_H, approach_H));
    if (i > 0) stand.off_facing = std::max(stand.off_facing, CalcAngle(-pad.nhat_H, thumb.nhat_H));
    if (i < 2) continue;
    const double gap = (pad.p_HPad - stand.pads[i - 1].p_HPad).norm();
    stand.gap = i == 2 ? gap : std::min(stand.gap, gap);
  }
  stand.off_level = highest - lowest;
  stand.reach = sum / static_cast<double>(stand.pads.size());
  return stand;
}

std::string Mm(double metres) { return FormatFixed(MmFromM(metres), 1); }
std::string Deg(double radians) { return FormatFixed(DegFromRad(radians), 0); }

Html DrawRules(const Hand& hand, const DevelopedGrasp& one) {
  const Grasp &proposed = one.proposed.grasp, &developed = one.grasp;
  const PadStand stands[] = {
      CalcStand(hand, proposed, proposed.q_pre), CalcStand(hand, developed, developed.q_pre),
      CalcStand(hand, proposed, proposed.q_target), CalcStand(hand, developed, developed.q_target)};
  const PostureAim& aim = one.proposed.aim;
  Table table("Pad geometry, rated by the development rules, before and after simulation.",
              {"rule", "aim", "pre-grasp, geometry", "pre-grasp, developed", "target, geometry",
               "target, developed"});
  const auto add = [&](const char* rule, const std::string& asked, double PadStand::*value,
                       std::string (*format)(double)) {
    std::vector<Cell> cells = {rule, asked};
    for (const PadStand& stand : stands) cells.push_back(format(stand.*value));
    table.AddRow(cells);
  };
  add("opening [mm]", "pre-grasp " + Mm(aim.opening) + ", at contact " + Mm(aim.meeting),
      &PadStand::opening, &Mm);
  add("deviation of opposed pads from facing [deg]", "0 at contact", &PadStand::off_facing, &Deg);
  add("height difference of the pads [mm]", "0", &PadStand::off_level, &Mm);
  add("deviation of the fingertips from vertical [deg]", "at most " + Deg(std::acos(aim.tips_down)),
      &PadStand::off_down, &Deg);
  add("pads beyond the palm [mm]", (aim.is_reach_exact ? "" : "at least ") + Mm(aim.reach),
      &PadStand::reach, &Mm);
  if (stands[0].pads.size() > 2) {
    add("smallest distance of neighbouring pads [mm]", Mm(aim.pad_gap), &PadStand::gap, &Mm);
  }
  return table.ToHtml();
}

Html DrawStages(const std::vector<DevelopmentStage>& stages) {
  Table table("Number of simulated shapes and successes.",
              {"stage", "postures on shapes", "trials", "held", "best mean score"});
  for (const DevelopmentStage& stage : stages) {
    table.AddRow({stage.name, stage.num_requests, stage.tally.finished, FormatRate(stage.tally),
                  FormatFixed(stage.best_score, 2)});
  }
  return table.ToHtml();
}

Html DrawJoints(const Hand& hand, const DevelopedGrasp& one) {
  Table table("Driven joints in degrees, of slides in millimetres.",
              {"joint", "pre-grasp, geometry", "pre-grasp, developed", "target, geometry",
               "target, developed"});
  for (const int j : FindGraspJoints(hand, one.grasp.digits)) {
    const HandJoint& joint = hand.joints[static_cast<size_t>(j)];
    std::vector<Cell> cells = {joint.name};
    for (const VectorXd* q : {&one.proposed.grasp.q_pre, &one.grasp.q_pre,
                              &one.proposed.grasp.q_target, &one.grasp.q_target}) {
      cells.push_back(FormatFixed(ToDisplayUnits(joint, (*q)[j]), 1));
    }
    table.AddRow(cells);
  }
  return MakeDetails("Joint positions", table.ToHtml());
}

/** Whether any digit has visual shapes. */
bool HasPictures(const Hand& hand) {
  return std::any_of(hand.visuals.begin(), hand.visuals.end(), [&](const LinkVisual& visual) {
    return hand.FindDigitOfLink(visual.link) >= 0;
  });
}

/** Explains the colours of the hand's pictures. */
std::string DescribeColours(const Hand& hand) {
  return std::string("The hand approaching from above. Red arrows are the normals of the pads. ") +
         (HasPictures(hand)
              ? "The visual shapes of the hand are shown; hand show --shapes draws the contact "
                "shapes."
              : "The description has no visual shapes, so the contact shapes are drawn: balls of "
                "the pads (blue), balls of other links (orange), capsules (grey).");
}

/** Makes a scene of the hand approaching an object from above, with arrows for the pads'
normals. */
Scene MakePostureScene(const std::shared_ptr<const Hand>& hand, const Grasp& grasp,
                       const VectorXd& q, const Pose& X_WH) {
  Scene scene;
  scene.has_table = false;
  AddHand(hand, q, X_WH, &scene);
  if (!HasPictures(*hand)) AddContactShapes(*hand, q, X_WH, &scene);
  for (size_t i = 0; i < hand->visuals.size(); ++i) {  // the palm's shape, too
    if (hand->visuals[i].link == hand->palm_link) scene.drawables[i].must_be_seen = true;
  }
  std::vector<ContactMark> marks;
  for (const PadState& pad : CalcStand(*hand, grasp, q).pads) {
    ContactMark mark;  // an arrow ends at its contact point
    mark.nhat_W = X_WH.linear() * pad.nhat_H;
    mark.p_WC = X_WH * pad.p_HPad + kArrow * mark.nhat_W;
    mark.force_W = mark.nhat_W;
    marks.push_back(mark);
  }
  AddContactMarks(marks, kArrow, &scene);
  return scene;
}

Html DrawPictures(const std::shared_ptr<const Hand>& hand, const Grasp& grasp,
                  const std::string& of, Renderer& renderer) {
  const Vector3d approach_H = CalcApproachDirection(*hand, grasp.tilt);
  const Pose X_WH = MakePose(
      Eigen::Quaterniond::FromTwoVectors(approach_H, -Vector3d::UnitZ()).toRotationMatrix(),
      Vector3d::Zero());
  std::vector<Scene> scenes;
  for (const VectorXd* q : {&grasp.q_pre, &grasp.q_target}) {
    scenes.push_back(MakePostureScene(hand, grasp, *q, X_WH));
  }
  const Camera camera = FrameScenes(scenes, FindGraspView(*hand, grasp.q_target, X_WH),
                                    static_cast<double>(kWidth) / kHeight);
  Html frames;
  for (size_t i = 0; i < scenes.size(); ++i) {
    const std::string name = i == 0 ? "Pre-grasp" : "Target";
    const std::string image = EncodeWebp(renderer.Render(scenes[i], camera));
    frames += Element("figure", {},
                      Element("img", {{"src", MakeDataUri("image/webp", image)},
                                      {"width", std::to_string(kWidth)},
                                      {"height", std::to_string(kHeight)},
                                      {"alt", of + ": " + name}}) +
                          Element("figcaption", {}, name));
  }
  return Element("div", {{"class", "film"}}, frames);
}

Html DrawSummary(const PosturePageData& data) {
  Table table("Developed grasps.", {"grasp", "digits", "trials", "failed numerically",
                                    "score by geometry", "developed", "held-out shapes held"});
  for (size_t i = 0; i < data.developed.size(); ++i) {
    const DevelopedGrasp& one = data.developed[i];
    std::string digits, held = "n/a";
    for (const std::string& id : one.grasp.digits) digits += (digits.empty() ? "" : " ") + id;
    if (i < data.stages.size() && !data.stages[i].empty() &&
        data.stages[i].back().name == "check") {
      held = FormatRate(data.stages[i].back().tally);
    }
    table.AddRow({LinkTo(one.grasp.id, NameOfGrasp(one.grasp.id)), digits, one.num_trials,
                  one.num_numerical_failures, FormatFixed(one.proposed_score, 2),
                  FormatFixed(one.score, 2), held});
  }
  return table.ToHtml();
}

Html DrawWarnings(const Hand& hand, const std::vector<DevelopedGrasp>& developed) {
  std::vector<std::pair<std::string, std::string>> grasps;  // by warning, in order
  for (const DevelopedGrasp& one : developed) {
    for (const std::string& warning : ListDevelopmentWarnings(hand, one)) {
      const auto known = std::find_if(grasps.begin(), grasps.end(),
                                      [&](const auto& each) { return each.second == warning; });
      if (known == grasps.end()) {
        grasps.emplace_back(one.grasp.id, warning);
      } else {
        known->first += ", " + one.grasp.id;
      }
    }
  }
  Html list;
  for (const auto& [ids, warning] : grasps) list += MakeParagraph(ids + ": " + warning + ".");
  return list.empty() ? Html() : MakeNote("warning", "Grasps to check", list);
}

}  // namespace

std::string MakePosturePage(const PosturePageData& data) {
  const Hand& hand = *data.hand;
  std::vector<PageLink> contents = {{"summary", "Summary"}};
  Html body = Element(
      "section", {{"id", "summary"}},
      Element("h2", {}, "Summary") +
          MakeParagraph(
              "Geometric rules proposed postures of each grasp. Simulation on synthetic shapes, "
              "none of them a catalogue object, selected among them (race), varied the best "
              "(search), compared both (finals), and tested the result on held-out shapes (check). "
              "The score is a mean over the trials of the finals: a held shape scores 0.7 to 2.1, "
              "a failed trial at most 0.5. Seed " +
              std::to_string(data.config.seed) + ", budget " + std::to_string(data.config.budget) +
              " trials.") +
          DrawWarnings(hand, data.developed) + DrawSummary(data));
  std::unique_ptr<Renderer> renderer;
  try {
    renderer = std::make_unique<Renderer>(kWidth, kHeight);
  } catch (const Error& error) {
    body += MakeNote("warning", "No pictures", MakeParagraph(error.what()));
  }
  for (size_t i = 0; i < data.developed.size(); ++i) {
    const DevelopedGrasp& one = data.developed[i];
    const std::string name = Capitalise(NameOfGrasp(one.grasp.id));
    contents.push_back({one.grasp.id, name});
    Html section = Element("h2", {}, name);
    section += MakeParagraph(DescribeDevelopment(hand, one));
    if (renderer) {
      section += MakeFigure(
          DescribeColours(hand),
          "opposed pads at one height, and no part of the hand below the fingertips; in the target "
          "posture pads may overlap, because it lies behind the object's surface.",
          DrawPictures(data.hand, one.grasp, name, *renderer));
    }
    section += DrawRules(hand, one);
    if (i < data.stages.size()) section += DrawStages(data.stages[i]);
    section += DrawJoints(hand, one);
    body += Element("section", {{"id", one.grasp.id}}, section);
  }
  PageFrame frame = {"Developed postures", hand.name};
  frame.facts = {{"Seed", std::to_string(data.config.seed)},
                 {"Budget", FormatCount(data.config.budget, "trial")}};
  return MakePage(frame, contents, body);
}

}  // namespace graspbench
