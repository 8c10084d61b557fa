#include "core/trial/rest_pose.h"

#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <memory>
#include <mutex>
#include <utility>

#include "core/base/config.h"
#include "core/base/text/json.h"
#include "core/physics/known_answers/small_scenes.h"

namespace graspbench {
namespace {

constexpr double kStop = 0.1;  // between two stops [s]
constexpr int kMostStops = 100;
constexpr double kStill = 1e-6;  // [m]
constexpr double kStillTurn = 1e-5;
constexpr double kAsItLies = 2.5e-5;  // [m]
constexpr double kAsItLiesTurn = 5e-4;

double CalcShift(const Pose& a, const Pose& b) {
  return (a.translation() - b.translation()).norm();
}
double CalcTurn(const Pose& a, const Pose& b) {
  return Eigen::AngleAxisd(a.linear().transpose() * b.linear()).angle();
}

/** Removes horizontal motion and rotation about the vertical. */
Pose Level(const Pose& X_WO) {
  const Eigen::Vector3d x_W = X_WO.linear().col(0);
  const double yaw = std::atan2(x_W.y(), x_W.x());
  return MakePose(Eigen::AngleAxisd(-yaw, Eigen::Vector3d::UnitZ()) * X_WO.linear(),
                  Eigen::Vector3d(0.0, 0.0, X_WO.translation().z()));
}

std::optional<Pose> LetRest(const GraspObject& object, const SimConfig& sim) {
  SmallWorld scene(object, sim);
  Pose X_WO = Pose::Identity();
  X_WO.translation().z() = -scene.world().collider().CalcLowestPoint(X_WO);
  const Pose as_it_lies = X_WO;
  for (int stop = 0; stop < kMostStops; ++stop) {
    scene.start().R_WO = X_WO.linear();
    scene.start().p_WOcm = X_WO * object.mass_properties.p_OOcm;
    scene.Reset();
    scene.Run(kStop);
    const Pose moved = scene.world().CalcObjectPose();
    const bool is_still = CalcShift(moved, X_WO) < kStill && CalcTurn(moved, X_WO) < kStillTurn;
    X_WO = moved;
    if (is_still) break;
  }
  X_WO = Level(X_WO);
  const bool is_as_it_lies =
      CalcShift(X_WO, as_it_lies) < kAsItLies && CalcTurn(X_WO, as_it_lies) < kAsItLiesTurn;
  if (is_as_it_lies) return std::nullopt;
  return X_WO;
}

}  // namespace

std::optional<Pose> FindRestPose(const GraspObject& object, const SimConfig& sim) {
  using Key = std::pair<std::weak_ptr<const SignedDistanceField>, std::string>;
  struct Less {
    bool operator()(const Key& a, const Key& b) const {
      if (a.first.owner_before(b.first)) return true;
      return !b.first.owner_before(a.first) && a.second < b.second;
    }
  };
  static std::mutex mutex;
  static std::map<Key, std::optional<Pose>, Less> known;
  // In some studies the mass is also a setting, for the same mesh.
  const Json settings = {ConfigToJson(sim), object.mass_properties.mass,
                         JsonVector(object.mass_properties.p_OOcm)};
  const Key key{object.field, FormatJson(settings)};
  {
    const std::lock_guard<std::mutex> lock(mutex);
    if (const auto found = known.find(key); found != known.end()) return found->second;
  }
  const std::optional<Pose> rest = LetRest(object, sim);
  const std::lock_guard<std::mutex> lock(mutex);
  for (auto entry = known.begin(); entry != known.end();) {
    entry = entry->first.first.expired() ? known.erase(entry) : std::next(entry);
  }
  return known.emplace(key, rest).first->second;
}

}  // namespace graspbench
