#include "core/grasp/grasp_file.h"

#include <algorithm>
#include <cmath>

#include "core/base/files/files.h"
#include "core/base/text/text.h"
#include "core/base/text/yaml.h"
#include "core/base/units.h"
#include "core/grasp/grasp_yaml.h"
#include "core/grasp/placement.h"
#include "core/grasp/standard_grasp.h"

namespace graspbench {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr char kFormat[] = "graspbench grasp";
constexpr int kFormatVersion = 1;
constexpr double kUnitTolerance = 1e-3;  ///< tolerance of the length of unit vectors

std::string FormatList(const std::vector<double>& values) {
  std::string text;
  for (const double value : values) {
    text += (text.empty() ? "" : ", ") + FormatFixed(value, 9);
  }
  return "[" + text + "]";
}

/** Of the two quaternions of a rotation, returns the one with w >= 0. */
Quaterniond MakeQuaternion(const Pose& X) {
  Quaterniond quaternion(X.linear());
  if (quaternion.w() < 0.0) quaternion.coeffs() = -quaternion.coeffs();
  return quaternion;
}

Placement ReadPlacement(const YAML::Node& node, const std::string& file, Diagnostics& problems) {
  YamlMap map(node, file, "placement", problems, &ListGraspFileKeys(), "placement.");
  Placement placement;
  Vector3d p_WH = Vector3d::Zero();
  std::vector<double> wxyz = {1.0, 0.0, 0.0, 0.0};
  map.Read("position_m", p_WH);
  map.Read("orientation_wxyz", wxyz);
  map.Read("approach", placement.approach_W);
  map.Read("closing_at_contact", placement.closing_at_contact);
  map.FinishKnownKeys();
  if (wxyz.size() != 4) {
    map.Fail("orientation_wxyz", "expected four numbers, w first");
    return placement;
  }
  const Quaterniond quaternion(wxyz[0], wxyz[1], wxyz[2], wxyz[3]);
  if (std::abs(quaternion.norm() - 1.0) > kUnitTolerance) {
    map.Fail("orientation_wxyz", "expected a quaternion of length one, found length " +
                                     FormatFixed(quaternion.norm(), 3));
    return placement;
  }
  if (std::abs(placement.approach_W.norm() - 1.0) > kUnitTolerance) {
    map.Fail("approach", "expected a direction of length one, found length " +
                             FormatFixed(placement.approach_W.norm(), 3));
    return placement;
  }
  placement.X_WH = MakePose(quaternion.normalized().toRotationMatrix(), p_WH);
  placement.approach_W.normalize();
  return placement;
}

/** The digits' closings, each as long as the course. */
void ReadCourseClosing(const YAML::Node& node, const std::string& file,
                       const std::vector<std::string>& digits, Diagnostics& problems,
                       GraspCourse& course) {
  YamlMap map(node, file, "course.closing", problems);
  for (const std::string& digit : digits) {
    std::vector<double>& closing = course.closing[digit];
    map.Read(digit, closing);
    if (!map.Has(digit)) continue;
    if (closing.size() != course.p_HAway.size()) {
      map.Fail(digit, "expected " + std::to_string(course.p_HAway.size()) +
                          " values, one for each of x_m, found " + std::to_string(closing.size()));
    }
    for (const double s : closing) {
      if (s >= 0.0 && s <= 1.0) continue;
      map.Fail(digit, "expected values from 0 to 1, found " + FormatFixed(s, 3));
      break;
    }
  }
  map.FinishKnownKeys();
}

GraspCourse ReadCourse(const YAML::Node& node, const std::string& file, const Grasp& grasp,
                       Diagnostics& problems) {
  constexpr double kAtGrasp = 1e-6;  ///< of the last position [m]
  YamlMap map(node, file, "course", problems, &ListGraspFileKeys(), "course.");
  GraspCourse course;
  std::vector<double> x, y, z;
  map.Read("period_s", course.period);
  map.Read("closure_start_s", course.closure_start);
  map.Read("x_m", x);
  map.Read("y_m", y);
  map.Read("z_m", z);
  const YAML::Node closing = map.Child("closing");
  map.FinishKnownKeys();
  if (x.size() < 2 || y.size() != x.size() || z.size() != x.size()) {
    map.Fail("x_m", "expected x_m, y_m and z_m with as many values, two or more; found " +
                        std::to_string(x.size()) + ", " + std::to_string(y.size()) + " and " +
                        std::to_string(z.size()));
    return {};
  }
  for (size_t k = 0; k < x.size(); ++k) course.p_HAway.emplace_back(x[k], y[k], z[k]);
  if (course.p_HAway.back().norm() > kAtGrasp) {
    map.Fail("x_m", "the hand ends " + FormatFixed(MmFromM(course.p_HAway.back().norm()), 3) +
                        " mm from its grasp position; expected zero at the end");
  }
  if (course.closure_start > course.duration()) {
    map.Fail("closure_start_s",
             "is after the end of the course at " + FormatFixed(course.duration(), 3) + " s");
  }
  if (grasp.seeks_palm) {
    map.Fail("x_m", "a hand that seeks the palm goes its own way; remove course or seeks_palm");
  }
  if (!closing.IsNull()) ReadCourseClosing(closing, file, grasp.digits, problems, course);
  return course;
}

/** Returns the standard grasp that gives type, d and alpha. If it does not exist, reports a problem
and returns the first one. */
const GraspTaxon& ReadTaxon(YamlMap& map) {
  std::string made_from;
  map.Read("made_from", made_from);
  std::vector<std::string> known;
  for (const GraspTaxon& taxon : ListGraspTaxa()) {
    if (taxon.id == made_from) return taxon;
    known.push_back(taxon.id);
  }
  if (!made_from.empty()) {
    map.Fail("made_from",
             "no standard grasp \"" + made_from + "\"" + SuggestNames(made_from, known));
  }
  return ListGraspTaxa().front();
}

void ReadHeader(YamlMap& map, const std::string& file) {
  std::string format;
  int version = kFormatVersion;
  map.Read("format", format);
  map.Read("format_version", version);
  if (!format.empty() && format != kFormat) {
    // The keys of another format would all be unknown here.
    throw Error(ErrorKind::kFormat, file + ": expected the format \"" + kFormat + "\", found \"" +
                                        format +
                                        "\"; grasps of other tools are judged by: graspbench "
                                        "grasps judge " +
                                        file + " --objects DIR --out DIR");
  }
  if (version != kFormatVersion) {
    map.Fail("format_version", "this program reads version " + std::to_string(kFormatVersion) +
                                   ", found " + std::to_string(version));
  }
}

const Hand* ReadHand(YamlMap& map, const std::vector<const Hand*>& hands) {
  std::string id;
  map.Read("hand", id);
  std::string known;
  for (const Hand* hand : hands) {
    if (hand->id == id) return hand;
    known += (known.empty() ? "" : ", ") + hand->id;
  }
  if (!id.empty()) {
    map.Fail("hand", "the grasp is for the hand \"" + id +
                         "\", which is not in use here; in use: " + known);
  }
  return nullptr;
}

}  // namespace

