#include "core/arm/load_arm.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/base/files/files.h"
#include "core/base/hash.h"
#include "core/base/text/text.h"
#include "core/base/text/yaml.h"
#include "core/base/units.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

/** A pose of the hand has six numbers; the simulation takes no more than ten. */
constexpr int kLeastJoints = 6, kMostJoints = 10;

/** A joint whose limits are no farther apart was given in radians [deg]. */
constexpr double kRadiansOfTurn = 4.0 * kPi;

fs::path FindArmModels() { return FindDataRoot() / "core" / "arm" / "models"; }

fs::path FindArmFolder(const std::string& id_or_folder) {
  const std::vector<std::string> ids = ListArms();
  if (std::find(ids.begin(), ids.end(), id_or_folder) != ids.end()) {
    return FindArmModels() / id_or_folder;
  }
  std::error_code status;
  if (fs::is_regular_file(fs::path(id_or_folder) / "arm.yaml", status)) return id_or_folder;
  throw Error(ErrorKind::kNotFound, "no arm and no folder with arm.yaml \"" + id_or_folder + "\"" +
                                        SuggestNames(id_or_folder, ids));
}

/** A joint that needs as many seconds for a turn was given in rad/s [deg/s]. */
constexpr double kRadiansOfSpeed = 2.0 * kPi;

/** Of a joint at its largest torque [rad]; a joint that yields more was given in other units. */
constexpr double kLargestDeflection = 1.0;

void ReadAngle(const std::string& key, Needed needed, YamlMap& map, double& angle) {
  double angle_deg = DegFromRad(angle);
  map.Read(key, angle_deg, needed);
  angle = RadFromDeg(angle_deg);
}

/** Of a Denavit-Hartenberg row: quarter turns are 90, not 1.5708. */
void ReadRowAngle(const std::string& key, Needed needed, YamlMap& map, double& angle) {
  ReadAngle(key, needed, map, angle);
  const double angle_deg = DegFromRad(std::abs(angle));
  if (std::abs(angle_deg - 0.5 * kPi) < 0.01 || std::abs(angle_deg - kPi) < 0.01) {
    map.Fail(key,
             FormatFixed(DegFromRad(angle), 4) + " deg; expected degrees, this looks like radians");
  }
}

ArmJoint ReadArmJoint(YamlMap& map) {
  ArmJoint joint;
  map.Read("name", joint.name);
  map.Read("a_m", joint.a);
  map.Read("d_m", joint.d);
  ReadRowAngle("alpha_deg", Needed::kYes, map, joint.alpha);
  ReadRowAngle("offset_deg", Needed::kNo, map, joint.offset);
  ReadAngle("lower_deg", Needed::kYes, map, joint.lower);
  ReadAngle("upper_deg", Needed::kYes, map, joint.upper);
  ReadAngle("speed_deg_per_s", Needed::kYes, map, joint.speed);
  map.Read("torque_nm", joint.torque);
  map.Read("stiffness_nm_per_rad", joint.stiffness);
  map.Read("armature_kg_m2", joint.armature);
  map.Read("mass_kg", joint.mass);
  map.Read("com_m", joint.p_com);
  map.Read("inertia_kg_m2", joint.inertia);
  const std::string who = "joint \"" + joint.name + "\": ";
  const double softest = joint.torque / kLargestDeflection;
  if (joint.stiffness > 0.0 && joint.stiffness < softest) {
    map.Fail("stiffness_nm_per_rad",
             who + "turns by more than 1 rad at its torque; expected at least " +
                 FormatFixed(softest, 0) + " N m/rad, this may be N m per mrad");
  }
  if (map.Has("lower_deg") && map.Has("upper_deg")) {
    const double range_deg = DegFromRad(joint.upper - joint.lower);
    if (range_deg <= 0.0) {
      map.Fail("upper_deg", who + "expected more than its lower_deg");
    } else if (range_deg <= kRadiansOfTurn) {
      map.Fail("upper_deg", who + "turns by " + FormatFixed(range_deg, 2) +
                                " deg only; expected degrees, these look like radians");
    }
  }
  map.FinishKnownKeys();
  return joint;
}

ArmCapsule ReadArmCapsule(int num_joints, YamlMap& map) {
  ArmCapsule capsule;
  map.Read("link", capsule.link);
  map.Read("from_m", capsule.p_LA);
  map.Read("to_m", capsule.p_LB);
  map.Read("radius_m", capsule.radius);
  if (capsule.link < 0 || capsule.link > num_joints) {
    map.Fail("link", "no link " + std::to_string(capsule.link) + "; expected 0 (the base) to " +
                         std::to_string(num_joints));
    capsule.link = 0;
  }
  map.FinishKnownKeys();
  return capsule;
}

void ReadReady(YamlMap& root, Arm& arm) {
  std::vector<double> ready_deg;
  root.Read("ready_deg", ready_deg);
  arm.ready = Eigen::VectorXd::Zero(arm.num_joints());
  if (ready_deg.size() != arm.joints.size()) {
    root.Fail("ready_deg",
              "expected one angle for each of the " + FormatCount(arm.num_joints(), "joint"));
    return;
  }
  for (size_t i = 0; i < ready_deg.size(); ++i) {
    const ArmJoint& joint = arm.joints[i];
    const double angle = RadFromDeg(ready_deg[i]);
    arm.ready[static_cast<Eigen::Index>(i)] = angle;
    const bool has_range = joint.lower < joint.upper;  // else that is the error
    if (has_range && (angle < joint.lower || angle > joint.upper)) {
      root.Fail("ready_deg", "joint \"" + joint.name + "\" would be outside its limits");
    }
  }
}

