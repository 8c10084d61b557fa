#pragma once
/** @file
Camera views in words: "front", "free AZIMUTH ELEVATION [ZOOM]". */

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/base/pose.h"
#include "core/base/units.h"
#include "core/hand/hand.h"
#include "core/render/contact_marks.h"
#include "core/render/scene.h"
#include "core/shape/grasp_object.h"

namespace graspbench {

struct MountedArm;

/** A named view. Without angles, it looks across thumb and fingers and moves with the hand. */
struct SceneView {
  std::string name = "grasp";
  double azimuth_deg = kUnset;    ///< of the camera about z, from x
  double elevation_deg = kUnset;  ///< above the table
  double zoom = 1.0;              ///< 2: half the distance
};

std::vector<std::string> ListSceneViews();

/** Parses a view; no words: the grasp's own. @param help  where messages refer for more: "help
view".
@throws Error(kUsage) with suggestions, or naming the number and its range. */
SceneView ParseSceneView(const std::vector<std::string>& words, const std::string& help);

/** Places a camera that shows all of the scenes, in the given view of the given hand posture.
@param arm  which the view without angles sees from the side; null: that view is of the grasp. */
Camera PlaceCamera(const SceneView& view, const std::vector<Scene>& scenes, const Hand& hand,
                   const Eigen::VectorXd& q, const Pose& X_WH, const MountedArm* arm,
                   double aspect);

/** A video of a hand and an object, from one camera that shows the whole motion. */
class SceneFilm {
 public:
  SceneFilm(std::shared_ptr<const Hand> hand, std::shared_ptr<const GraspObject> object)
      : hand_(std::move(hand)), object_(std::move(object)) {}

  /** Adds a frame. @param time  of the frame, later than those before [s].
  @param arm  that carries the hand and is shown whole; null: none.
  @param q_arm  its posture [rad]. */
  void Add(double time, const Eigen::VectorXd& q, const Pose& X_WH, const Pose& X_WO,
           const MountedArm* arm = nullptr, const Eigen::VectorXd& q_arm = {});
  /** Draws contacts in the last frame. @param length_per_force  of arrows [m/N]. */
  void Mark(const std::vector<ContactMark>& contacts, double length_per_force);

  size_t size() const { return frames_.size(); }
  /** Encodes an animated WebP file in real time. `tell` is called with the number of frames drawn
  and returns false to stop. @returns empty when stopped. @throws Error(kEnvironment) when the
  machine cannot draw. */
  std::string Encode(const SceneView& view, int width, int height,
                     const std::function<bool(size_t num_drawn)>& tell) const;

 private:
  struct Frame {
    Scene scene;
    double time = 0.0;  // [s]
  };
  std::shared_ptr<const Hand> hand_;
  std::shared_ptr<const GraspObject> object_;
  std::vector<Frame> frames_;
  Eigen::VectorXd q_;  // in the first frame; with an arm, in the last
  Pose X_WH_ = Pose::Identity();
  const MountedArm* arm_ = nullptr;
};

}  // namespace graspbench
