#include "core/hand/hand_yaml.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/base/text/yaml.h"
#include "core/base/units.h"

namespace graspbench {
namespace {

class HandYamlReader {
 public:
  HandYamlReader(std::string file, const Urdf& urdf, Hand& hand, Diagnostics& problems)
      : file_(std::move(file)),
        links_(urdf.ListLinks()),
        moving_joints_(urdf.ListMovingJoints()),
        hand_(hand),
        problems_(problems) {}

  void Read(const YAML::Node& root) {
    YamlMap map(root, file_, "hand", problems_, &ListHandKeys());
    map.Read("name", hand_.name);
    ReadPalm(map.Child("palm"));
    double accuracy_deg = 0.0;
    map.Read("joint_accuracy_deg", accuracy_deg);
    hand_.joint_accuracy = RadFromDeg(accuracy_deg);
    double slide_accuracy_mm = 0.0;
    map.Read("slide_accuracy_mm", slide_accuracy_mm, Needed::kNo);
    hand_.slide_accuracy = MFromMm(slide_accuracy_mm);
    double pad_torsion_radius = 0.004;
    map.Read("pad_torsion_radius_m", pad_torsion_radius, Needed::kNo);
    ReadDigits(map.Child("digits"));
    for (const Digit& digit : hand_.digits) {
      if (digit.distal_link < 0) continue;
      hand_.links[digit.distal_link].surface.torsion_radius = pad_torsion_radius;
    }
    const YAML::Node surfaces = map.Child("surfaces", Needed::kNo);
    if (map.Has("surfaces")) ReadSurfaces(surfaces);
    const YAML::Node pads = map.Child("pads", Needed::kNo);
    if (map.Has("pads")) ReadPads(pads);
    if (map.Has("coupling")) ReadCoupling(map.Child("coupling", Needed::kNo));
    const YAML::Node mimic = map.Child("mimic", Needed::kNo);
    if (map.Has("mimic")) ReadMimic(mimic);
    CheckCoupledTo();
    ReadDrives(map.Child("drives"));
    const YAML::Node apart = map.Child("apart", Needed::kNo);
    if (map.Has("apart")) ReadApart(apart);
    const YAML::Node frames = map.Child("frames", Needed::kNo);
    if (map.Has("frames")) ReadFrames(frames);
    const YAML::Node camera = map.Child("camera", Needed::kNo);
    if (map.Has("camera")) ReadCamera(camera);
    map.Child("grasps", Needed::kNo);
    map.FinishKnownKeys();
  }

 private:
  /** Reports a name that hand.urdf does not have; `what` is "link" or "joint". */
  bool CheckName(const std::string& name, const char* what, int line, const std::string& where) {
    if (links_.empty()) return false;  // hand.urdf cannot be read, which has been reported
    const auto& known = *what == 'l' ? links_ : moving_joints_;
    if (std::find(known.begin(), known.end(), name) != known.end()) return true;
    problems_.Fail(file_, line,
                   where + ": hand.urdf has no " + (*what == 'l' ? "link" : "moving joint") +
                       " \"" + name + "\"" + SuggestNames(name, known));
    return false;
  }
  /** Items of a sequence; reports any other node. A missing key has been reported before. */
  std::vector<YAML::Node> Items(const YAML::Node& node, const std::string& where) {
    if (node.IsSequence() && node.size() > 0) return {node.begin(), node.end()};
    if (node.IsDefined() && LineOf(node) > 0) {
      problems_.Fail(file_, LineOf(node), where + ": expected a list with at least one entry");
    }
    return {};
  }

  void ReadPalm(const YAML::Node& node) {
    if (!node.IsDefined() || node.IsNull()) return;
    YamlMap map(node, file_, "palm", problems_, &ListHandKeys(), "palm.");
    std::string link;
    map.Read("link", link);
    map.Read("centre_m", hand_.p_HCentre);
    map.Read("normal", hand_.palm_normal);
    map.FinishKnownKeys();
    if (!link.empty() && CheckName(link, "link", LineOf(node), "palm")) {
      hand_.palm_link = std::max(0, hand_.FindLink(link));
    }
    if (hand_.palm_normal.norm() < 1e-6) {
      map.Fail("normal", "has no direction");
    } else {
      hand_.palm_normal.normalize();
    }
  }

