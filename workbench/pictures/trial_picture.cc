#include "workbench/pictures/trial_picture.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/base/error.h"
#include "core/base/text/text.h"
#include "core/hand/hand.h"
#include "core/render/contact_marks.h"
#include "core/render/hand_scene.h"
#include "core/trial/trial_result.h"
#include "reports/scenes/instant_scene.h"
#include "workbench/pictures/scene_view.h"
#include "workbench/terminal/command_line.h"

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

std::string DescribeHandPicture(const HandPictureParts& parts) {
  std::string told = "left: the hand's surface";
  if (parts.has_shapes) {
    told +=
        "; then the surface with the collision shapes; then the shapes alone (balls: blue on pads, "
        "orange on other links; grey: capsules for self contact)";
  }
  if (parts.has_axes) {
    told += "; right: joint axes (red: driven, blue: coupled)";
  }
  return told + "\n";
}

Image DrawHand(const std::shared_ptr<const Hand>& hand, const HandPictureParts& parts) {
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
  Scene axes, pictures_and_axes = pictures;
  axes.has_table = false;
  AddJointAxes(*hand, q, X_WH, &axes);
  AddJointAxes(*hand, q, X_WH, &pictures_and_axes);

  Renderer renderer(kSide, kSide);
  Image whole;
  whole.width = (1 + 2 * parts.has_shapes + parts.has_axes) * kSide;
  whole.height = 2 * kSide;
  whole.rgb.resize(static_cast<size_t>(3 * whole.width * whole.height));
  const Vector3d to_eyes[] = {{0.25, -1.0, 0.2}, {1.0, -0.15, 0.2}};
  for (int row = 0; row < 2; ++row) {
    const Camera camera = FrameScenes({pictures, shapes}, to_eyes[row], 1.0);
    const Image seen = renderer.Render(pictures, camera);
    int column = 0;
    Paste(seen, column++, row, whole);
    if (parts.has_shapes) {
      const Image touched = renderer.Render(shapes, camera);
      Paste(Blend(seen, touched), column++, row, whole);
      Paste(touched, column++, row, whole);
    }
    if (parts.has_axes) {  // full arrows in half links
      const Image arrows = renderer.Render(axes, camera);
      Paste(Blend(renderer.Render(pictures_and_axes, camera), arrows), column, row, whole);
    }
  }
  return whole;
}

namespace {

constexpr double kLatestInstant = 3600.0;    // [s]
constexpr double kTraceFilmInterval = 0.05;  // [s]

std::vector<std::string> ListInstantNames() {
  std::vector<std::string> names;
  for (const PhaseRow& row : kPhases) {
    if (row.value != Phase::kDone) names.emplace_back(row.name);
  }
  for (const MomentRow& row : kMoments) names.emplace_back(row.name);
  return names;
}

/** The last instant of a phase; null when the trial did not get there. The pre-grasp is shown at the
object, as in the report. */
const TraceInstant* FindEndOf(Phase phase, const std::vector<TraceInstant>& trace) {
  if (phase == Phase::kPreGrasp) phase = Phase::kPlacing;
  const TraceInstant* last = nullptr;
  for (const TraceInstant& instant : trace) {
    if (instant.phase == phase) last = &instant;
  }
  return last;
}

std::string FindDefaultInstant(const TracedTrial& traced) {
  const bool was_closed =
      std::any_of(traced.trace.begin(), traced.trace.end(),
                  [](const TraceInstant& instant) { return instant.phase == Phase::kLiftOff; });
  return NameOf(was_closed ? Phase::kStabilisation : traced.trace.back().phase);
}

/** A time since the start of placing [s], or with NaN the end of a phase. */
struct WantedInstant {
  double time = kUnset;
  Phase phase = Phase::kDone;
};

WantedInstant ParseInstantName(const std::string& name) {
  const std::string wanted = ToLower(name);
  if (std::isdigit(static_cast<unsigned char>(wanted[0])) || wanted[0] == '.') {
    return {ParseNumber(wanted, "the time", "s", 0.0, kLatestInstant)};
  }
  for (const PhaseRow& row : kPhases) {
    if (wanted == row.name && row.value != Phase::kDone) return {kUnset, row.value};
  }
  for (const MomentRow& row : kMoments) {
    if (wanted == row.name) return {kUnset, row.phase};
  }
  throw Error(ErrorKind::kUsage,
              "\"" + name + "\" is not an instant of a trial; expected a time such as " +
                  "1.25s, or the end of a phase" + SuggestNames(wanted, ListInstantNames()));
}

void DemandCourse(const TracedTrial& traced) {
  if (!traced.trace.empty()) return;
  throw Error(ErrorKind::kUnsupported,
              "nothing can be drawn because the trial could not begin: " + traced.result.reason);
}

}  // namespace

