// How far off the wrist camera takes the objects to be: 100 poses of each within 40 mm and any turn,
// by the pose they were drawn at. Processor time of a picture and of an estimate. Ends with 1 when
// an object's error is above what is wanted: 1 mm in the median and 3 mm in 95 of 100, and of those
// longer than wide by 15 per cent 1 and 3 degrees, half-turns apart.
//   build/release/tests/bench/vision_bench [HAND [full]]

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <string>

#include "core/base/random.h"
#include "core/base/units.h"
#include "core/grasp/standard_grasp.h"
#include "core/hand/load_hand.h"
#include "core/statistics/summary.h"
#include "core/vision/wrist_camera.h"
#include "objects/catalogue.h"

namespace graspbench {
namespace {

constexpr int kNumPoses = 100;

double ReadProcessorTime() {
  timespec time;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

double TakeQuantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values.empty() ? kUnset : CalcSortedQuantile(values, share);
}

struct Timing {
  std::vector<double> picture_ms, estimate_ms, look_ms;
};

/** One picture and one estimate by themselves. */
void TimeOnce(WristCamera& camera, const OutlineModel& outline, const Eigen::VectorXd& q,
              const Pose& X_WO, Timing& timing) {
  const Pose X_WK = camera.CalcLookPose({});
  const Image empty = camera.TakePicture(camera.MakeScene(X_WK, q, nullptr), X_WK, nullptr);
  const uint64_t seed = 1;
  const double start = ReadProcessorTime();
  const Image picture = camera.TakePicture(camera.MakeScene(X_WK, q, &X_WO), X_WK, &seed);
  const double taken = ReadProcessorTime();
  LocateObject(picture, empty, camera.lens(), X_WK, outline, {});
  timing.picture_ms.push_back(1e3 * (taken - start));
  timing.estimate_ms.push_back(1e3 * (ReadProcessorTime() - taken));
}

bool MeasureObject(const std::shared_ptr<const Hand>& hand, const std::string& id,
                   const CameraConfig& config, Timing& timing) {
  const auto object = LoadObject(id);
  const std::vector<Grasp> grasps = LoadStandardGrasps(*hand);
  WristCamera camera(hand, object, config);
  const OutlineModel outline(object->mesh);
  std::vector<double> shifts_mm, turns_deg;
  int counts[4] = {0, 0, 0, 0};
  RandomStream random(id, "vision bench");
  for (int i = 0; i < kNumPoses; ++i) {
    const PlanarPose pose{random.NextUniform(-0.04, 0.04), random.NextUniform(-0.04, 0.04),
                          random.NextUniform(-kPi, kPi)};
    const Pose X_WO = MakePose(MakeRotationRpy(0.0, 0.0, pose.yaw),
                               Eigen::Vector3d(pose.x, pose.y, outline.middle()));
    const Eigen::VectorXd& q = grasps[static_cast<size_t>(i) % grasps.size()].q_pre;
    const double start = ReadProcessorTime();
    const Sighting found = camera.FindObject(X_WO, q, std::to_string(i));
    timing.look_ms.push_back(1e3 * (ReadProcessorTime() - start));
    if (i % 10 == 0) TimeOnce(camera, outline, q, X_WO, timing);
    if (!found.is_found) {
      fmt::print("{}, pose {}: {}\n", id, i, found.reason);
      continue;
    }
    ++counts[static_cast<int>(found.direction)];
    shifts_mm.push_back(MmFromM(std::hypot(found.pose.x - pose.x, found.pose.y - pose.y)));
    turns_deg.push_back(DegFromRad(std::abs(std::remainder(found.pose.yaw - pose.yaw, kPi))));
  }
  const bool is_long = object->size.x() > 1.15 * object->size.y();
  const double median = TakeQuantile(shifts_mm, 0.5), high = TakeQuantile(shifts_mm, 0.95);
  fmt::print("{:<16} {:3} found  {:5.2f} {:5.2f} mm", id, shifts_mm.size(), median, high);
  bool is_good = shifts_mm.size() == kNumPoses && median <= 1.0 && high <= 3.0;
  if (is_long) {
    const double turn = TakeQuantile(turns_deg, 0.5), high_turn = TakeQuantile(turns_deg, 0.95);
    fmt::print("  {:5.2f} {:5.2f} deg", turn, high_turn);
    is_good = is_good && turn <= 1.0 && high_turn <= 3.0;
  } else {
    fmt::print("{:17}", "");
  }
  fmt::print("  full {}, half-turns {}, several {}, none {}{}\n", counts[0], counts[1], counts[2],
             counts[3], is_good ? "" : "  NOT GOOD ENOUGH");
  return is_good;
}

int Run(const std::string& hand_id, bool has_shadows) {
  const auto hand = std::make_shared<const Hand>(LoadHand(hand_id));
  CameraConfig config;
  config.has_shadows = has_shadows;
  Timing timing;
  bool is_good = true;
  fmt::print("object            poses  position median, 95 %; direction likewise; what is known\n");
  for (const std::string& id : ListObjects()) {
    is_good = MeasureObject(hand, id, config, timing) && is_good;
  }
  fmt::print(
      "processor time, median and 95 %: picture {:.1f} {:.1f} ms, estimate {:.1f} {:.1f} ms, "
      "both looks {:.1f} {:.1f} ms\n",
      TakeQuantile(timing.picture_ms, 0.5), TakeQuantile(timing.picture_ms, 0.95),
      TakeQuantile(timing.estimate_ms, 0.5), TakeQuantile(timing.estimate_ms, 0.95),
      TakeQuantile(timing.look_ms, 0.5), TakeQuantile(timing.look_ms, 0.95));
  return is_good ? 0 : 1;
}

}  // namespace
}  // namespace graspbench

int main(int argc, char** argv) {
  return graspbench::Run(argc > 1 ? argv[1] : "tum", argc > 2 && std::string(argv[2]) == "full");
}