  void ReadDigits(const YAML::Node& node) {
    std::set<std::string> ids;
    int num_thumbs = 0;
    for (const YAML::Node& item : Items(node, "digits")) {
      ReadDigit(item);
      const Digit& digit = hand_.digits.back();
      num_thumbs += digit.is_thumb;
      if (!digit.id.empty() && !ids.insert(digit.id).second) {
        problems_.Fail(file_, LineOf(item), "digit " + digit.id + ": the id is taken");
      }
    }
    if (!hand_.digits.empty() && num_thumbs != 1) {
      problems_.Fail(
          file_, LineOf(node),
          "digits: one digit must have \"thumb: true\", found " + std::to_string(num_thumbs));
    }
  }

  void ReadDigit(const YAML::Node& node) {
    Digit& digit = hand_.digits.emplace_back();
    YamlMap map(node, file_, "digit " + std::to_string(hand_.digits.size()), problems_,
                &ListHandKeys(), "digits.");
    std::vector<std::string> links;
    map.Read("id", digit.id);
    map.Read("name", digit.name);
    map.Read("thumb", digit.is_thumb, Needed::kNo);
    map.Read("links", links);
    const int line = LineOf(map.Child("links", Needed::kNo));
    map.Read("tip_m", digit.p_LTip);
    map.Read("pad_m", digit.p_LPad);
    map.FinishKnownKeys();
    const std::string where = "digit " + digit.id;
    if (map.Has("links") && links.empty()) map.Fail("links", "a digit needs at least one link");
    for (const std::string& name : links) {
      if (!CheckName(name, "link", line, where)) continue;
      const auto [taken, is_new] = digit_of_link_.emplace(name, digit.id);
      if (!is_new) {
        problems_.Fail(file_, line, where + ": link \"" + name + "\" is in digit " + taken->second);
      }
      const int link = hand_.FindLink(name);
      if (link < 0) continue;  // the URDF is broken and its tree unknown
      if (!digit.links.empty() && hand_.links[link].parent != digit.links.back()) {
        problems_.Fail(file_, line,
                       where + ": link \"" + name + "\" does not hang on the link before it, \"" +
                           hand_.links[digit.links.back()].name + "\"; name them from base to tip");
      }
      digit.links.push_back(link);
    }
    if (!digit.links.empty()) digit.distal_link = digit.links.back();
  }

  void ReadCoupling(const YAML::Node& node) {
    YamlMap map(node, file_, "coupling", problems_, &ListHandKeys(), "coupling.");
    std::string rule;
    map.Read("rule", rule);
    map.Read("fixed_ratio", hand_.fixed_coupling_ratio, Needed::kNo);
    const YAML::Node joints = map.Child("joints");
    map.FinishKnownKeys();
    const auto& rules = ListCouplingRules();
    const auto found =
        std::find_if(rules.begin(), rules.end(), [&](CouplingRule r) { return NameOf(r) == rule; });
    if (found != rules.end()) {
      hand_.coupling = *found;
    } else if (!rule.empty()) {
      std::vector<std::string> names;
      for (CouplingRule r : rules) names.push_back(NameOf(r));
      map.Fail("rule", "unknown rule \"" + rule + "\"" + SuggestNames(rule, names));
    }
    if (!joints.IsDefined() || joints.IsNull()) return;
    if (!joints.IsMap()) {
      map.Fail("joints", "expected pairs, distal joint: middle joint");
      return;
    }
    for (const auto& pair : joints) {
      const std::string distal = pair.first.as<std::string>("");
      const std::string middle = pair.second.as<std::string>("");
      const int line = LineOf(pair.first);
      const std::string where = "coupling of " + distal;
      const bool knows_distal = CheckName(distal, "joint", line, where);
      const bool knows_middle = CheckName(middle, "joint", line, where);
      if (!knows_distal || !knows_middle) continue;
      if (!coupled_.insert(distal).second) {
        problems_.Fail(file_, line, where + ": named twice");
      }
      const int d = hand_.FindJoint(distal), m = hand_.FindJoint(middle);
      if (d < 0 || m < 0) continue;
      if (hand_.links[hand_.joints[d].link].parent != hand_.joints[m].link) {
        problems_.Fail(
            file_, line,
            where + ": joint \"" + middle + "\" is not the joint before it in the finger");
      }
      hand_.joints[d].coupled_to = m;
      coupled_lines_.emplace_back(d, line);
    }
  }

