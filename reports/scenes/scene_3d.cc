#include "reports/scenes/scene_3d.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/base/text/text.h"
#include "core/base/units.h"
#include "core/render/contact_marks.h"
#include "core/render/hand_scene.h"
#include "core/shape/primitives.h"
#include "datasets/gltf/trial_gltf.h"
#include "datasets/records/trace_table.h"
#include "reports/page/assets.h"
#include "reports/page/layout.h"
#include "reports/plots/trial_plots.h"
#include "reports/scenes/cell_pictures.h"
#include "reports/scenes/instant_scene.h"

namespace graspbench {
namespace {

constexpr int kPosterWidth = 640, kPosterHeight = 480;
constexpr int kFilmWidth = 360, kFilmHeight = 270;  // drawing these many pictures takes most of a
                                                    // page's time
constexpr double kInPicture = 0.35;  // largest distance from the hand's base; an object beyond it
                                     // is left out [m]

/** Returns the instant to show. It is the start of the failure, the end of stabilisation before
lift-off for a success, or else the last instant. */
const TraceInstant& FindShownInstant(const TracedTrial& traced,
                                     const std::vector<const TraceInstant*>& ends) {
  const std::optional<Diagnosis>& diagnosis = traced.result.diagnosis;
  if (diagnosis && std::isfinite(diagnosis->time)) {
    const TraceInstant* shown = &traced.trace.front();
    for (const TraceInstant& instant : traced.trace) {
      if (instant.time <= diagnosis->time + 1e-9) shown = &instant;
    }
    return *shown;
  }
  for (const TraceInstant* end : ends) {
    if (end->phase == Phase::kStabilisation && end != ends.back()) return *end;
  }
  return *ends.back();
}

/** Lists the touching links of the part that the failure mechanism names. */
std::vector<int> FindFailedLinks(const TrialView& view, const TraceInstant& shown) {
  const std::optional<Diagnosis>& diagnosis = view.traced.result.diagnosis;
  if (!diagnosis) return {};
  std::vector<int> links;
  for (const HandContact& contact : shown.contacts) {
    const int digit = view.hand->FindDigitOfLink(contact.link);
    const std::string part = digit < 0 ? "palm" : view.hand->digits[static_cast<size_t>(digit)].id;
    if (part == diagnosis->part) links.push_back(contact.link);
  }
  return links;
}

std::string FormatLinks(const std::vector<int>& links) {
  return fmt::format("{}", fmt::join(links, " "));
}

Camera PlaceViewCamera(const TrialView& view, const std::vector<const TraceInstant*>& ends) {
  std::vector<Scene> scenes;
  for (const TraceInstant* end : ends) {
    Scene scene;
    AddHand(view.hand, end->q, end->X_WH, &scene);
    if ((end->X_WO.translation() - end->X_WH.translation()).norm() < kInPicture) {
      AddObject(view.object, end->X_WO, &scene);
    }
    scenes.push_back(std::move(scene));
  }
  return FrameScenes(scenes, FindGraspView(*view.hand, ends[0]->q, ends[0]->X_WH),
                     static_cast<double>(kPosterWidth) / kPosterHeight);
}

std::string FormatCamera(const Camera& camera) {
  std::string text;
  for (const Eigen::Vector3d& point : {camera.p_WEye, camera.p_WTarget}) {
    for (double part : point) text += FormatFixed(part, 4) + " ";
  }
  return text + FormatFixed(camera.field_of_view, 4);
}

/** Tabulates the numbers behind the scene at the end of each phase. */
Html DrawPhaseTable(const TrialView& view, const std::vector<const TraceInstant*>& ends) {
  std::vector<Column> columns = {
      "End of", "Time [s]", "Contacts", {"Grip [N]", "sum of the hand's normal forces"}};
  for (const Digit& digit : view.hand->digits) {
    columns.push_back({digit.name + " [N]", "its normal forces on the object"});
  }
  columns.push_back({"Lifted [mm]", "rise of the object since the start"});
  Table table("The trial at the end of each phase.", columns);
  const double start = view.traced.trace.front().X_WO.translation().z();
  for (const TraceInstant* end : ends) {
    const auto number = [](double value, int decimals) {
      return Text(FormatFixed(value, decimals));
    };
    std::vector<Cell> cells = {NameOf(end->phase), number(end->time, 3), end->contacts.size(),
                               number(end->grip_force, 2)};
    for (size_t d = 0; d < view.hand->digits.size(); ++d) {
      cells.push_back(number(CalcDigitForce(*view.hand, *end, static_cast<int>(d)), 2));
    }
    cells.push_back(number(MmFromM(end->X_WO.translation().z() - start), 1));
    table.AddRow(cells);
  }
  return table.ToHtml();
}

/** Makes a data block, which no browser executes. */
Html MakeDataBlock(const std::string& anchor, const std::string& bytes) {
  return Element("script", {{"type", "model/gltf-binary;base64"}, {"id", anchor}},
                 EncodeBase64(bytes));
}

bool CanBeDrawn(const TrialView& view) {
  return std::all_of(view.traced.trace.begin(), view.traced.trace.end(),
                     [](const TraceInstant& instant) {
                       return instant.X_WH.matrix().allFinite() &&
                              instant.X_WO.matrix().allFinite() && instant.q.allFinite();
                     });
}

}  // namespace

std::string TrialViews::FindOrAddModel(const std::string& hash, const char* kind,
                                       const std::function<std::string()>& make_glb) {
  std::string& anchor = anchor_of_model_[kind + hash];
  if (anchor.empty()) {
    anchor = "model-" + std::to_string(anchor_of_model_.size());
    models_ += MakeDataBlock(anchor, make_glb());
  }
  return anchor;
}

Html TrialViews::DrawWherePossible(const std::function<Html()>& draw) {
  if (!can_draw_) return {};
  try {
    return draw();
  } catch (const Error& fault) {
    if (fault.kind() != ErrorKind::kEnvironment) throw;
    can_draw_ = false;  // the page's pictures give the reason
    return {};
  }
}

Html TrialViews::DrawPoster(const TrialView& view, const TraceInstant& shown,
                            const Camera& camera) {
  if (!renderer_) renderer_ = std::make_unique<Renderer>(kPosterWidth, kPosterHeight);
  Scene scene = MakeGraspScene(view.hand, shown.q, shown.X_WH, view.object, shown.X_WO);
  AddArm(view.traced.arm.get(), shown.q_arm, false, &scene);
  const std::vector<int> failed = FindFailedLinks(view, shown);
  std::vector<ContactMark> marks = MakeContactMarks(shown);
  for (size_t i = 0; i < marks.size(); ++i) {
    marks[i].has_failed =
        std::find(failed.begin(), failed.end(), shown.contacts[i].link) != failed.end();
  }
  AddContactMarks(marks, FindArrowScale(view.traced), &scene);
  return Element(
      "img",
      {{"src", MakeDataUri("image/webp", EncodeWebp(renderer_->Render(scene, camera)))},
       {"width", std::to_string(kPosterWidth)},
       {"height", std::to_string(kPosterHeight)},
       {"alt", view.name + " at " + FormatFixed(shown.time, 3) + " s, " + NameOf(shown.phase)}});
}

/** Draws the first instant (not with an arm), the end of each phase, and the forces that the
contacts of the shown instant can resist. */
Html TrialViews::DrawFilm(const TrialView& view, const std::vector<const TraceInstant*>& ends,
                          const TraceInstant& shown, const Camera& camera) {
  if (!film_renderer_) film_renderer_ = std::make_unique<Renderer>(kFilmWidth, kFilmHeight);
  std::vector<const TraceInstant*> instants;
  // With an arm the trial starts far from the object.
  if (!view.traced.arm) instants.push_back(&view.traced.trace.front());
  instants.insert(instants.end(), ends.begin(), ends.end());
  const std::vector<std::string> pictures = RenderInstants(instants, FindArrowScale(view.traced),
                                                           view.hand, view.object, *film_renderer_);
  Html frames;
  const auto add = [&](const std::string& webp, const std::string& caption) {
    frames += Element("figure", {},
                      Element("img", {{"src", MakeDataUri("image/webp", webp)},
                                      {"width", std::to_string(kFilmWidth)},
                                      {"height", std::to_string(kFilmHeight)},
                                      {"alt", view.name + ": " + caption}}) +
                          Element("figcaption", {}, caption));
  };
  for (size_t i = 0; i < pictures.size(); ++i) {
    const std::string phase = i == 0 && !view.traced.arm
                                  ? Capitalise(NameOf(Phase::kPreGrasp))
                                  : std::string("End of ") + NameOf(instants[i]->phase);
    add(pictures[i], phase + ", " + FormatFixed(instants[i]->time, 3) + " s");
  }
  if (const std::optional<Scene> space = MakeForceSpaceScene(shown.contacts)) {
    Scene room;
    room.drawables.emplace_back();
    room.drawables.back().mesh = std::make_shared<const TriMesh>(MakeSphere(kForceSpaceRadius, 16));
    const Camera same_side = FrameScenes({room}, camera.p_WEye - camera.p_WTarget,
                                         static_cast<double>(kFilmWidth) / kFilmHeight);
    add(EncodeWebp(film_renderer_->Render(*space, same_side)),
        "Forces of the contacts at " + FormatFixed(shown.time, 3) + " s can resist");
  }
  return MakeFigure(
      "The phases of " + view.name + ". " + kContactLegend +
          " The last picture, if present, is the force part of the wrench space for a total normal "
          "force of 1 N, seen from the same side; the dot is the origin.",
      "arrows inside their cones; an origin well inside the last shape: the grasp resists forces "
      "in every direction.",
      Element("div", {{"class", "film"}}, frames));
}

Html TrialViews::Add(const TrialView& view) {
  if (view.traced.trace.empty() || !CanBeDrawn(view)) {
    return Element("p", {{"class", "missing"}, {"id", view.anchor}},
                   view.name + ": there is no motion to show.");
  }
  const std::vector<const TraceInstant*> ends = ListPhaseEnds(view.traced.trace);
  const TraceInstant& shown = FindShownInstant(view.traced, ends);
  const Camera camera = PlaceViewCamera(view, ends);
  const std::string motion = view.anchor + "-motion";
  const MountedArm* arm = view.traced.arm.get();
  const std::string hand =
      FindOrAddModel(view.hand->content_hash + view.hand->id + (arm ? arm->arm->content_hash : ""),
                     "hand ", [&] { return MakeHandGlb(*view.hand, arm); });
  const std::string object = FindOrAddModel(view.object->content_hash + view.object->id, "object ",
                                            [&] { return MakeObjectGlb(*view.object); });
  const Html poster = DrawWherePossible([&] { return DrawPoster(view, shown, camera); });
  const Html film = DrawWherePossible([&] { return DrawFilm(view, ends, shown, camera); });
  Html plots;
  for (const Html& plot : DrawTrialPlots(*view.hand, view.traced, view.name)) {
    plots += Element("div", {}, MakeScroll("Curves of " + view.name, plot));
  }
  return Element(
      "div",
      {{"class", "scene-3d"},
       {"id", view.anchor},
       {"data-label", "3-D scene of " + view.name},
       {"data-hand", hand},
       {"data-object", object},
       {"data-motion", motion},
       {"data-camera", FormatCamera(camera)},
       {"data-failed", FormatLinks(FindFailedLinks(view, shown))},
       {"data-time", FormatFixed(shown.time, 4)}},
      Element("div", {{"class", "stage"}}, poster) +
          MakeScroll("Phases of " + view.name, DrawPhaseStrip(view.traced, view.name)) +
          MakeFigure("Forces and joints over the trial. Dashed lines: the phases. With scripts "
                     "enabled, a click on a curve or a phase moves the 3-D scene to that time.",
                     "forces that decrease before lift-off; a digit without force; joints that "
                     "keep closing while the object is held.",
                     Element("div", {{"class", "plots"}}, plots)) +
          film + DrawPhaseTable(view, ends) +
          MakeDataBlock(motion, MakeMotionGlb(*view.hand, *view.object, view.traced)));
}

Html TrialViews::MakeModels() const {
  if (models_.empty()) return {};
  return models_ +
         MakeDetails("Licence of the 3-D view", Element("pre", {}, Text(assets::kThreeLicence)));
}

PageScript TrialViews::MakeScript() const {
  if (models_.empty()) return {};
  return {std::string(assets::kSceneStyle), std::string(assets::kSceneScript)};
}

}  // namespace graspbench
