#include "core/hand/import/write_hand.h"

#include <fmt/core.h>
#include <tinyxml2.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <set>

#include "core/base/roll_pitch_yaw.h"
#include "core/base/text/json.h"
#include "core/base/text/text.h"
#include "core/base/text/yaml_text.h"
#include "core/base/units.h"
#include "core/shape/obj_file.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

/** Nine digits, a negative zero without its sign. */
std::string FormatNumber(double value) { return fmt::format("{:.9g}", value + 0.0); }

/** Of a place or an angle: exact to 1e-12, so that a chain of them keeps a nanometre. */
std::string FormatExactly(const Vector3d& v, const char* separator = " ") {
  return fmt::format("{:.12g}{}{:.12g}{}{:.12g}", v.x() + 0.0, separator, v.y() + 0.0, separator,
                     v.z() + 0.0);
}

std::string FormatVector(const Vector3d& v, const char* separator = " ") {
  return FormatNumber(v.x()) + separator + FormatNumber(v.y()) + separator + FormatNumber(v.z());
}

/** Rounded to 10 micrometres, as a guess is. */
std::string FormatPlace(const Vector3d& p) {
  std::string text;
  for (int k = 0; k < 3; ++k) text += (k ? ", " : "") + FormatNumber(std::round(p[k] * 1e5) / 1e5);
  return "[" + text + "]";
}

class UrdfWriter {
 public:
  explicit UrdfWriter(const ImportedHand& imported) : imported_(imported), hand_(imported.hand) {}

  std::string Write(const std::string& source, std::map<std::string, std::string>& files) {
    xml_.PushHeader(false, true);
    xml_.PushComment((" imported from " + source + "; see README.md ").c_str());
    Open("robot");
    Set("name", hand_.name);
    for (size_t i = 0; i < hand_.links.size(); ++i) {
      WriteLink(static_cast<int>(i), files);
      if (hand_.links[i].parent >= 0) WriteJoint(hand_.links[i]);
    }
    xml_.CloseElement();
    return xml_.CStr();
  }

 private:
  void Open(const char* name) { xml_.OpenElement(name); }
  void Set(const char* name, const std::string& value) { xml_.PushAttribute(name, value.c_str()); }
  void WriteOrigin(const Pose& X) {
    Open("origin");
    Set("xyz", FormatExactly(X.translation()));
    Set("rpy", FormatExactly(CalcRollPitchYaw(X.linear())));
    xml_.CloseElement();
  }
  void WriteSolid(const CollisionShape& shape) {
    Open("geometry");
    if (shape.kind == CollisionShape::Kind::kSphere) {
      Open("sphere");
      Set("radius", FormatNumber(0.5 * shape.size.x()));
    } else if (shape.kind == CollisionShape::Kind::kCylinder) {
      Open("cylinder");
      Set("radius", FormatNumber(0.5 * shape.size.x()));
      Set("length", FormatNumber(shape.size.z()));
    } else {
      Open("box");
      Set("size", FormatVector(shape.size));
    }
    xml_.CloseElement();
    xml_.CloseElement();
  }
  void WriteLink(int index, std::map<std::string, std::string>& files) {
    const HandLink& link = hand_.links[index];
    Open("link");
    Set("name", link.name);
    if (link.mass > 0.0) WriteInertial(link);
    for (const ImportedHand::Visual& visual : imported_.visuals) {
      if (visual.link == index) WriteVisual(visual.visual, link.name, files);
    }
    for (const CollisionShape& shape : imported_.shapes) {
      if (shape.link != index) continue;
      Open("collision");
      if (shape.is_cover) Set("name", "cover");
      WriteOrigin(shape.X_LS);
      WriteSolid(shape);
      xml_.CloseElement();
    }
    xml_.CloseElement();
  }
  void WriteInertial(const HandLink& link) {
    Open("inertial");
    Open("origin");
    Set("xyz", FormatVector(link.p_LLcm));
    xml_.CloseElement();
    Open("mass");
    Set("value", FormatNumber(link.mass));
    xml_.CloseElement();
    Open("inertia");
    const char* const names[3][3] = {
        {"ixx", "ixy", "ixz"}, {"ixy", "iyy", "iyz"}, {"ixz", "iyz", "izz"}};
    for (int r = 0; r < 3; ++r) {
      for (int c = r; c < 3; ++c) Set(names[r][c], FormatNumber(link.I_LLcm(r, c)));
    }
    xml_.CloseElement();
    xml_.CloseElement();
  }
  void WriteVisual(const ImportedVisual& visual, const std::string& link,
                   std::map<std::string, std::string>& files) {
    Open("visual");
    if (visual.mesh.triangles.empty()) {
      WriteOrigin(visual.solid.X_LS);
      WriteSolid(visual.solid);
    } else {
      const std::string key = MakePlainKey({link, visual.name});
      std::string name = "meshes/" + key + ".obj";
      for (int n = 2; files.count(name) != 0; ++n) {
        name = "meshes/" + key + "-" + std::to_string(n) + ".obj";
      }
      files[name] = FormatObj(visual.mesh);
      Open("geometry");
      Open("mesh");
      Set("filename", name);
      xml_.CloseElement();
      xml_.CloseElement();
    }
    Open("material");
    Set("name", fmt::format("colour_{}", num_colours_++));
    Open("color");
    Set("rgba", FormatVector(visual.colour) + " 1");
    xml_.CloseElement();
    xml_.CloseElement();
    xml_.CloseElement();
  }
  void WriteJoint(const HandLink& link) {
    const HandJoint& joint = hand_.joints[link.joint];
    Open("joint");
    Set("name", joint.name);
    Set("type", joint.is_prismatic ? "prismatic" : "revolute");
    WriteOrigin(link.X_PJ);
    Open("parent");
    Set("link", hand_.links[link.parent].name);
    xml_.CloseElement();
    Open("child");
    Set("link", link.name);
    xml_.CloseElement();
    Open("axis");
    Set("xyz", FormatExactly(link.axis));
    xml_.CloseElement();
    Open("limit");
    Set("lower", FormatNumber(joint.lower));
    Set("upper", FormatNumber(joint.upper));
    Set("effort", FormatNumber(joint.drive.torque_limit));
    Set("velocity", "0");
    xml_.CloseElement();
    xml_.CloseElement();
  }