GraspFile LoadGraspFile(const std::string& path, const std::vector<const Hand*>& hands) {
  return ParseGraspFile(ReadFile(path), path, hands);
}

GraspFile ParseGraspFile(const std::string& text, const std::string& file,
                         const std::vector<const Hand*>& hands) {
  Diagnostics problems;
  const YAML::Node root = ParseYaml(text, file, problems);
  problems.ThrowIfErrors(ErrorKind::kFormat, "the grasp cannot be read");

  YamlMap map(root, file, "grasp", problems, &ListGraspFileKeys());
  ReadHeader(map, file);
  const GraspTaxon& taxon = ReadTaxon(map);
  const Hand* hand = ReadHand(map, hands);
  GraspFile result;
  if (hand) result.hand = hand->id;
  Grasp& grasp = result.grasp;
  grasp = ReadGrasp(hand, taxon, {map, ListGraspFileKeys(), "", file, "", problems});
  grasp.id.clear();
  map.Read("id", grasp.id);
  map.Read("object", grasp.object, Needed::kNo);
  const auto& taxa = ListGraspTaxa();
  if (std::any_of(taxa.begin(), taxa.end(), [&](const auto& t) { return t.id == grasp.id; })) {
    map.Fail("id", "\"" + grasp.id + "\" is the name of a standard grasp; choose another");
  }
  const YAML::Node placement = map.Child("placement", Needed::kNo);
  if (!placement.IsNull()) grasp.placement = ReadPlacement(placement, file, problems);
  const YAML::Node course = map.Child("course", Needed::kNo);
  if (!course.IsNull()) grasp.course = ReadCourse(course, file, grasp, problems);
  map.FinishKnownKeys();
  problems.ThrowIfErrors(ErrorKind::kFormat, "the grasp cannot be used");
  return result;
}

