#include "workbench/pictures/scene_view.h"

#include <cmath>

#include "core/base/error.h"
#include "core/base/text/text.h"
#include "core/render/hand_scene.h"
#include "core/render/scene.h"
#include "workbench/terminal/command_line.h"

namespace graspbench {

namespace {

constexpr double kReach = 0.35;       // what is farther from the hand does not shrink a film [m]
constexpr double kLastPicture = 1.0;  // is shown so long [s]

}  // namespace

void SceneFilm::Add(double time, const Eigen::VectorXd& q, const Pose& X_WH, const Pose& X_WO,
                    const MountedArm* arm, const Eigen::VectorXd& q_arm) {
  if (frames_.empty() || arm) {
    q_ = q;
    X_WH_ = X_WH;
    arm_ = arm;
  }
  Scene scene = MakeGraspScene(hand_, q, X_WH, object_, X_WO);
  const size_t object = scene.drawables.size() - 1;
  AddArm(arm, q_arm, true, &scene);
  const Pose& X_WRoot = scene.drawables.front().X_WM;
  const double reach = kReach + (arm ? CalcArmReach(*arm->arm) : 0.0);
  scene.drawables[object].must_be_seen =
      (X_WO.translation() - X_WRoot.translation()).norm() < reach;
  frames_.push_back({std::move(scene), time});
}

void SceneFilm::Mark(const std::vector<ContactMark>& contacts, double length_per_force) {
  AddContactMarks(contacts, length_per_force, &frames_.back().scene);
}

std::string SceneFilm::Encode(const SceneView& view, int width, int height,
                              const std::function<bool(size_t num_drawn)>& tell) const {
  std::vector<Scene> scenes;
  for (const Frame& frame : frames_) scenes.push_back(frame.scene);
  const Camera camera =
      PlaceCamera(view, scenes, *hand_, q_, X_WH_, arm_, static_cast<double>(width) / height);
  Renderer renderer(width, height);
  AnimatedWebp film(width, height);
  for (size_t i = 0; i < frames_.size(); ++i) {
    film.Add(renderer.Render(frames_[i].scene, camera), frames_[i].time - frames_[0].time);
    if (!tell(i + 1)) return {};
  }
  return film.Finish(frames_.back().time - frames_[0].time + kLastPicture);
}

namespace {

struct NamedView {
  const char* name;
  double azimuth_deg, elevation_deg;
};
constexpr NamedView kViews[] = {{"front", -90.0, 15.0},
                                {"back", 90.0, 15.0},
                                {"left", 180.0, 15.0},
                                {"right", 0.0, 15.0},
                                {"top", -90.0, 90.0}};

SceneView FindNamedView(const std::string& name) {
  if (name == "grasp") return {};
  for (const NamedView& view : kViews) {
    if (name == view.name) return {name, view.azimuth_deg, view.elevation_deg, 1.0};
  }
  throw Error(ErrorKind::kUsage,
              "\"" + name + "\" is not a view" + SuggestNames(name, ListSceneViews()));
}

Eigen::Vector3d FindDirection(const SceneView& view, const Hand& hand, const Eigen::VectorXd& q,
                              const Pose& X_WH, const MountedArm* arm) {
  if (std::isnan(view.azimuth_deg)) {
    return arm ? FindArmView(*arm, X_WH) : FindGraspView(hand, q, X_WH);
  }
  const double azimuth = RadFromDeg(view.azimuth_deg), elevation = RadFromDeg(view.elevation_deg);
  return {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
          std::sin(elevation)};
}

}  // namespace

std::vector<std::string> ListSceneViews() {
  std::vector<std::string> names = {"grasp"};
  for (const NamedView& view : kViews) names.emplace_back(view.name);
  names.emplace_back("free");
  return names;
}

SceneView ParseSceneView(const std::vector<std::string>& words, const std::string& help) {
  if (words.empty()) return {};
  if (ToLower(words[0]) != "free") {
    if (words.size() > 1) {
      throw Error(ErrorKind::kUsage, "a named view has no numbers; see: " + help);
    }
    return FindNamedView(ToLower(words[0]));
  }
  if (words.size() < 3 || words.size() > 4) {
    throw Error(ErrorKind::kUsage,
                "free needs azimuth and elevation [deg], and may have a zoom; see: " + help);
  }
  SceneView view;
  view.name = "free";
  view.azimuth_deg = ParseNumber(words[1], "the azimuth", "deg", -360.0, 360.0);
  view.elevation_deg = ParseNumber(words[2], "the elevation", "deg", -89.0, 90.0);
  if (words.size() > 3) view.zoom = ParseNumber(words[3], "the zoom", "", 0.1, 10.0);
  return view;
}

Camera PlaceCamera(const SceneView& view, const std::vector<Scene>& scenes, const Hand& hand,
                   const Eigen::VectorXd& q, const Pose& X_WH, const MountedArm* arm,
                   double aspect) {
  Camera camera = FrameScenes(scenes, FindDirection(view, hand, q, X_WH, arm), aspect);
  camera.p_WEye = camera.p_WTarget + (camera.p_WEye - camera.p_WTarget) / view.zoom;
  return camera;
}

}  // namespace graspbench
