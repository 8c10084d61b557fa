#include "core/hand/load_hand.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <vector>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "core/base/hash.h"
#include "core/base/text/text.h"
#include "core/hand/contact_shape.h"
#include "core/hand/hand.h"
#include "core/hand/hand_yaml.h"
#include "core/hand/read_urdf.h"
#include "core/hand/tactile.h"
#include "core/shape/obj_file.h"
#include "core/shape/primitives.h"

namespace graspbench {

namespace fs = std::filesystem;

namespace {

// Converts a URDF of our own form to the hand's tree, its collision shapes and its visuals.
/** Fills links (depth first, siblings by their joints' names), joints and visuals of `hand`. A hand
without visuals is drawn by its collision shapes. Drives, coupling and the root's pose are left
unset.
@param urdf  read without errors. @param folder  mesh paths are relative to it; faults of meshes are
reported. */
std::vector<CollisionShape> BuildHand(const Urdf& urdf, const std::filesystem::path& folder,
                                      Hand& hand, Diagnostics& problems);

constexpr double kLargestMesh = 2.0;  // [m] from its origin

float LinearFromSrgb(float value) {
  return value <= 0.04045f ? value / 12.92f : std::pow((value + 0.055f) / 1.055f, 2.4f);
}

/** Reads a mesh from its file and scales it. */
TriMesh LoadMesh(const UrdfShape& visual, const std::filesystem::path& folder,
                 Diagnostics& problems) {
  const std::filesystem::path path = folder / visual.mesh;
  TriMesh mesh = ParseObj(ReadFile(path), path.string(), problems);
  double extent = 0.0;
  for (Eigen::Vector3d& p : mesh.vertices) {
    p = p.cwiseProduct(visual.scale);
    extent = std::max(extent, p.cwiseAbs().maxCoeff());
  }
  if (!(extent <= kLargestMesh)) {
    problems.Fail(path.string(), 0,
                  "the mesh reaches farther than 2 m; URDF is in metres, so one in millimetres "
                  "needs scale=\"0.001 0.001 0.001\"");
  }
  return mesh;
}

/** Mesh of a solid about the origin of its frame. @param is_contact  with the shape that AddContact
uses (contact_shape.h), except for the edges of a box. */
TriMesh MakeSolid(const UrdfShape& shape, bool is_contact) {
  if (shape.kind == UrdfShape::Kind::kBox) return MakeRoundedBox(shape.size, 0.0);
  const double radius = 0.5 * shape.size.x();
  if (shape.kind == UrdfShape::Kind::kSphere) return MakeSphere(radius);
  const double half = 0.5 * shape.size.z();
  if (!is_contact || half < radius) {
    return MakeRevolution({{0.0, -half}, {radius, -half}, {radius, half}, {0.0, half}});
  }
  const Eigen::Vector3d end(0.0, 0.0, half - radius);
  return MakeTaperedCapsule(-end, radius, end, radius);
}

class HandBuilder {
 public:
  HandBuilder(const Urdf& urdf, std::filesystem::path folder, Hand& hand, Diagnostics& problems)
      : urdf_(urdf), folder_(std::move(folder)), hand_(hand), problems_(problems) {
    for (const UrdfJoint& joint : urdf.joints) below_[joint.parent][joint.name] = &joint;
    has_visuals_ = std::any_of(urdf.links.begin(), urdf.links.end(),
                               [](const UrdfLink& link) { return !link.visuals.empty(); });
  }

  std::vector<CollisionShape> Build() {
    std::vector<bool> is_child(urdf_.links.size(), false);
    for (const UrdfJoint& joint : urdf_.joints) is_child[joint.child] = true;
    const auto root = std::find(is_child.begin(), is_child.end(), false) - is_child.begin();
    AddLink(static_cast<int>(root), nullptr, -1);
    return std::move(shapes_);
  }

 private:
  void AddLink(int urdf_index, const UrdfJoint* joint, int parent) {
    const UrdfLink& link = urdf_.links[urdf_index];
    const int index = static_cast<int>(hand_.links.size());
    HandLink& added = hand_.links.emplace_back();
    added.name = link.name;
    added.parent = parent;
    if (link.inertia) {
      const UrdfInertia& inertia = *link.inertia;
      added.mass = inertia.mass;
      added.p_LLcm = inertia.X_LI.translation();
      added.I_LLcm = inertia.X_LI.linear() * inertia.I_I * inertia.X_LI.linear().transpose();
    }
    if (joint) AddJoint(*joint, index);
    for (const UrdfShape& collision : link.collisions) {
      AddCollision(collision, index);
      if (!has_visuals_ && !shapes_.back().is_cover && !shapes_.back().is_self_contact)
        AddVisual(collision, true, index);
    }
    for (const UrdfShape& visual : link.visuals) AddVisual(visual, false, index);
    for (const auto& [name, next] : below_[urdf_index]) AddLink(next->child, next, index);
  }