  void ReadMimic(const YAML::Node& node) {
    for (const YAML::Node& item : Items(node, "mimic")) {
      YamlMap map(item, file_, "mimic", problems_, &ListHandKeys(), "mimic.");
      std::string name, follows;
      double ratio = 1.0, offset_deg = 0.0, offset_mm = 0.0;
      map.Read("joint", name);
      map.Read("follows", follows);
      map.Read("ratio", ratio);
      map.Read("offset_deg", offset_deg, Needed::kNo);
      map.Read("offset_mm", offset_mm, Needed::kNo);
      map.FinishKnownKeys();
      const int line = LineOf(item);
      const std::string where = "mimic of " + name;
      const bool knows_both =
          CheckName(name, "joint", line, where) && CheckName(follows, "joint", line, where);
      if (!knows_both) continue;
      if (!coupled_.insert(name).second) problems_.Fail(file_, line, where + ": named twice");
      if (ratio == 0.0) map.Fail("ratio", "expected a number other than 0");
      const int joint = hand_.FindJoint(name), other = hand_.FindJoint(follows);
      if (joint < 0 || other < 0) continue;
      HandJoint& follower = hand_.joints[joint];
      if (map.Has(follower.is_prismatic ? "offset_deg" : "offset_mm")) {
        map.Fail(follower.is_prismatic ? "offset_deg" : "offset_mm",
                 "the joint " + std::string(follower.is_prismatic ? "slides: give offset_mm"
                                                                  : "turns: give offset_deg"));
      }
      follower.coupled_to = other;
      follower.is_mimic = true;
      follower.mimic_ratio = ratio;
      follower.mimic_offset = follower.is_prismatic ? MFromMm(offset_mm) : RadFromDeg(offset_deg);
      coupled_lines_.emplace_back(joint, line);
    }
  }

  void CheckCoupledTo() {
    for (const auto& [d, line] : coupled_lines_) {
      if (hand_.joints[hand_.joints[d].coupled_to].coupled_to >= 0) {
        problems_.Fail(file_, line,
                       "coupling of " + hand_.joints[d].name + ": joint \"" +
                           hand_.joints[hand_.joints[d].coupled_to].name +
                           "\" is coupled itself; it must have a drive");
      }
    }
  }

  void ReadDrives(const YAML::Node& node) {
    std::set<std::string> driven;
    int number = 0;
    for (const YAML::Node& item : Items(node, "drives")) {
      const std::string where = "drives, entry " + std::to_string(++number);
      YamlMap map(item, file_, where, problems_, &ListHandKeys(), "drives.");
      std::vector<std::string> joints;
      const double unset = std::nan("");  // a missing value is reported, and not checked
      JointDrive drive = {unset, unset, unset};
      map.Read("joints", joints);
      const bool slides = map.Has("stiffness_n_per_m");
      const char* const stiffness = slides ? "stiffness_n_per_m" : "stiffness_nm_per_rad";
      const char* const damping = slides ? "damping_ns_per_m" : "damping_nms_per_rad";
      const char* const limit = slides ? "force_limit_n" : "torque_limit_nm";
      map.Read(stiffness, drive.stiffness);
      map.Read(damping, drive.damping);
      map.Read(limit, drive.torque_limit);
      map.FinishKnownKeys();
      for (const std::string& name : joints) {
        if (!CheckName(name, "joint", LineOf(item), where)) continue;
        if (coupled_.count(name) != 0) {
          map.Fail("joints", "\"" + name + "\" is coupled and has no drive of its own");
        } else if (!driven.insert(name).second) {
          map.Fail("joints", "\"" + name + "\" already has a drive");
        }
        const int joint = hand_.FindJoint(name);
        if (joint < 0) continue;
        hand_.joints[joint].drive = drive;
        if (hand_.joints[joint].is_prismatic == slides) continue;
        map.Fail("joints",
                 "\"" + name + "\" " +
                     (slides ? "turns: its drive has stiffness_nm_per_rad, "
                               "damping_nms_per_rad and torque_limit_nm"
                             : "slides: its drive has stiffness_n_per_m, damping_ns_per_m "
                               "and force_limit_n"));
      }
    }
    for (const std::string& name : moving_joints_) {
      if (driven.count(name) == 0 && coupled_.count(name) == 0) {
        problems_.Fail(file_, LineOf(node),
                       "drives: joint \"" + name +
                           "\" has neither drive nor "
                           "coupling");
      }
    }
  }