namespace {

std::string FormatCourse(const GraspCourse& course) {
  std::string away, closing;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    std::vector<double> values;
    for (const Vector3d& p : course.p_HAway) values.push_back(p[axis]);
    away += std::string("\n  ") + "xyz"[axis] + "_m: " + FormatList(values);
  }
  for (const auto& [digit, values] : course.closing) {
    closing += "    " + FormatYamlWord(digit) + ": " + FormatList(values) + "\n";
  }
  return "course:\n  period_s: " + FormatFixed(course.period, 9) +
         "\n  closure_start_s: " + FormatFixed(course.closure_start, 9) + away + "\n  closing:\n" +
         closing;
}

}  // namespace

std::string FormatGraspFile(const Hand& hand, const Grasp& grasp, const std::string& made_from) {
  std::string digits;
  for (const std::string& digit : grasp.digits) {
    digits += (digits.empty() ? "" : ", ") + FormatYamlWord(digit);
  }
  std::string text = std::string("format: ") + kFormat +
                     "\nformat_version: " + std::to_string(kFormatVersion) +
                     "\nid: " + FormatYamlWord(grasp.id) + "\nhand: " + FormatYamlWord(hand.id) +
                     "\nmade_from: " + made_from;
  if (!grasp.object.empty()) text += "\nobject: " + FormatYamlWord(grasp.object);
  text += "\ndigits: [" + digits + "]\ntilt_deg: " + FormatFixed(DegFromRad(grasp.tilt), 6) +
          "\npalm_may_touch: " + (grasp.palm_may_touch ? "true" : "false");
  if (grasp.palm_gap != kPalmGap) text += "\npalm_gap_m: " + FormatFixed(grasp.palm_gap, 6);
  if (grasp.seeks_palm) text += "\nseeks_palm: true";
  if (!grasp.closing.empty()) text += "\nclosing: " + FormatClosing(grasp);
  if (grasp.approach != Approach::kAutomatic) {
    text += std::string("\napproach: ") + RowOf(kApproaches, grasp.approach).name;
  }
  text += "\n# driven joints of each digit, from base to tip\npre_deg: " +
          FormatPosture(hand, grasp.q_pre) +
          "\ntarget_deg: " + FormatPosture(hand, grasp.q_target) + "\n";
  if (grasp.placement) {
    const Vector3d p = grasp.placement->X_WH.translation(), a = grasp.placement->approach_W;
    const Quaterniond q = MakeQuaternion(grasp.placement->X_WH);
    text += "placement:\n  position_m: " + FormatList({p.x(), p.y(), p.z()}) +
            "\n  orientation_wxyz: " + FormatList({q.w(), q.x(), q.y(), q.z()}) +
            "\n  approach: " + FormatList({a.x(), a.y(), a.z()}) +
            "\n  closing_at_contact: " + FormatFixed(grasp.placement->closing_at_contact, 9) + "\n";
  }
  if (grasp.course.is_set()) text += FormatCourse(grasp.course);
  return text;
}

std::string FormatIsaacGrasp(const Hand& hand, const Grasp& grasp, const std::string& object_id,
                             const Vector3d& object_size, const Vector3d& p_OOcm,
                             double confidence) {
  Pose X_OH = CalcPlacement(hand, grasp, object_size, p_OOcm).X_WH;
  X_OH.pretranslate(Vector3d(0.0, 0.0, -0.5 * object_size.z()));
  const HandLink& root = hand.links.front();
  const Pose X_OR = X_OH * root.X_PJ;
  const Vector3d p = X_OR.translation();
  const Quaterniond q = MakeQuaternion(X_OR);
  const auto format_joints = [&](const Eigen::VectorXd& angles) {
    std::string lines;
    for (int joint = 0; joint < hand.num_joints(); ++joint) {
      lines += "      " + FormatYamlWord(hand.joints[static_cast<size_t>(joint)].name) + ": " +
               FormatFixed(angles[joint], 9) + "\n";
    }
    return lines;
  };
  return "format: isaac_grasp\nformat_version: 1.0\n\nobject_frame: " + FormatYamlWord(object_id) +
         "\ngripper_frame: " + FormatYamlWord(root.name) + "\n\ngrasps:\n  " + QuoteYaml(grasp.id) +
         ":\n    confidence: " + FormatFixed(confidence, 3) +
         "\n    position: " + FormatList({p.x(), p.y(), p.z()}) +
         "\n    orientation: {w: " + FormatFixed(q.w(), 9) +
         ", xyz: " + FormatList({q.x(), q.y(), q.z()}) + "}\n    cspace_position:\n" +
         format_joints(grasp.q_target) + "    pregrasp_cspace_position:\n" +
         format_joints(grasp.q_pre);
}

}  // namespace graspbench
