#include "core/hand/import/write_hand.h"

#include <fmt/core.h>
#include <tinyxml2.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <set>
#include <utility>
#include <vector>

#include "core/base/files/files.h"
#include "core/base/hash.h"
#include "core/base/pose.h"
#include "core/base/text/json.h"
#include "core/base/text/text.h"
#include "core/base/text/yaml.h"
#include "core/base/units.h"
#include "core/base/version.h"
#include "core/hand/import/checks/find_implausible.h"
#include "core/shape/obj_file.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

Json DescribeGuesses(const Hand& hand) {
  Json digits = Json::array();
  for (const Digit& digit : hand.digits) {
    Json links = Json::array();
    for (const int link : digit.links) links.push_back(hand.links[link].name);
    digits.push_back({{"id", digit.id},
                      {"thumb", digit.is_thumb},
                      {"links", links},
                      {"tip_m", JsonVector(digit.p_LTip)},
                      {"pad_m", JsonVector(digit.p_LPad)}});
  }
  Json apart = Json::array();
  for (const auto& [a, b] : hand.apart) {
    apart.push_back({hand.links[a].name, hand.links[b].name});
  }
  Json drives = Json::array();
  for (const HandJoint& joint : hand.joints) {
    if (joint.coupled_to >= 0) continue;
    drives.push_back({{"joint", joint.name},
                      {"stiffness", JsonNumber(joint.drive.stiffness)},
                      {"damping", JsonNumber(joint.drive.damping)},
                      {"limit", JsonNumber(joint.drive.torque_limit)}});
  }
  return {{"palm",
           {{"link", hand.links[hand.palm_link].name},
            {"centre_m", JsonVector(hand.p_HCentre)},
            {"normal", JsonVector(hand.palm_normal)}}},
          {"longest_digit_m", JsonNumber(CalcLongestDigit(hand))},
          {"digits", digits},
          {"apart", apart},
          {"drives", drives}};
}

/** Paths as relative to the description's folder. */
Json ListPackagePath(const HandSource& source) {
  Json paths = Json::array();
  const auto make_absolute = [](const std::filesystem::path& path) {
    const std::filesystem::path absolute = std::filesystem::absolute(path).lexically_normal();
    return absolute.has_filename() ? absolute : absolute.parent_path();  // "ros/" is "ros"
  };
  for (const std::filesystem::path& path : source.package_path) {
    paths.push_back(
        make_absolute(path).lexically_relative(make_absolute(source.folder)).generic_string());
  }
  return paths;
}

Json HashFiles(const std::set<std::filesystem::path>& paths) {
  Json hashes = Json::object();
  for (const std::filesystem::path& path : paths) {
    const std::string name = path.filename().string();
    std::string key = name;
    for (int n = 2; hashes.contains(key); ++n) key = name + " (" + std::to_string(n) + ")";
    hashes[key] = CalcSha256(ReadFile(path));
  }
  return hashes;
}

}  // namespace

Json MakeContactJson(const std::vector<ContactFit>& fits) {
  Json list = Json::array();
  const auto round = [](const ContactError& error) {
    return Json{{"at_95_mm", std::round(error.at_95 * 1e5) / 1e2},
                {"most_mm", std::round(error.most * 1e5) / 1e2}};
  };
  for (const ContactFit& fit : fits) {
    list.push_back({{"link", fit.link},
                    {"balls", fit.num_balls},
                    {"out", round(fit.out)},
                    {"sink", round(fit.sink)},
                    {"palmar_out", round(fit.palmar_out)},
                    {"palmar_sink", round(fit.palmar_sink)},
                    {"self_contact",
                     {{"capsules", fit.num_capsules},
                      {"within_5_mm", std::round(fit.self_contact * 1e3) / 1e3}}}});
  }
  return list;
}

