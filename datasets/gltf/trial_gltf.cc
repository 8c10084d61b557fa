#include "datasets/gltf/trial_gltf.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/arm/mounted_arm.h"
#include "core/base/error.h"
#include "datasets/gltf/glb_file.h"

namespace graspbench {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr int kHandTriangles = 8000, kObjectTriangles = 2000;
constexpr int kObjectPart = -1;
constexpr double kNoMotion = 1e-6;      // what moves by less stands still [m], [1]
constexpr double kFarAway = 1e4;        // no trial goes there [m], [N]
constexpr double kTimeUnit = 1e-4;      // [s]
constexpr double kPositionUnit = 1e-4;  // [m]
constexpr double kNormalUnit = 1e-3;
constexpr double kForceUnit = 1e-3;  // [N]

double RoundTo(double unit, double value) {
  // A decimal fraction again, so that it is written short.
  return std::round(value / unit) / std::round(1.0 / unit);
}

/** False where the simulation has given up. */
bool CanBeShown(const TraceInstant& instant) {
  const auto is_near = [](const auto& values) {
    return values.allFinite() && values.cwiseAbs().maxCoeff() < kFarAway;
  };
  if (!is_near(instant.X_WH.matrix()) || !is_near(instant.X_WO.matrix())) return false;
  if (instant.q.size() > 0 && !is_near(instant.q)) return false;
  if (instant.q_arm.size() > 0 && !is_near(instant.q_arm)) return false;
  return std::all_of(
      instant.contacts.begin(), instant.contacts.end(), [&](const HandContact& contact) {
        return is_near(contact.p_WC) && is_near(contact.nhat_W) && is_near(contact.friction_W) &&
               std::abs(contact.normal_force) < kFarAway;
      });
}

/** The instants that become keys; none for a trial that could not begin. */
std::vector<const TraceInstant*> ChooseKeys(const std::vector<TraceInstant>& trace,
                                            double key_rate) {
  std::vector<const TraceInstant*> keys;
  const TraceInstant* last = nullptr;
  for (const TraceInstant& instant : trace) {
    if (!CanBeShown(instant)) break;
    last = &instant;
    const double wanted = static_cast<double>(keys.size()) / key_rate;
    if (instant.time - trace.front().time >= wanted - 1e-9) keys.push_back(last);
  }
  if (last && keys.back() != last) keys.push_back(last);
  return keys;
}

/** Nodes under construction, with their channels. */
class GltfScene {
 public:
  explicit GltfScene(GlbFile& file) : file_(file) {}

  /** @param parent  -1: none. @returns the node's index. */
  int AddNode(Json node, int parent) {
    const int index = static_cast<int>(nodes_.size());
    nodes_.push_back(std::move(node));
    parent < 0 ? roots_.push_back(index) : nodes_[parent]["children"].push_back(index);
    return index;
  }

  /** Below a node or, with -1, for itself. */
  void AddMesh(const TriMesh& mesh, const Eigen::Vector3f& colour, double share, int parent,
               const Json& extras) {
    Json node = AddGltfMesh(mesh, colour, share, file_);
    if (node.is_null()) return;
    if (!extras.is_null()) node["extras"] = extras;
    AddNode(std::move(node), parent);
  }

  /** The node's pose in its parent, one for each key time. */
  void SetPoses(int node, const std::vector<Pose>& poses) {
    std::vector<double> translations, rotations;
    Quaterniond last = Quaterniond::Identity();
    for (const Pose& pose : poses) {
      for (double part : pose.translation()) translations.push_back(part);
      Quaterniond turn = Quaterniond(pose.linear()).normalized();
      if (turn.dot(last) < 0.0) turn.coeffs() = -turn.coeffs();
      for (double part : turn.coeffs()) rotations.push_back(part);  // x y z w, as in glTF
      last = turn;
    }
    SetChannel(node, "translation", "VEC3", 3, translations, {0.0, 0.0, 0.0});
    SetChannel(node, "rotation", "VEC4", 4, rotations, {0.0, 0.0, 0.0, 1.0});
  }

  void SetKeyTimes(const std::vector<double>& times) { times_ = times; }

  std::string Finish(const Json& extras) {
    Json scene = {{"nodes", roots_}};
    if (!extras.is_null()) scene["extras"] = extras;
    file_.root["scene"] = 0;
    file_.root["scenes"] = Json::array({scene});
    file_.root["nodes"] = nodes_;
    if (!channels_.empty()) {
      file_.root["animations"] =
          Json::array({Json{{"name", "trial"}, {"channels", channels_}, {"samplers", samplers_}}});
    }
    return file_.Finish();
  }