void CheckInstantName(const std::string& name) {
  if (!name.empty()) ParseInstantName(name);
}

const TraceInstant& FindNamedInstant(const TracedTrial& traced, const std::string& name) {
  DemandCourse(traced);
  const WantedInstant wanted = ParseInstantName(name.empty() ? FindDefaultInstant(traced) : name);
  if (!std::isnan(wanted.time)) {
    const double end = traced.trace.back().time;
    if (wanted.time > end) {
      throw Error(ErrorKind::kUsage,
                  "the trial ended at " + FormatFixed(end, 3) + " s, before " + name);
    }
    return FindInstant(traced.trace, wanted.time);
  }
  if (const TraceInstant* found = FindEndOf(wanted.phase, traced.trace)) return *found;
  throw Error(ErrorKind::kUsage, "the trial ended before its " + std::string(NameOf(wanted.phase)) +
                                     ": " + NameOf(traced.result.outcome) + ", " +
                                     traced.result.reason);
}

PictureSize ParsePictureSize(const std::string& text) {
  constexpr int kMaxSide = 4096;
  PictureSize size;
  int end = 0;
  const bool is_one =
      std::sscanf(text.c_str(), "%4dx%4d%n", &size.width, &size.height, &end) == 2 &&
      static_cast<size_t>(end) == text.size();
  const bool fits =
      size.width > 0 && size.height > 0 && size.width <= kMaxSide && size.height <= kMaxSide;
  if (is_one && fits) return size;
  throw Error(ErrorKind::kUsage, "--size: \"" + text + "\"; expected WIDTHxHEIGHT of 1 to " +
                                     std::to_string(kMaxSide) + " pixels, e.g. 960x720");
}

Image DrawTrial(const TrialSetup& setup, const TracedTrial& traced, const TraceInstant& instant,
                const SceneView& view, const PictureSize& size) {
  const bool is_far = instant.phase == Phase::kPreGrasp;  // of the object, in the gross motion
  const MountedArm* arm = traced.arm.get();
  Scene scene = MakeGraspScene(setup.hand, instant.q, instant.X_WH, setup.object, instant.X_WO);
  AddArm(arm, instant.q_arm, is_far, &scene);
  const Camera camera =
      PlaceCamera(view, {scene}, *setup.hand, instant.q, instant.X_WH, is_far ? arm : nullptr,
                  static_cast<double>(size.width) / size.height);
  AddContactMarks(MakeContactMarks(instant), FindArrowScale(traced), &scene);
  CompileShadersQuickly();
  return Renderer(size.width, size.height).Render(scene, camera);
}

std::string FilmTrial(const TrialSetup& setup, const TracedTrial& traced, const SceneView& view,
                      const PictureSize& size) {
  DemandCourse(traced);
  const double scale = FindArrowScale(traced);
  SceneFilm film(setup.hand, setup.object);
  double next = 0.0;
  for (const TraceInstant& instant : traced.trace) {
    if (instant.time < next - 1e-9 && &instant != &traced.trace.back()) continue;
    next = instant.time + kTraceFilmInterval;
    film.Add(instant.time, instant.q, instant.X_WH, instant.X_WO, traced.arm.get(), instant.q_arm);
    film.Mark(MakeContactMarks(instant), scale);
  }
  return film.Encode(view, size.width, size.height, [](size_t) { return true; });
}

}  // namespace graspbench