std::vector<ContactFit> ReadContactFits(const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / "import.json";
  if (!std::filesystem::exists(path)) return {};
  const auto read = [](const Json& json) {
    return ContactError{1e-3 * json.at("at_95_mm").get<double>(),
                        1e-3 * json.at("most_mm").get<double>()};
  };
  std::vector<ContactFit> fits;
  try {
    const Json record = Json::parse(ReadFile(path));
    if (record.at("files").at("hand.urdf").get<std::string>() !=
        CalcSha256(ReadFile(folder / "hand.urdf"))) {
      return {};
    }
    for (const Json& fit : record.at("contact")) {
      const Json& self_contact = fit.at("self_contact");
      fits.push_back({fit.at("link").get<std::string>(), fit.at("balls").get<int>(),
                      read(fit.at("out")), read(fit.at("sink")), read(fit.at("palmar_out")),
                      read(fit.at("palmar_sink")), self_contact.at("capsules").get<int>(),
                      self_contact.at("within_5_mm").get<double>()});
    }
  } catch (const Json::exception& error) {
    throw Error(ErrorKind::kFormat, path.string() + ": " + error.what());
  }
  return fits;
}

std::string FormatImportRecord(const std::string& text, const std::set<std::filesystem::path>& read,
                               const HandSource& source, const std::string& palm,
                               const ImportedHand& imported, const Diagnostics& problems,
                               const std::map<std::string, std::string>& files) {
  Json repairs = Json::array();
  for (const Diagnostic& problem : problems.entries()) {
    repairs.push_back({{"line", problem.line}, {"text", problem.text}});
  }
  Json hashes = Json::object();
  for (const auto& [name, content] : files) hashes[name] = CalcSha256(content);
  const Json record = {
      {"format", 1},
      {"tool", std::string("graspbench ") + program_version()},
      {"source",
       {{"file", std::filesystem::path(source.file).filename().string()},
        {"sha256", CalcSha256(text)}}},
      {"read", HashFiles(read)},
      {"options",
       {{"palm", palm},
        {"palm_normal", source.palm_normal ? JsonVector(*source.palm_normal) : Json(nullptr)},
        {"unit_m", source.unit},
        {"mesh_unit_m", source.mesh_unit},
        {"package_path", ListPackagePath(source)},
        {"angle", !source.in_degrees   ? ""
                  : *source.in_degrees ? "deg"
                                       : "rad"}}},
      {"repairs", repairs},
      {"contact", MakeContactJson(imported.fits)},
      {"guesses", DescribeGuesses(imported.hand)},
      {"files", hashes}};
  return FormatJson(record, 2) + "\n";
}