/** What one joint does not show. */
void CheckJoints(const Arm& arm, YamlMap& root) {
  if (arm.num_joints() < kLeastJoints || arm.num_joints() > kMostJoints) {
    root.Fail("joints", "found " + FormatCount(arm.num_joints(), "joint") + "; expected " +
                            std::to_string(kLeastJoints) + " to " + std::to_string(kMostJoints) +
                            ", for the hand to take any pose");
  }
  if (CalcArmReach(arm) == 0.0) {
    root.Fail("joints", "every a_m and d_m behind joint 1 is 0; expected the lengths of the links");
  }
  const auto is_slow = [](const ArmJoint& joint) {
    return DegFromRad(joint.speed) <= kRadiansOfSpeed;
  };
  if (std::all_of(arm.joints.begin(), arm.joints.end(), is_slow)) {
    root.Fail("joints", "no joint is faster than " + FormatFixed(kRadiansOfSpeed, 1) +
                            " deg/s; expected degrees per second, these look like radians");
  }
  std::set<std::string> names;
  for (const ArmJoint& joint : arm.joints) {
    if (names.insert(joint.name).second) continue;
    root.Fail("joints", "two joints are named \"" + joint.name + "\"; expected a name each");
  }
}

std::vector<YAML::Node> ListItems(const std::string& key, YamlMap& map) {
  const YAML::Node node = map.Child(key);
  if (node.IsSequence() && node.size() > 0) return {node.begin(), node.end()};
  if (map.Has(key)) map.Fail(key, "expected a list with at least one entry");
  return {};
}

}  // namespace

std::vector<std::string> ListArms() {
  std::vector<std::string> ids;
  std::error_code status;
  for (const auto& entry : fs::directory_iterator(FindArmModels(), status)) {
    if (entry.is_directory()) ids.push_back(entry.path().filename().string());
  }
  std::sort(ids.begin(), ids.end());
  return ids;
}

const FileKeys& ListArmKeys() {
  static const FileKeys keys = {
      {"name", kRequired, "for people"},
      {"ready_deg", kRequired, "posture in which the gross motion starts, an angle a joint"},
      {"joints", kRequired, KeyType::kList,
       "list from the base to the flange; standard Denavit-Hartenberg form, joints that turn"},
      {"joints.name", kRequired, "in messages and records"},
      {"joints.a_m", kRequired, "length of the link", -3, 3},
      {"joints.d_m", kRequired, "offset along the joint's axis", -3, 3},
      {"joints.alpha_deg", kRequired, "twist of the link", -180, 180},
      {"joints.offset_deg", "0", "added to the joint's angle", -360, 360},
      {"joints.lower_deg", kRequired, "lower limit", -720, 720},
      {"joints.upper_deg", kRequired, "upper limit", -720, 720},
      {"joints.speed_deg_per_s", kRequired, "largest speed", kAboveZero, 3600},
      {"joints.torque_nm", kRequired, "largest torque", kAboveZero, 10000},
      {"joints.stiffness_nm_per_rad", kRequired,
       "of drive and gear at the joint: torque over deflection", kAboveZero, 1e8},
      {"joints.armature_kg_m2", kRequired, "inertia of the rotor, seen at the joint", kAboveZero,
       1000},
      {"joints.mass_kg", kRequired, "of the link behind the joint", 0, 1000},
      {"joints.com_m", kRequired, "centre of mass of that link, in its frame", -3, 3},
      {"joints.inertia_kg_m2", kRequired,
       "moments of inertia of that link about its frame's axes through the centre of mass", 0,
       1000},
      {"capsules", kRequired, KeyType::kList, "list: the arm's shape for collisions"},
      {"capsules.link", kRequired, "0: the base; n: the link behind joint n"},
      {"capsules.from_m", kRequired, "end of the axis, in the link's frame", -3, 3},
      {"capsules.to_m", kRequired, "other end", -3, 3},
      {"capsules.radius_m", kRequired, "radius", kAboveZero, 1},
  };
  return keys;
}

Arm ParseArm(const std::string& text, const fs::path& folder, Diagnostics& problems) {
  const std::string file = (folder / "arm.yaml").string();
  Arm arm;
  const fs::path path = fs::absolute(folder).lexically_normal();
  arm.id = (path.has_filename() ? path.filename() : path.parent_path().filename()).string();
  arm.folder = folder.string();
  arm.content_hash = CalcHashHex(text);
  YamlMap root(ParseYaml(text, file, problems), file, "arm", problems, &ListArmKeys());
  root.Read("name", arm.name);
  for (const YAML::Node& item : ListItems("joints", root)) {
    YamlMap map(item, file, "joint", problems, &ListArmKeys(), "joints.");
    arm.joints.push_back(ReadArmJoint(map));
  }
  if (arm.num_joints() > 0) CheckJoints(arm, root);
  ReadReady(root, arm);
  for (const YAML::Node& item : ListItems("capsules", root)) {
    YamlMap map(item, file, "capsule", problems, &ListArmKeys(), "capsules.");
    arm.capsules.push_back(ReadArmCapsule(arm.num_joints(), map));
  }
  root.FinishKnownKeys();
  return arm;
}

Arm LoadArm(const std::string& id_or_folder) {
  const fs::path folder = FindArmFolder(id_or_folder);
  Diagnostics problems;
  Arm arm = ParseArm(ReadFile(folder / "arm.yaml"), folder, problems);
  problems.ThrowIfErrors(ErrorKind::kFormat, "the arm \"" + id_or_folder + "\" cannot be used");
  return arm;
}

}  // namespace graspbench
