#include "workbench/tables/hand_tables.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/text/text.h"
#include "core/base/units.h"
#include "core/grasp/standard_grasp.h"
#include "core/hand/load_hand.h"
#include "objects/catalogue.h"
#include "workbench/tables/text_table.h"

namespace graspbench {

namespace {

constexpr char kGuessMark[] = "*";  // behind a size

std::string FormatBestGrasps(const GraspObject& object) {
  std::string text;
  for (const auto& [hand, grasp] : object.best_grasp) {
    text += (text.empty() ? "" : ", ") + hand + " " + grasp;
  }
  return text;
}

}  // namespace

Json MakeObjectJson(const GraspObject& object) {
  Json json{{"id", object.id},
            {"name", object.name},
            {"mass_kg", object.mass_properties.mass},
            {"size_m", JsonVector(object.size)},
            {"centre_of_mass_m", JsonVector(object.mass_properties.p_OOcm)},
            {"friction_static", object.surface.friction_static},
            {"friction_dynamic", object.surface.friction_dynamic},
            {"best_grasp", object.best_grasp},
            {"triangles", object.mesh.num_triangles()},
            {"turned_to_rest_deg", DegFromRad(object.turned_to_rest)}};
  if (object.compressible) {
    json["compressible"] = {{"force_n", object.compressible->force},
                            {"sight_m", JsonVector(object.size)},
                            {"grasp_m", JsonVector(CalcSizeOfGrasp(object))},
                            {"sight_guessed", object.compressible->is_sight_guessed}};
  }
  return json;
}

DescribedObjects DescribeObjects() {
  Json list = Json::array();
  TextTable table({"id", "mass [g]", "length x width x height [mm]", "mu_s", "mu_d", "best grasp"});
  for (const std::string& id : ListObjects()) {
    const auto object = LoadObject(id);
    const bool is_guess = object->compressible && object->compressible->is_sight_guessed;
    list.push_back(MakeObjectJson(*object));
    table.AddRow({id, FormatFixed(GFromKg(object->mass_properties.mass), 1),
                  FormatSizeInMm(object->size, 1) + (is_guess ? kGuessMark : ""),
                  FormatFixed(object->surface.friction_static, 2),
                  FormatFixed(object->surface.friction_dynamic, 2), FormatBestGrasps(*object)});
  }
  return {Json{{"objects", list}},
          table.Format() + "\n* compressible; the size at rest is a guess\n"};
}

namespace {

/** Nothing of a rigid object. */
std::string FormatCompression(const GraspObject& object) {
  if (!object.compressible) return "";
  return "compressed      " + DescribeCompression(object) + "\n";
}

/** Nothing of an object that lies as it rests. */
std::string FormatRest(const GraspObject& object) {
  if (object.turned_to_rest == 0.0) return "";
  return "rest            turned by " + FormatFixed(DegFromRad(object.turned_to_rest), 2) +
         " deg relative to its mesh; sizes are those at rest\n";
}

}  // namespace

std::string FormatObject(const GraspObject& object) {
  const MassProperties& solid = object.mass_properties;
  return object.name + " (" + object.id + ")\n\nmass            " +
         FormatFixed(GFromKg(solid.mass), 1) + " g\nsize            " +
         FormatSizeInMm(object.size, 1) + " mm\n" + FormatCompression(object) +
         "centre of mass  (" + FormatFixed(MmFromM(solid.p_OOcm.x()), 1) + ", " +
         FormatFixed(MmFromM(solid.p_OOcm.y()), 1) + ", " +
         FormatFixed(MmFromM(solid.p_OOcm.z()), 1) + ") mm from the centre\nfriction        " +
         FormatFixed(object.surface.friction_static, 2) + " static, " +
         FormatFixed(object.surface.friction_dynamic, 2) + " dynamic\nbest grasp      " +
         FormatBestGrasps(object) + "\nmesh            " +
         std::to_string(object.mesh.num_triangles()) + " triangles\n" + FormatRest(object);
}

std::string FormatMeshSummary(const std::string& path, const MeshReport& report) {
  std::string text;
  for (const std::string& warning : report.warnings) text += "warning: " + warning + "\n";
  if (!report.problems.empty()) text += FormatProblems(report) + "\n";
  return text + path + ": " + FormatCount(report.num_triangles, "triangle") + ", " +
         (report.is_closed ? "closed" : FormatCount(report.num_open_edges, "open edge")) + ", " +
         FormatSizeInMm(report.extent, 1) + " mm; " +
         (report.problems.empty() ? "can be used\n" : "cannot be used\n");
}

std::string FormatRepair(const std::string& path, const MeshFileRepair& repair) {
  std::string text;
  for (const std::string& action : repair.actions) text += "repair: " + action + "\n";
  if (repair.is_written) {
    text += FormatMeshSummary(path, repair.report);
  } else if (repair.actions.empty()) {
    text += "repair: no unambiguous repair is possible; no file written\n";
  } else {
    text += FormatProblems(repair.report) +
            "\nrepair: the repaired mesh is unusable, too; no file written\n";
  }
  return text;
}

namespace {

int CountDrivenJoints(const Hand& hand) {
  return static_cast<int>(std::count_if(hand.joints.begin(), hand.joints.end(),
                                        [](const HandJoint& j) { return j.coupled_to < 0; }));
}

std::vector<std::string> ListDigits(const Hand& hand) {
  std::vector<std::string> ids;
  for (const Digit& digit : hand.digits) ids.push_back(digit.id);
  return ids;
}

std::vector<std::string> ListGrasps(const Hand& hand) {
  std::vector<std::string> ids;
  for (const Grasp& grasp : LoadStandardGrasps(hand)) ids.push_back(grasp.id);
  return ids;
}

/** True when the hand's coupling rule moves a joint. */
bool HasCoupling(const Hand& hand) {
  return std::any_of(hand.joints.begin(), hand.joints.end(), [](const HandJoint& joint) {
    return joint.coupled_to >= 0 && !joint.is_mimic;
  });
}

std::string FormatCoupling(const Hand& hand) {
  return HasCoupling(hand) ? "\ncoupling        " + NameOf(hand.coupling) : "";
}

std::string JoinIds(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
  return text;
}

}  // namespace

DescribedHands DescribeHands() {
  Json list = Json::array();
  TextTable table({"id", "name", "digits", "joints", "driven", "grasps"});
  for (const std::string& id : ListHands()) {
    const Hand hand = LoadHand(id);
    list.push_back({{"id", id},
                    {"name", hand.name},
                    {"digits", ListDigits(hand)},
                    {"joints", hand.num_joints()},
                    {"driven", CountDrivenJoints(hand)},
                    {"grasps", ListGrasps(hand)}});
    table.AddRow({id, hand.name, JoinIds(ListDigits(hand)), std::to_string(hand.num_joints()),
                  std::to_string(CountDrivenJoints(hand)), JoinIds(ListGrasps(hand))});
  }
  return {Json{{"hands", list}}, table.Format()};
}

namespace {

/** "FFq3", or of a linkage "-1 x finger_joint + 5.7 deg". */
std::string FormatFollowed(const Hand& hand, const HandJoint& joint) {
  const std::string& name = hand.joints[joint.coupled_to].name;
  if (!joint.is_mimic) return name;
  const double offset = ToDisplayUnits(joint, joint.mimic_offset);
  return FormatSignificant(joint.mimic_ratio, 3) + " x " + name +
         (offset == 0.0 ? ""
                        : (offset < 0.0 ? " - " : " + ") + FormatSignificant(std::abs(offset), 3) +
                              " " + DisplayUnitOf(joint));
}

}  // namespace

Json MakeHandJson(const Hand& hand) {
  Json joints = Json::array();
  for (const HandJoint& joint : hand.joints) {
    Json entry = {{"name", joint.name}};
    const std::string unit = DisplayUnitOf(joint);
    entry["lower_" + unit] = ToDisplayUnits(joint, joint.lower);
    entry["upper_" + unit] = ToDisplayUnits(joint, joint.upper);
    if (joint.coupled_to >= 0) {
      entry["coupled_to"] = hand.joints[joint.coupled_to].name;
      if (joint.is_mimic) {
        entry["ratio"] = joint.mimic_ratio;
        entry["offset_" + unit] = ToDisplayUnits(joint, joint.mimic_offset);
      }
    } else if (joint.is_prismatic) {
      entry["stiffness_n_per_m"] = joint.drive.stiffness;
      entry["damping_ns_per_m"] = joint.drive.damping;
      entry["force_limit_n"] = joint.drive.torque_limit;
    } else {
      entry["stiffness_nm_per_rad"] = joint.drive.stiffness;
      entry["damping_nms_per_rad"] = joint.drive.damping;
      entry["torque_limit_nm"] = joint.drive.torque_limit;
    }
    joints.push_back(entry);
  }
  double mass = 0.0;
  for (const HandLink& link : hand.links) mass += link.mass;
  return {{"id", hand.id},
          {"name", hand.name},
          {"mass_kg", mass},
          {"digits", ListDigits(hand)},
          {"grasps", ListGrasps(hand)},
          {"coupling", HasCoupling(hand) ? Json(NameOf(hand.coupling)) : Json(nullptr)},
          {"joint_accuracy_deg", DegFromRad(hand.joint_accuracy)},
          {"joints", joints}};
}

std::string FormatHand(const Hand& hand) {
  const Json description = MakeHandJson(hand);
  std::string text = hand.name + " (" + hand.id + ")\n\nmass            " +
                     FormatSignificant(description["mass_kg"].get<double>(), 3) +
                     " kg\ndigits          " + JoinIds(ListDigits(hand)) + "\ngrasps          " +
                     JoinIds(ListGrasps(hand)) + FormatCoupling(hand) + "\njoint accuracy  +-" +
                     FormatSignificant(DegFromRad(hand.joint_accuracy), 3) + " deg\n\n";
  TextTable table({"joint", "lower [deg]", "upper [deg]", "stiffness [N m/rad]",
                   "torque limit [N m]", "follows"});
  for (const HandJoint& joint : hand.joints) {
    const bool is_coupled = joint.coupled_to >= 0;
    const bool slides = joint.is_prismatic;
    const auto format_position = [&](double q) {
      return FormatFixed(ToDisplayUnits(joint, q), 1) + (slides ? " mm" : "");
    };
    table.AddRow(
        {joint.name, format_position(joint.lower), format_position(joint.upper),
         is_coupled ? "-" : FormatSignificant(joint.drive.stiffness, 3) + (slides ? " N/m" : ""),
         is_coupled ? "-" : FormatSignificant(joint.drive.torque_limit, 3) + (slides ? " N" : ""),
         is_coupled ? FormatFollowed(hand, joint) : ""});
  }
  return text + table.Format();
}

std::string FormatContact(const std::vector<ContactFit>& fits) {
  if (fits.empty()) return "";
  TextTable table(
      {"link", "balls", "out [mm]", "palmar", "sink [mm]", "palmar", "capsules", "near [%]"});
  const auto format = [](const ContactError& error) {
    return FormatFixed(MmFromM(error.at_95), 1) + " / " + FormatFixed(MmFromM(error.most), 1);
  };
  for (const ContactFit& fit : fits) {
    table.AddRow({fit.link, std::to_string(fit.num_balls), format(fit.out), format(fit.palmar_out),
                  format(fit.sink), format(fit.palmar_sink), std::to_string(fit.num_capsules),
                  FormatFixed(100.0 * fit.self_contact, 0)});
  }
  return "\ncontact fit of each link (below 1 mm is good), 95th percentile / maximum: out, how far "
         "contact balls\nstick out of the surface; sink, how far a ball of 5 mm sinks in; all "
         "around "
         "and on the palmar side.\nCapsules serve contact with the hand itself; near, the share of "
         "the surface within 5 mm of them\n" +
         table.Format();
}

std::string DescribeCoarseContact(const std::vector<ContactFit>& fits, const std::string& surface) {
  int64_t num_links = 0;
  const ContactFit* worst = nullptr;
  double most = kFairContactError;
  for (const ContactFit& fit : fits) {
    const double error = std::max(fit.out.most, fit.sink.at_95);
    num_links += error > kFairContactError;
    if (error <= most) continue;
    most = error;
    worst = &fit;
  }
  if (!worst) return "";
  return "contact differs from " + surface + " by more than 1 mm on " +
         FormatCount(num_links, "link") + ", most on \"" + worst->link +
         "\": " + DescribeContactError(*worst);
}

std::string DescribeThinSelfContact(const std::vector<ContactFit>& fits) {
  int64_t num_links = 0;
  const ContactFit* worst = nullptr;
  for (const ContactFit& fit : fits) {
    if (fit.self_contact >= kFairSelfContact) continue;
    ++num_links;
    if (!worst || fit.self_contact < worst->self_contact) worst = &fit;
  }
  if (!worst) return "";
  return "contact of the hand with itself misses more than half of the surface of " +
         FormatCount(num_links, "link") + ", most of \"" + worst->link +
         "\": " + DescribeSelfContact(*worst);
}

}  // namespace graspbench