 private:
  void SetChannel(int node, const char* path, const char* type, size_t num_parts,
                  const std::vector<double>& values, const std::vector<double>& at_rest) {
    bool moves = false;
    for (size_t i = 0; i < values.size(); ++i) {
      moves = moves || std::abs(values[i] - values[i % num_parts]) > kNoMotion;
    }
    if (!moves) {
      const std::vector<double> first(values.begin(),
                                      values.begin() + static_cast<long>(num_parts));
      if (first != at_rest) nodes_[node][path] = first;
      return;
    }
    if (time_accessor_ < 0) {
      time_accessor_ = file_.AddAccessor({GltfComponent::kFloat, "SCALAR", false, true}, times_);
    }
    const int output = file_.AddAccessor({GltfComponent::kFloat, type}, values);
    channels_.push_back(
        {{"sampler", samplers_.size()}, {"target", {{"node", node}, {"path", path}}}});
    samplers_.push_back({{"input", time_accessor_}, {"output", output}});
  }

  GlbFile& file_;
  Json nodes_ = Json::array(), roots_ = Json::array();
  Json channels_ = Json::array(), samplers_ = Json::array();
  std::vector<double> times_;
  int time_accessor_ = -1;
};

/** X_PL, which is X_HL of the root. */
Pose CalcPoseInParent(const Hand& hand, const HandLink& link, const Eigen::VectorXd& q) {
  if (link.joint < 0) return link.X_PJ;
  const double position = q[link.joint];
  if (hand.joints[static_cast<size_t>(link.joint)].is_prismatic) {
    return link.X_PJ * MakePose(Vector3d(position * link.axis));
  }
  return link.X_PJ *
         MakePose(Eigen::AngleAxisd(position, link.axis).toRotationMatrix(), Vector3d::Zero());
}

double CalcHandShare(const Hand& hand) {
  int num_triangles = 0;
  for (const LinkVisual& visual : hand.visuals) num_triangles += visual.mesh.num_triangles();
  return static_cast<double>(kHandTriangles) / std::max(num_triangles, 1);
}

double CalcObjectShare(const GraspObject& object) {
  return static_cast<double>(kObjectTriangles) / std::max(object.mesh.num_triangles(), 1);
}

Json ListPhases(const TracedTrial& traced) {
  Json phases = Json::array({Json{{"name", NameOf(traced.trace.front().phase)}, {"time_s", 0.0}}});
  for (const PhaseStart& phase : traced.result.phases) {
    if (phase.name == NameOf(Phase::kDone)) continue;
    phases.push_back(
        {{"name", phase.name}, {"time_s", RoundTo(kTimeUnit, phase.time + traced.closure_start)}});
  }
  return phases;
}

Json MakeContact(const HandContact& contact) {
  const Vector3d force_W = contact.normal_force * contact.nhat_W + contact.friction_W;
  Json numbers = Json::array({contact.link});
  const auto add = [&numbers](const Vector3d& v, double unit) {
    for (double part : v) numbers.push_back(std::lround(part / unit));
  };
  add(contact.p_WC, kPositionUnit);
  add(contact.nhat_W, kNormalUnit);
  add(force_W, kForceUnit);
  numbers.push_back(RoundTo(1e-3, contact.mu));
  numbers.push_back(IsSliding(contact) ? 2 : contact.is_at_limit ? 1 : 0);
  return numbers;
}

Json MakeExtras(const TracedTrial& traced, const std::vector<const TraceInstant*>& keys) {
  Json times = Json::array(), contacts = Json::array();
  for (const TraceInstant* key : keys) {
    times.push_back(RoundTo(kTimeUnit, key->time));
    Json at_key = Json::array();
    for (const HandContact& contact : key->contacts) at_key.push_back(MakeContact(contact));
    contacts.push_back(std::move(at_key));
  }
  return {{"outcome", NameOf(traced.result.outcome)},
          {"reason", traced.result.reason},
          {"phases", ListPhases(traced)},
          {"times_s", times},
          {"contacts",
           {{"fields", {"link", "x", "y", "z", "nx", "ny", "nz", "fx", "fy", "fz", "mu", "state"}},
            {"states", {"sticks", "at its limit", "slides"}},
            {"units", {{"xyz_m", kPositionUnit}, {"normal", kNormalUnit}, {"force_n", kForceUnit}}},
            {"keys", contacts}}}};
}

Json MakePartExtras(int part) { return Json{{"part", part}}; }

std::string MakeGlb(const Hand& hand, const GraspObject& object, const TracedTrial& traced,
                    bool is_whole, double key_rate = kGltfKeyRate) {
  const std::vector<const TraceInstant*> keys = ChooseKeys(traced.trace, key_rate);
  if (keys.empty()) {
    throw Error(ErrorKind::kUnsupported,
                "the trial has no course: it could not begin; " + traced.result.reason);
  }
  GlbFile file;
  GltfScene scene(file);
  std::vector<double> times;
  for (const TraceInstant* key : keys) times.push_back(key->time);
  scene.SetKeyTimes(times);

  const auto make_node = [is_whole](const std::string& name, const Json& extras) {
    if (is_whole) return Json{{"name", name}};
    return extras.is_null() ? Json::object() : Json{{"extras", extras}};
  };
  const auto set_poses = [&](int node, const auto& find_pose) {
    std::vector<Pose> poses;
    for (const TraceInstant* key : keys) poses.push_back(find_pose(*key));
    scene.SetPoses(node, poses);
  };
  Json world = make_node("world", {});
  world["rotation"] = {-std::sqrt(0.5), 0.0, 0.0, std::sqrt(0.5)};
  const int world_node = scene.AddNode(world, -1);
  const int hand_node = scene.AddNode(make_node("hand", {}), world_node);
  set_poses(hand_node, [](const TraceInstant& key) { return key.X_WH; });
  std::vector<int> nodes;
  for (const HandLink& link : hand.links) {
    const int parent = link.parent < 0 ? hand_node : nodes[static_cast<size_t>(link.parent)];
    const auto part = static_cast<int>(nodes.size());
    nodes.push_back(scene.AddNode(make_node("hand/" + link.name, MakePartExtras(part)), parent));
    set_poses(nodes.back(),
              [&](const TraceInstant& key) { return CalcPoseInParent(hand, link, key.q); });
  }
  const int object_node =
      scene.AddNode(make_node("object", MakePartExtras(kObjectPart)), world_node);
  set_poses(object_node, [](const TraceInstant& key) { return key.X_WO; });
  std::vector<int> arm_nodes;  // of the base and of every link
  if (traced.arm && keys.front()->q_arm.size() > 0) {
    std::vector<std::vector<Pose>> X_BL;  // by key
    for (const TraceInstant* key : keys) X_BL.push_back(CalcArmPoses(*traced.arm->arm, key->q_arm));
    for (size_t link = 0; link < X_BL[0].size(); ++link) {
      const std::string name = link == 0 ? "arm" : "arm/" + traced.arm->arm->joints[link - 1].name;
      const auto part = static_cast<int>(hand.links.size() + link);
      arm_nodes.push_back(scene.AddNode(make_node(name, MakePartExtras(part)),
                                        link == 0 ? world_node : arm_nodes.back()));
      std::vector<Pose> poses;
      for (const std::vector<Pose>& at_key : X_BL) {
        poses.push_back(link == 0 ? traced.arm->X_WB : at_key[link - 1].inverse() * at_key[link]);
      }
      scene.SetPoses(arm_nodes.back(), poses);
    }
  }
  if (is_whole) {
    for (size_t i = 0; !arm_nodes.empty() && i < traced.arm->arm->capsules.size(); ++i) {
      const ArmCapsule& capsule = traced.arm->arm->capsules[i];
      scene.AddMesh(MakeCapsuleMesh(capsule), kArmColour, 1.0,
                    arm_nodes[static_cast<size_t>(capsule.link)], {});
    }
    for (const LinkVisual& visual : hand.visuals) {
      scene.AddMesh(visual.mesh, visual.colour, CalcHandShare(hand),
                    nodes[static_cast<size_t>(visual.link)], {});
    }
    scene.AddMesh(object.mesh, object.colour, CalcObjectShare(object), object_node, {});
  }
  return scene.Finish(MakeExtras(traced, keys));
}

}  // namespace

