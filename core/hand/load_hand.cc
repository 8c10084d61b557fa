#include "core/hand/load_hand.h"

#include <algorithm>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "core/base/hash.h"
#include "core/base/text/text.h"
#include "core/hand/build_hand.h"
#include "core/hand/hand_yaml.h"
#include "core/hand/tactile_yaml.h"

namespace graspbench {
namespace fs = std::filesystem;

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

/** The folder's own name, also for "hands/mine/" and ".". */
std::string IdOfFolder(const fs::path& folder) {
  const fs::path path = fs::absolute(folder).lexically_normal();
  return (path.has_filename() ? path.filename() : path.parent_path().filename()).string();
}

/** Without the block of its camera: whoever adds or moves one changes no trial that does not look
through it. */
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

/** Puts the joints in the order of the digits, base to tip; the rest (a wrist) follows. */
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

/** A ball that is compressed to its middle would stand on the other side of a thin object. */
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