  void ReadSurfaces(const YAML::Node& node) {
    int number = 0;
    for (const YAML::Node& item : Items(node, "surfaces")) {
      const std::string where = "surfaces, entry " + std::to_string(++number);
      YamlMap map(item, file_, where, problems_, &ListHandKeys(), "surfaces.");
      std::vector<std::string> links;
      map.Read("links", links);
      SurfaceMaterial surface;
      ReadSurface(map, Needed::kNo, surface);
      map.FinishKnownKeys();
      for (const std::string& name : links) {
        if (!CheckName(name, "link", LineOf(item), where)) continue;
        const int link = hand_.FindLink(name);
        if (link < 0) continue;  // the URDF is broken, which has been reported
        const double pad_radius = hand_.links[link].surface.torsion_radius;
        hand_.links[link].surface = surface;
        if (!std::isnan(surface.torsion_radius)) has_own_torsion_.insert(link);
        if (std::isnan(surface.torsion_radius)) {
          hand_.links[link].surface.torsion_radius = pad_radius;
        }
      }
    }
  }

  void ReadPads(const YAML::Node& node) {
    std::set<int> has_pad;
    int number = 0;
    for (const YAML::Node& item : Items(node, "pads")) {
      const std::string where = "pads, entry " + std::to_string(++number);
      YamlMap map(item, file_, where, problems_, &ListHandKeys(), "pads.");
      std::vector<std::string> links;
      SoftPad pad;
      std::string source;  // origin of the values, for the reader
      map.Read("links", links);
      map.Read("youngs_modulus_pa", pad.youngs_modulus);
      map.Read("depth_m", pad.depth);
      map.Read("source", source);
      map.FinishKnownKeys();
      for (const std::string& name : links) {
        if (!CheckName(name, "link", LineOf(item), where)) continue;
        const int link = hand_.FindLink(name);
        if (link < 0) continue;  // the URDF is broken, which has been reported
        if (!has_pad.insert(link).second) map.Fail("links", "\"" + name + "\" already has a pad");
        SurfaceMaterial& surface = hand_.links[link].surface;
        surface.pad = pad;
        // The radius of the pad's patch, unless the link itself has one.
        if (has_own_torsion_.count(link) == 0) surface.torsion_radius = kUnset;
      }
    }
  }

  void ReadApart(const YAML::Node& node) {
    for (const YAML::Node& item : Items(node, "apart")) {
      if (!item.IsSequence() || item.size() != 2 || !item[0].IsScalar() || !item[1].IsScalar()) {
        problems_.Fail(file_, LineOf(item), "apart: expected pairs of links, [palm, proximal]");
        continue;
      }
      const std::string names[2] = {item[0].as<std::string>(""), item[1].as<std::string>("")};
      const bool knows_first = CheckName(names[0], "link", LineOf(item), "apart");
      if (!CheckName(names[1], "link", LineOf(item), "apart") || !knows_first) continue;
      const int links[2] = {hand_.FindLink(names[0]), hand_.FindLink(names[1])};
      if (links[0] >= 0 && links[1] >= 0) hand_.apart.emplace_back(links[0], links[1]);
    }
  }

