#include "workbench/pictures/scene_film.h"

#include "core/render/animation.h"
#include "core/render/hand_scene.h"

namespace graspbench {
namespace {

constexpr double kReach = 0.35;       // what is farther from the hand does not shrink a film [m]
constexpr double kLastPicture = 1.0;  // is shown so long [s]

}  // namespace

void SceneFilm::Add(double time, const Eigen::VectorXd& q, const Pose& X_WH, const Pose& X_WO) {
  if (frames_.empty()) {
    q_ = q;
    X_WH_ = X_WH;
  }
  Scene scene = MakeGraspScene(hand_, q, X_WH, object_, X_WO);
  Drawable& object = scene.drawables.back();
  const Pose& X_WRoot = scene.drawables.front().X_WM;
  object.must_be_seen = (X_WO.translation() - X_WRoot.translation()).norm() < kReach;
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
      PlaceCamera(view, scenes, *hand_, q_, X_WH_, static_cast<double>(width) / height);
  Renderer renderer(width, height);
  AnimatedWebp film(width, height);
  for (size_t i = 0; i < frames_.size(); ++i) {
    film.Add(renderer.Render(frames_[i].scene, camera), frames_[i].time - frames_[0].time);
    if (!tell(i + 1)) return {};
  }
  return film.Finish(frames_.back().time - frames_[0].time + kLastPicture);
}

}  // namespace graspbench
