#include "workbench/tables/grasp_tables.h"

#include "core/base/pose.h"
#include "core/base/text/csv.h"
#include "core/base/text/text.h"
#include "core/base/units.h"
#include "core/grasp/pad_geometry.h"
#include "core/grasp/placement.h"
#include "core/grasp/standard_grasp.h"
#include "workbench/tables/text_table.h"

namespace graspbench {
namespace {

constexpr char kPlacementPart[] = "placement", kPreGraspPart[] = "pre-grasp",
               kTargetPart[] = "target";

/** In H, a column a digit of the grasp. */
Eigen::Matrix3Xd FindPads(const Hand& hand, const Grasp& grasp, double s) {
  const std::vector<Pose> X_HL = CalcLinkPoses(hand, CalcClosingPosture(hand, grasp, s));
  Eigen::Matrix3Xd pads(3, static_cast<Eigen::Index>(grasp.digits.size()));
  Eigen::Index column = 0;
  for (const Digit& digit : hand.digits) {
    if (std::count(grasp.digits.begin(), grasp.digits.end(), digit.id) == 0) continue;
    pads.col(column++) = X_HL[digit.distal_link] * digit.p_LPad;
  }
  return pads;
}

void AddPlacement(const Hand& hand, const Grasp& grasp, std::vector<GraspNumber>& numbers) {
  const auto add = [&](const char* name, const char* unit, double value) {
    numbers.push_back({grasp.id, kPlacementPart, name, unit, value + 0.0});
  };
  const Placement placement = CalcPlacement(hand, grasp, Eigen::Vector3d::Constant(kReferenceBlock),
                                            Eigen::Vector3d::Zero());
  const Eigen::Vector3d p_OH =
      placement.X_WH.translation() - Eigen::Vector3d(0.0, 0.0, 0.5 * kReferenceBlock);
  const Eigen::Vector3d rpy = CalcRollPitchYaw(placement.X_WH.linear());
  add("x", "mm", MmFromM(p_OH.x()));
  add("y", "mm", MmFromM(p_OH.y()));
  add("z", "mm", MmFromM(p_OH.z()));
  add("roll", "deg", DegFromRad(rpy.x()));
  add("pitch", "deg", DegFromRad(rpy.y()));
  add("yaw", "deg", DegFromRad(rpy.z()));
  add("approach x", "", placement.approach_W.x());
  add("approach y", "", placement.approach_W.y());
  add("approach z", "", placement.approach_W.z());
  add("distance", "mm", MmFromM(grasp.approach_distance));
  add("alpha", "deg", DegFromRad(grasp.alpha));
  add("tilt", "deg", DegFromRad(grasp.tilt));
  constexpr double kStep = 0.01;  // of closing, over which the pads' ways are taken
  const Eigen::Matrix3Xd pads = FindPads(hand, grasp, placement.closing_at_contact);
  const Eigen::Matrix3Xd before = FindPads(hand, grasp, placement.closing_at_contact - kStep);
  add("pads off a plane", "mm", MmFromM(CalcPlaneResidual(pads)));
  add("courses off a point", "mm", MmFromM(CalcMeetingResidual(pads, pads - before)));
}

std::string NameRow(const GraspNumber& number) {
  return number.unit.empty() ? number.name : number.name + " [" + number.unit + "]";
}

/** The numbers of the first grasp name the rows: all grasps have the same ones in one order. */
std::vector<const GraspNumber*> SelectNumbers(const std::vector<GraspNumber>& numbers,
                                              const std::string& grasp, const std::string& part) {
  std::vector<const GraspNumber*> selected;
  for (const GraspNumber& number : numbers) {
    if (number.grasp == grasp && number.part == part) selected.push_back(&number);
  }
  return selected;
}

std::string FormatParts(const std::vector<Grasp>& grasps, const std::vector<GraspNumber>& numbers,
                        const std::string& head, const std::vector<std::string>& parts) {
  std::vector<std::string> heads = {head};
  std::vector<std::vector<const GraspNumber*>> columns;
  for (const Grasp& grasp : grasps) {
    for (const std::string& part : parts) {
      heads.push_back(parts.size() == 1 ? grasp.id : grasp.id + " " + part);
      columns.push_back(SelectNumbers(numbers, grasp.id, part));
    }
  }
  TextTable table(heads);
  for (size_t row = 0; row < columns.front().size(); ++row) {
    std::vector<std::string> cells = {NameRow(*columns.front()[row])};
    for (const auto& column : columns) {
      const int num_decimals = column[row]->unit.empty() ? 2 : 1;
      cells.push_back(FormatFixed(column[row]->value, num_decimals));
    }
    table.AddRow(cells);
  }
  return table.Format();
}

}  // namespace

std::vector<GraspNumber> ListGraspNumbers(const Hand& hand, const std::vector<Grasp>& grasps) {
  std::vector<GraspNumber> numbers;
  for (const Grasp& grasp : grasps) {
    AddPlacement(hand, grasp, numbers);
    for (const auto& [part, q] :
         {std::pair(kPreGraspPart, &grasp.q_pre), {kTargetPart, &grasp.q_target}}) {
      for (int j = 0; j < hand.num_joints(); ++j) {
        const HandJoint& joint = hand.joints[static_cast<size_t>(j)];
        numbers.push_back({grasp.id, part, joint.name, DisplayUnitOf(joint),
                           ToDisplayUnits(joint, (*q)[j]) + 0.0});
      }
    }
  }
  return numbers;
}

std::string FormatGraspNumbers(const std::vector<Grasp>& grasps,
                               const std::vector<GraspNumber>& numbers) {
  if (grasps.empty()) return "no standard grasps; graspbench hand develop finds them\n";
  std::string text;
  for (const Grasp& grasp : grasps) {
    text += grasp.id + "  " + FindGraspTaxon(grasp.id).name + ", with";
    for (const std::string& digit : grasp.digits) text += " " + digit;
    text += "\n";
  }
  return text +
         "\nPlacement of the palm frame relative to the centre of a block of 50 mm, in world "
         "axes:\n\n" +
         FormatParts(grasps, numbers, "", {kPlacementPart}) + "\n" +
         FormatParts(grasps, numbers, "joint", {kPreGraspPart, kTargetPart});
}

namespace {

std::vector<CsvColumn<GraspNumber>> ListNumberColumns() {
  using N = GraspNumber;
  return {{"grasp", "", "standard grasp", &N::grasp},
          {"part", "", "placement, pre-grasp or target", &N::part},
          {"name", "", "quantity, or the joint", &N::name},
          {"unit", "", "of the value", &N::unit},
          {"value", "", "the number", &N::value}};
}

}  // namespace

std::string FormatGraspCsv(const std::vector<GraspNumber>& numbers) {
  return FormatCsv(ListNumberColumns(), numbers);
}

Json MakeGraspNumberSchema() { return MakeTableSchema(ListNumberColumns(), ""); }

std::string FormatGraspTypes() {
  std::vector<std::string> heads = {"taxonomy"};
  for (const GraspType type : kGraspTypes) {
    heads.push_back(CodeOf(type) + std::string(" ") + NameOf(type));
  }
  TextTable table(heads);
  for (const GraspTaxonomy& taxonomy : ListGraspTaxonomies()) {
    std::vector<std::string> row = {taxonomy.author + std::string(" ") +
                                    std::to_string(taxonomy.year)};
    row.insert(row.end(), taxonomy.names.begin(), taxonomy.names.end());
    table.AddRow(row);
  }
  return "Grasp types and their names in earlier taxonomies. Standard grasps g1 to g4 have the "
         "types t1 to\nt4; g5, three finger special, and g6, encompassing precision, have type "
         "t1.\n\n" +
         table.Format();
}

Json MakeGraspTypesJson() {
  Json types = Json::array();
  for (const GraspType type : kGraspTypes) {
    Json elsewhere = Json::array();
    for (const GraspTaxonomy& taxonomy : ListGraspTaxonomies()) {
      const std::string name = taxonomy.names[static_cast<size_t>(type)];
      elsewhere.push_back({{"author", taxonomy.author},
                           {"year", taxonomy.year},
                           {"name", name == "-" ? Json(nullptr) : Json(name)}});
    }
    types.push_back({{"type", CodeOf(type)}, {"name", NameOf(type)}, {"taxonomies", elsewhere}});
  }
  return {{"grasp_types", types}};
}

}  // namespace graspbench