  const ImportedHand& imported_;
  const Hand& hand_;
  int num_colours_ = 1;
  tinyxml2::XMLPrinter xml_;
};

std::string JoinQuoted(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + QuoteYaml(name);
  return "[" + text + "]";
}

std::string FormatDigits(const Hand& hand) {
  std::string text =
      "digits:                      # guess: the chains of links that part from the palm\n";
  for (const Digit& digit : hand.digits) {
    std::vector<std::string> links;
    for (const int link : digit.links) links.push_back(hand.links[link].name);
    text += "  - id: " + digit.id + "\n    name: " + digit.name + "\n";
    if (digit.is_thumb)
      text += "    thumb: true              # guess: the digit that opposes the others\n";
    text += "    links: " + JoinQuoted(links) + "\n    tip_m: " + FormatPlace(digit.p_LTip) +
            "  # guess\n    pad_m: " + FormatPlace(digit.p_LPad) +
            "  # guess: where the last link faces when it closes\n";
  }
  return text;
}

std::string FormatFollowers(const Hand& hand) {
  std::string text, shared;
  for (const HandJoint& joint : hand.joints) {
    if (joint.coupled_to < 0) continue;
    const std::string name = QuoteYaml(joint.name),
                      other = QuoteYaml(hand.joints[joint.coupled_to].name);
    if (!joint.is_mimic) {
      shared += (shared.empty() ? "" : ", ") + name + ": " + other;
      continue;
    }
    text += "  - joint: " + name + "\n    follows: " + other +
            "\n    ratio: " + FormatNumber(joint.mimic_ratio) + "\n";
    if (joint.mimic_offset == 0.0) continue;
    text += joint.is_prismatic
                ? "    offset_mm: " + FormatNumber(MmFromM(joint.mimic_offset)) + "\n"
                : "    offset_deg: " + FormatNumber(DegFromRad(joint.mimic_offset)) + "\n";
  }
  if (!text.empty()) text = "mimic:                       # of the description\n" + text;
  if (shared.empty()) return text;
  return text + "coupling:                    # one drive pulls on both joints\n  rule: " +
         NameOf(hand.coupling) + "         # guess\n  joints: {" + shared + "}\n";
}

/** One entry for all joints with the same drive. */
std::string FormatDrives(const Hand& hand) {
  std::string text =
      "# Stiffness and damping are the description's where it has those of a position drive that "
      "can\n"
      "# hold a finger, else guesses (3 N m/rad or 3000 N/m, over 50 times the damping). The limit "
      "is\n"
      "# its effort where a hand's drive can have it, else 1 N m or 40 N, and no more than the "
      "weakest\n# published one of its digit.\ndrives:\n";
  std::set<int> done;
  for (int j = 0; j < hand.num_joints(); ++j) {
    const HandJoint& joint = hand.joints[j];
    if (joint.coupled_to >= 0 || done.count(j) != 0) continue;
    std::vector<std::string> names;
    for (int k = j; k < hand.num_joints(); ++k) {
      const HandJoint& other = hand.joints[k];
      if (other.coupled_to >= 0 || other.is_prismatic != joint.is_prismatic ||
          other.drive.torque_limit != joint.drive.torque_limit ||
          other.drive.stiffness != joint.drive.stiffness ||
          other.drive.damping != joint.drive.damping) {
        continue;
      }
      names.push_back(other.name);
      done.insert(k);
    }
    const bool slides = joint.is_prismatic;
    text += "  - joints: " + JoinQuoted(names) + "\n    " +
            (slides ? "stiffness_n_per_m: " : "stiffness_nm_per_rad: ") +
            FormatNumber(joint.drive.stiffness) + "\n    " +
            (slides ? "damping_ns_per_m: " : "damping_nms_per_rad: ") +
            FormatNumber(joint.drive.damping) + "\n    " +
            (slides ? "force_limit_n: " : "torque_limit_nm: ") +
            FormatNumber(joint.drive.torque_limit) + "\n";
  }
  return text;
}