  void AddJoint(const UrdfJoint& joint, int link) {
    HandLink& moved = hand_.links[link];
    moved.X_PJ = joint.X_PJ;
    if (joint.kind == UrdfJoint::Kind::kFixed) return;
    moved.axis = joint.axis;
    moved.joint = hand_.num_joints();
    HandJoint& added = hand_.joints.emplace_back();
    added.name = joint.name;
    added.link = link;
    added.is_prismatic = joint.kind == UrdfJoint::Kind::kPrismatic;
    added.lower = joint.limit->lower;
    added.upper = joint.limit->upper;
  }

  void AddCollision(const UrdfShape& collision, int link) {
    CollisionShape& shape = shapes_.emplace_back();
    shape.link = link;
    shape.X_LS = collision.X_LS;
    shape.size = collision.size;
    shape.is_cover = collision.name == "cover";
    shape.is_self_contact = collision.name == "self_contact";
    shape.kind = collision.kind == UrdfShape::Kind::kSphere     ? CollisionShape::Kind::kSphere
                 : collision.kind == UrdfShape::Kind::kCylinder ? CollisionShape::Kind::kCylinder
                                                                : CollisionShape::Kind::kBox;
  }

  void AddVisual(const UrdfShape& shape, bool is_contact, int link) {
    LinkVisual& added = hand_.visuals.emplace_back();
    added.link = link;
    added.mesh = shape.kind == UrdfShape::Kind::kMesh ? LoadMesh(shape, folder_, problems_)
                                                      : MakeSolid(shape, is_contact);
    for (Eigen::Vector3d& p : added.mesh.vertices) p = shape.X_LS * p;
    if (is_contact || !shape.colour) return;
    for (int i = 0; i < 3; ++i) {
      added.colour[i] = LinearFromSrgb(static_cast<float>((*shape.colour)[i]));
    }
  }