  void ReadFrames(const YAML::Node& node) {
    std::set<std::string> taken;
    for (const YAML::Node& item : Items(node, "frames")) {
      YamlMap map(item, file_, "frames", problems_, &ListHandKeys(), "frames.");
      std::string link;
      NamedFrame frame;
      Eigen::Vector3d position = Eigen::Vector3d::Zero(), rpy = Eigen::Vector3d::Zero();
      map.Read("name", frame.name);
      map.Read("link", link);
      map.Read("position_m", position);
      map.Read("rpy_rad", rpy, Needed::kNo);
      map.FinishKnownKeys();
      if (!taken.insert(frame.name).second) map.Fail("name", "\"" + frame.name + "\" is taken");
      if (!CheckName(link, "link", LineOf(item), "frame " + frame.name)) continue;
      frame.link = std::max(0, hand_.FindLink(link));
      frame.X_LF = MakePose(MakeRotationRpy(rpy.x(), rpy.y(), rpy.z()), position);
      hand_.frames.push_back(frame);
    }
  }

  void ReadCamera(const YAML::Node& node) {
    YamlMap map(node, file_, "camera", problems_, &ListHandKeys(), "camera.");
    std::string link;
    HandCamera camera;
    Eigen::Vector3d position = Eigen::Vector3d::Zero(), forward = Eigen::Vector3d::UnitZ(),
                    right = Eigen::Vector3d::UnitX();
    map.Read("link", link);
    map.Read("position_m", position);
    map.Read("forward", forward);
    map.Read("right", right);
    map.Read("width_px", camera.width, Needed::kNo);
    map.Read("height_px", camera.height, Needed::kNo);
    map.Read("focal_length_px", camera.focal_length, Needed::kNo);
    map.Read("radial_1", camera.k1, Needed::kNo);
    map.Read("radial_2", camera.k2, Needed::kNo);
    map.FinishKnownKeys();
    if (!link.empty() && CheckName(link, "link", LineOf(node), "camera")) {
      camera.link = std::max(0, hand_.FindLink(link));
    }
    const Eigen::Vector3d across = right - right.dot(forward) / forward.squaredNorm() * forward;
    if (!(forward.norm() > 1e-6) || !(across.norm() > 1e-3 * right.norm())) {
      map.Fail("right", "must not lie along forward, and both need a direction");
      return;
    }
    if (!link.empty() && hand_.FindLink(link) == hand_.palm_link &&
        forward.dot(hand_.palm_normal) <= 0.0) {
      map.Fail(
          "forward",
          "looks away from what the palm faces (palm.normal); the arm turns the camera down to "
          "the table, and the hand with it");
      return;
    }
    Eigen::Matrix3d R_LK;
    R_LK.col(2) = forward.normalized();
    R_LK.col(0) = across.normalized();
    R_LK.col(1) = R_LK.col(2).cross(R_LK.col(0));
    camera.X_LK = MakePose(R_LK, position);
    hand_.camera = camera;
  }

  std::string file_;
  std::vector<std::string> links_, moving_joints_;  // of hand.urdf
  Hand& hand_;
  Diagnostics& problems_;
  std::map<std::string, std::string> digit_of_link_;
  std::set<std::string> coupled_;
  std::set<int> has_own_torsion_;                   // links whose surface has a torsion radius
  std::vector<std::pair<int, int>> coupled_lines_;  // coupled joints and the lines that name them
};

}  // namespace

void ReadHandYaml(const std::string& text, const std::string& file, const Urdf& urdf, Hand& hand,
                  Diagnostics& problems) {
  const int num_errors_before = problems.num_errors();
  const YAML::Node root = ParseYaml(text, file, problems);
  if (problems.num_errors() > num_errors_before) return;
  HandYamlReader(file, urdf, hand, problems).Read(root);
}

}  // namespace graspbench