std::string FormatYaml(const Hand& hand, const std::string& source) {
  std::string text = "# What hand.urdf cannot say about this hand, imported from " + source +
                     ".\n# Lines with \"guess\" were found from the tree and the shapes: look at "
                     "them, change what is\n"
                     "# wrong, then: graspbench hand check FOLDER. Metres, in the frame of the "
                     "link named. The format\n"
                     "# is explained by: graspbench help hand.yaml\n";
  text +=
      "name: " + QuoteYaml(hand.name) +
      "\npalm:\n  link: " + QuoteYaml(hand.links[hand.palm_link].name) +
      "                # guess: where the digits part\n  centre_m: " + FormatPlace(hand.p_HCentre) +
      "  # guess: middle of its surface\n  normal: " + FormatPlace(hand.palm_normal) +
      "    # guess: out of the palm; the hand approaches along it\n";
  text += "joint_accuracy_deg: " + FormatNumber(DegFromRad(hand.joint_accuracy)) +
          "        # guess: half-width of each drive's error from trial to trial\n";
  if (hand.slide_accuracy > 0.0) {
    text += "slide_accuracy_mm: " + FormatNumber(MmFromM(hand.slide_accuracy)) +
            "       # guess: the same of prismatic joints\n";
  }
  text += "pad_torsion_radius_m: 0.004  # guess: of soft pads; 0: hard\n\n";
  text += FormatDigits(hand) + "\n";
  const std::string followers = FormatFollowers(hand);
  text += followers + (followers.empty() ? "" : "\n") + FormatDrives(hand);
  if (!hand.apart.empty()) {
    text += "\napart:                       # guess: their shapes overlap where a joint may go\n";
  }
  for (const auto& [a, b] : hand.apart) {
    text += "  - " + JoinQuoted({hand.links[a].name, hand.links[b].name}) + "\n";
  }
  if (!hand.frames.empty()) {
    text += "\nframes:                      # of the description, fixed to links: hand fk --link\n";
  }
  for (const NamedFrame& frame : hand.frames) {
    text += "  - name: " + QuoteYaml(frame.name) +
            "\n    link: " + QuoteYaml(hand.links[frame.link].name) + "\n    position_m: [" +
            FormatExactly(frame.X_LF.translation(), ", ") + "]\n    rpy_rad: [" +
            FormatExactly(CalcRollPitchYaw(frame.X_LF.linear()), ", ") + "]\n";
  }
  return text + "\n# grasps: none yet; graspbench hand develop FOLDER --out DIR finds them.\n";
}

std::string FormatReadme(const ImportedHand& imported, const std::string& source,
                         const Diagnostics& problems) {
  std::string text = "# " + imported.hand.name + "\n\nImported from " + source +
                     ". What was repaired or guessed, with the line of the description:\n\n";
  std::vector<Diagnostic> entries = problems.entries();
  std::stable_sort(entries.begin(), entries.end(),
                   [](const Diagnostic& a, const Diagnostic& b) { return a.line < b.line; });
  for (const Diagnostic& problem : entries) {
    text += "- " + (problem.line > 0 ? "line " + std::to_string(problem.line) + ": " : "") +
            problem.text + "\n";
  }
  if (problems.entries().empty()) text += "- nothing\n";
  text += "\nMass and contact of each link, by the description's link:\n\n";
  for (const std::string& note : imported.notes) {
    size_t begin = 0;
    while (begin < note.size()) {
      const size_t end = std::min(note.find('\n', begin), note.size());
      text += "- " + note.substr(begin, end - begin) + "\n";
      begin = end + 1;
    }
  }
  return text;
}

}  // namespace

std::map<std::string, std::string> FormatHandFiles(const ImportedHand& imported,
                                                   const std::string& source,
                                                   const Diagnostics& problems) {
  std::map<std::string, std::string> files;
  files["hand.urdf"] = UrdfWriter(imported).Write(source, files);
  files["hand.yaml"] = FormatYaml(imported.hand, source);
  files["README.md"] = FormatReadme(imported, source, problems);
  return files;
}

}  // namespace graspbench