  const Urdf& urdf_;
  std::filesystem::path folder_;
  Hand& hand_;
  Diagnostics& problems_;
  std::map<int, std::map<std::string, const UrdfJoint*>> below_;  // joints by parent and name
  bool has_visuals_ = false;
  std::vector<CollisionShape> shapes_;
};

std::vector<CollisionShape> BuildHand(const Urdf& urdf, const std::filesystem::path& folder,
                                      Hand& hand, Diagnostics& problems) {
  return HandBuilder(urdf, folder, hand, problems).Build();
}

}  // namespace

namespace {

fs::path FindModels() { return FindDataRoot() / "core" / "hand" / "models"; }

fs::path FindHandFolder(const std::string& id_or_folder) {
  const std::vector<std::string> ids = ListHands();
  if (std::find(ids.begin(), ids.end(), id_or_folder) != ids.end()) {
    return FindModels() / id_or_folder;
  }
  std::error_code status;
  fs::path path = id_or_folder;
  if (!id_or_folder.empty() && fs::is_directory(path, status)) return path;
  if (!id_or_folder.empty() && fs::exists(path, status)) {
    throw Error(ErrorKind::kNotFound, "\"" + id_or_folder +
                                          "\" is a file; give the folder that holds hand.urdf and "
                                          "hand.yaml");
  }
  throw Error(ErrorKind::kNotFound,
              "no hand and no folder \"" + id_or_folder + "\"" + SuggestNames(id_or_folder, ids));
}

/** The folder's own name, also for paths such as "hands/mine/" and ".". */
std::string IdOfFolder(const fs::path& folder) {
  const fs::path path = fs::absolute(folder).lexically_normal();
  return (path.has_filename() ? path.filename() : path.parent_path().filename()).string();
}

/** Removes the camera's block. A change of the camera thus leaves all trials valid that do not use
it. */
std::string WithoutCamera(const std::string& yaml) {
  std::string kept;
  bool is_camera = false;
  for (size_t start = 0; start < yaml.size();) {
    const size_t end = std::min(yaml.find('\n', start), yaml.size() - 1) + 1;
    is_camera = (is_camera && yaml[start] == ' ') || yaml.compare(start, 7, "camera:") == 0;
    if (!is_camera) kept.append(yaml, start, end - start);
    start = end;
  }
  return kept;
}

/** Sorts the joints in the order of the digits, base to tip; others (a wrist) follow. */
void SortJoints(Hand& hand) {
  std::vector<int> order;
  for (const Digit& digit : hand.digits) {
    for (int link : digit.links) {
      if (hand.links[link].joint >= 0) order.push_back(hand.links[link].joint);
    }
  }
  for (int j = 0; j < hand.num_joints(); ++j) {
    if (std::find(order.begin(), order.end(), j) == order.end()) order.push_back(j);
  }
  std::vector<int> new_index(order.size());
  std::vector<HandJoint> sorted;
  for (size_t i = 0; i < order.size(); ++i) {
    new_index[order[i]] = static_cast<int>(i);
    sorted.push_back(hand.joints[order[i]]);
  }
  for (HandJoint& joint : sorted) {
    if (joint.coupled_to >= 0) joint.coupled_to = new_index[joint.coupled_to];
  }
  for (HandLink& link : hand.links) {
    if (link.joint >= 0) link.joint = new_index[link.joint];
  }
  hand.joints = std::move(sorted);
}

/** Reports pads that are too deep: a ball compressed to its centre would be on the far side of a
thin object. */
void CheckPadDepths(const Hand& hand, const std::string& file, Diagnostics& problems) {
  std::vector<bool> is_reported(hand.links.size(), false);
  for (const ContactSphere& ball : hand.contact_spheres) {
    const HandLink& link = hand.links[ball.link];
    if (link.surface.pad.depth < ball.radius || is_reported[ball.link]) continue;
    is_reported[ball.link] = true;
    problems.Fail(file, 0,
                  "pads, link \"" + link.name + "\": depth_m is " +
                      FormatSignificant(link.surface.pad.depth, 4) +
                      "; expected less than the radius of its thinnest shape, " +
                      FormatSignificant(ball.radius, 4) + " m");
  }
}

}  // namespace

std::vector<std::string> ListHands() {
  std::vector<std::string> ids;
  std::error_code status;
  for (const auto& entry : fs::directory_iterator(FindModels(), status)) {
    if (entry.is_directory()) ids.push_back(entry.path().filename().string());
  }
  std::sort(ids.begin(), ids.end());
  return ids;
}

Hand ParseHand(const std::string& urdf, const std::string& yaml, const fs::path& folder,
               Diagnostics& problems) {
  const std::string urdf_file = (folder / "hand.urdf").string();
  const std::string yaml_file = (folder / "hand.yaml").string();
  const int num_errors_before = problems.num_errors();
  Hand hand;
  hand.id = IdOfFolder(folder);
  hand.folder = folder.string();
  hand.content_hash = CalcHashHex(urdf + '\0' + WithoutCamera(yaml));

  const Urdf tree = ReadUrdf(urdf, urdf_file, folder, problems);
  std::vector<CollisionShape> shapes;
  if (problems.num_errors() == num_errors_before) {
    shapes = BuildHand(tree, folder, hand, problems);
  }
  ReadHandYaml(yaml, yaml_file, tree, hand, problems);
  if (problems.num_errors() > num_errors_before) return hand;

  SortJoints(hand);
  hand.links[0].X_PJ =
      CalcLinkPoses(hand, Eigen::VectorXd::Zero(hand.num_joints()))[hand.palm_link].inverse();
  std::vector<int> num_shapes(hand.digits.size(), 0);
  for (const CollisionShape& shape : shapes) {
    const int digit = hand.FindDigitOfLink(shape.link);
    const bool is_pad = digit >= 0 && hand.digits[digit].distal_link == shape.link;
    if (is_pad) ++num_shapes[digit];
    AddContact(shape, is_pad, hand);
  }
  CheckPadDepths(hand, yaml_file, problems);
  for (size_t d = 0; d < num_shapes.size(); ++d) {
    if (num_shapes[d] == 0) {
      const Digit& digit = hand.digits[d];
      problems.Fail(urdf_file, 0,
                    "link \"" + hand.links[digit.distal_link].name +
                        "\" carries the pad of digit " + digit.id +
                        " but has no <collision>, so it could never touch");
    }
  }
  return hand;
}

Hand CheckHand(const std::string& id_or_folder, Diagnostics& problems) {
  const fs::path folder = FindHandFolder(id_or_folder);
  bool is_complete = true;
  for (const char* name : {"hand.urdf", "hand.yaml"}) {
    std::error_code status;
    if (fs::is_regular_file(folder / name, status)) continue;
    problems.Fail((folder / name).string(), 0,
                  "missing; a hand is a folder with hand.urdf and hand.yaml");
    is_complete = false;
  }
  if (!is_complete) return {};
  const int num_errors_before = problems.num_errors();
  Hand hand =
      ParseHand(ReadFile(folder / "hand.urdf"), ReadFile(folder / "hand.yaml"), folder, problems);
  std::error_code status;
  const fs::path tactile = folder / "tactile.yaml";
  if (fs::exists(tactile, status) && !fs::is_regular_file(tactile, status)) {
    problems.Fail(tactile.string(), 0, "is no file; write one (graspbench help tactile.yaml)");
  } else if (problems.num_errors() == num_errors_before && fs::exists(tactile, status)) {
    hand.skin = std::make_shared<const TactileSkin>(
        ParseTactile(ReadFile(tactile), tactile.string(), hand, problems));
  }
  return hand;
}

Hand LoadHand(const std::string& id_or_folder) {
  Diagnostics problems;
  Hand hand = CheckHand(id_or_folder, problems);
  problems.ThrowIfErrors(ErrorKind::kFormat, "the hand \"" + id_or_folder + "\" cannot be used");
  return hand;
}

}  // namespace graspbench