std::string MakeTrialGlb(const Hand& hand, const GraspObject& object, const TracedTrial& traced,
                         double key_rate) {
  return MakeGlb(hand, object, traced, true, key_rate);
}

std::string MakeMotionGlb(const Hand& hand, const GraspObject& object, const TracedTrial& traced) {
  return MakeGlb(hand, object, traced, false);
}

std::string MakeHandGlb(const Hand& hand, const MountedArm* arm) {
  GlbFile file;
  GltfScene scene(file);
  for (const LinkVisual& visual : hand.visuals) {
    scene.AddMesh(visual.mesh, visual.colour, CalcHandShare(hand), -1, MakePartExtras(visual.link));
  }
  for (size_t i = 0; arm && i < arm->arm->capsules.size(); ++i) {
    const ArmCapsule& capsule = arm->arm->capsules[i];
    scene.AddMesh(MakeCapsuleMesh(capsule), kArmColour, 1.0, -1,
                  MakePartExtras(static_cast<int>(hand.links.size()) + capsule.link));
  }
  return scene.Finish({});
}

std::string MakeObjectGlb(const GraspObject& object) {
  GlbFile file;
  GltfScene scene(file);
  scene.AddMesh(object.mesh, object.colour, CalcObjectShare(object), -1,
                MakePartExtras(kObjectPart));
  return scene.Finish({});
}

}  // namespace graspbench