namespace {

/** Formats nine digits, without the sign of a negative zero. */
std::string FormatNumber(double value) { return fmt::format("{:.9g}", value + 0.0); }

/** Formats a position or angle, exact to 1e-12, so that a chain of them is exact to a nanometre. */
std::string FormatExactly(const Vector3d& v, const char* separator = " ") {
  return fmt::format("{:.12g}{}{:.12g}{}{:.12g}", v.x() + 0.0, separator, v.y() + 0.0, separator,
                     v.z() + 0.0);
}

std::string FormatVector(const Vector3d& v, const char* separator = " ") {
  return FormatNumber(v.x()) + separator + FormatNumber(v.y()) + separator + FormatNumber(v.z());
}

/** Rounds to 10 micrometres, as a guess is. */
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
    Add("robot", {{"name", hand_.name}}, [&] {
      for (size_t i = 0; i < hand_.links.size(); ++i) {
        AddLink(static_cast<int>(i), files);
        if (hand_.links[i].parent >= 0) AddJoint(hand_.links[i]);
      }
    });
    return xml_.CStr();
  }

 private:
  using Attributes = std::vector<std::pair<const char*, std::string>>;

  /** Writes an element with the content that `add_content` adds. */
  void Add(
      const char* name, const Attributes& attributes,
      const std::function<void()>& add_content = [] {}) {
    xml_.OpenElement(name);
    for (const auto& [key, value] : attributes) xml_.PushAttribute(key, value.c_str());
    add_content();
    xml_.CloseElement();
  }
  void AddOrigin(const Pose& X) {
    Add("origin", {{"xyz", FormatExactly(X.translation())},
                   {"rpy", FormatExactly(CalcRollPitchYaw(X.linear()))}});
  }
  void AddSolid(const CollisionShape& shape) {
    const std::string radius = FormatNumber(0.5 * shape.size.x());
    Add("geometry", {}, [&] {
      if (shape.kind == CollisionShape::Kind::kSphere) {
        Add("sphere", {{"radius", radius}});
      } else if (shape.kind == CollisionShape::Kind::kCylinder) {
        Add("cylinder", {{"radius", radius}, {"length", FormatNumber(shape.size.z())}});
      } else {
        Add("box", {{"size", FormatVector(shape.size)}});
      }
    });
  }
  void AddLink(int index, std::map<std::string, std::string>& files) {
    const HandLink& link = hand_.links[index];
    Add("link", {{"name", link.name}}, [&] {
      if (link.mass > 0.0) AddInertial(link);
      for (const ImportedHand::Visual& visual : imported_.visuals) {
        if (visual.link == index) AddVisual(visual.visual, link.name, files);
      }
      for (const CollisionShape& shape : imported_.shapes) {
        if (shape.link != index) continue;
        const Attributes name = shape.is_cover          ? Attributes{{"name", "cover"}}
                                : shape.is_self_contact ? Attributes{{"name", "self_contact"}}
                                                        : Attributes();
        Add("collision", name, [&] {
          AddOrigin(shape.X_LS);
          AddSolid(shape);
        });
      }
    });
  }
  void AddInertial(const HandLink& link) {
    Add("inertial", {}, [&] {
      const Eigen::Matrix3d& I = link.I_LLcm;
      Add("origin", {{"xyz", FormatVector(link.p_LLcm)}});
      Add("mass", {{"value", FormatNumber(link.mass)}});
      Add("inertia", {{"ixx", FormatNumber(I(0, 0))},
                      {"ixy", FormatNumber(I(0, 1))},
                      {"ixz", FormatNumber(I(0, 2))},
                      {"iyy", FormatNumber(I(1, 1))},
                      {"iyz", FormatNumber(I(1, 2))},
                      {"izz", FormatNumber(I(2, 2))}});
    });
  }
  void AddVisual(const ImportedVisual& visual, const std::string& link,
                 std::map<std::string, std::string>& files) {
    Add("visual", {}, [&] {
      if (visual.mesh.triangles.empty()) {
        AddOrigin(visual.solid.X_LS);
        AddSolid(visual.solid);
      } else {
        const std::string key = MakePlainKey({link, visual.name});
        std::string name = "meshes/" + key + ".obj";
        for (int n = 2; files.count(name) != 0; ++n) {
          name = "meshes/" + key + "-" + std::to_string(n) + ".obj";
        }
        files[name] = FormatObj(visual.mesh);
        Add("geometry", {}, [&] { Add("mesh", {{"filename", name}}); });
      }
      Add("material", {{"name", fmt::format("colour_{}", num_colours_++)}}, [&] {
        Add("color", {{"rgba", FormatVector(visual.colour) + " 1"}});
      });
    });
  }
  void AddJoint(const HandLink& link) {
    if (link.joint < 0) {
      Add("joint", {{"name", "fixed_" + link.name}, {"type", "fixed"}}, [&] {
        AddOrigin(link.X_PJ);
        Add("parent", {{"link", hand_.links[link.parent].name}});
        Add("child", {{"link", link.name}});
      });
      return;
    }
    const HandJoint& joint = hand_.joints[link.joint];
    Add("joint", {{"name", joint.name}, {"type", joint.is_prismatic ? "prismatic" : "revolute"}},
        [&] {
          AddOrigin(link.X_PJ);
          Add("parent", {{"link", hand_.links[link.parent].name}});
          Add("child", {{"link", link.name}});
          Add("axis", {{"xyz", FormatExactly(link.axis)}});
          Add("limit", {{"lower", FormatNumber(joint.lower)},
                        {"upper", FormatNumber(joint.upper)},
                        {"effort", FormatNumber(joint.drive.torque_limit)},
                        {"velocity", "0"}});
        });
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

/** Writes one entry for all joints with the same drive. */
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
