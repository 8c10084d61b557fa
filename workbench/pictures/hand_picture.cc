#include "workbench/pictures/hand_picture.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "core/hand/coupling.h"
#include "core/render/contact_shapes.h"
#include "core/render/hand_scene.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

constexpr int kSide = 480;  // of one picture [pixels]

/** Fingers up, the palm towards -y of the world. */
Pose FindUprightPose(const Hand& hand, const Eigen::VectorXd& q) {
  const std::vector<Pose> X_HL = CalcLinkPoses(hand, q);
  Vector3d up = Vector3d::Zero();
  for (const Digit& digit : hand.digits) {
    const Vector3d p_HTip = X_HL[static_cast<size_t>(digit.distal_link)] * digit.p_LTip;
    if (!digit.is_thumb) up += (p_HTip - hand.p_HCentre).stableNormalized();
  }
  const Vector3d front = hand.palm_normal.normalized();
  up -= up.dot(front) * front;
  if (up.norm() < 0.3) up = front.unitOrthogonal();  // a gripper: its fingers point to the camera
  up.normalize();
  Eigen::Matrix3d R_HW;
  R_HW << up.cross(-front), -front, up;
  return MakePose(R_HW.transpose(), Vector3d::Zero());
}

Image Blend(const Image& a, const Image& b) {
  Image blended = a;
  for (size_t i = 0; i < a.rgb.size(); ++i) {
    blended.rgb[i] = static_cast<uint8_t>((a.rgb[i] + b.rgb[i] + 1) / 2);
  }
  return blended;
}

void Paste(const Image& part, int column, int row, Image& whole) {
  for (int y = 0; y < part.height; ++y) {
    const auto from = part.rgb.begin() + 3 * y * part.width;
    const auto to =
        whole.rgb.begin() + 3 * ((row * part.height + y) * whole.width + column * part.width);
    std::copy(from, from + 3 * part.width, to);
  }
}

}  // namespace

std::string DescribeHandShapes() {
  return "left the hand as it looks, right what of it touches, between them both; balls that "
         "touch: "
         "blue of the pads, orange of other links; grey: capsules that keep links apart\n";
}

Image DrawHandShapes(const std::shared_ptr<const Hand>& hand) {
  Eigen::VectorXd q(hand->num_joints());
  for (int j = 0; j < hand->num_joints(); ++j) {
    const HandJoint& joint = hand->joints[static_cast<size_t>(j)];
    q[j] = std::clamp(0.0, joint.lower, joint.upper);
  }
  ApplyCoupling(*hand, q);
  const Pose X_WH = FindUprightPose(*hand, q);
  Scene pictures, shapes;
  pictures.has_table = shapes.has_table = false;
  AddHand(hand, q, X_WH, &pictures);
  for (Drawable& drawable : pictures.drawables) drawable.must_be_seen = true;  // palm and forearm
  AddContactShapes(*hand, q, X_WH, &shapes);
  if (shapes.drawables.empty()) {
    throw Error(ErrorKind::kUnsupported, "\"" + hand->id + "\" has no collision shapes to draw");
  }

  Renderer renderer(kSide, kSide);
  Image whole;
  whole.width = 3 * kSide;
  whole.height = 2 * kSide;
  whole.rgb.resize(static_cast<size_t>(3 * whole.width * whole.height));
  const Vector3d to_eyes[] = {{0.25, -1.0, 0.2}, {1.0, -0.15, 0.2}};
  for (int row = 0; row < 2; ++row) {
    const Camera camera = FrameScenes({pictures, shapes}, to_eyes[row], 1.0);
    const Image seen = renderer.Render(pictures, camera), touched = renderer.Render(shapes, camera);
    Paste(seen, 0, row, whole);
    Paste(Blend(seen, touched), 1, row, whole);
    Paste(touched, 2, row, whole);
  }
  return whole;
}

}  // namespace graspbench
