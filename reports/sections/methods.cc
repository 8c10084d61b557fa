#include <algorithm>

#include "core/arm/mounted_arm.h"
#include "core/base/text/text.h"
#include "core/base/units.h"
#include "core/base/version.h"
#include "core/grasp/standard_grasp.h"
#include "objects/catalogue.h"
#include "reports/page/layout.h"
#include "reports/sections/section.h"

namespace graspbench {
namespace {

std::string DescribeChoice(const SessionConfig& config) {
  if (HasBestGrasp(config)) {
    return " The type of each best grasp was chosen by rehearsal: the first standard grasp, at the "
           "rule's placement, that held all imagined trials, else the one that held most. "
           "Rehearsal uses its own draws.";
  }
  const bool is_predicted =
      std::count(config.grasps.begin(), config.grasps.end(), kPredictedGrasp) > 0;
  return is_predicted ? " The type of each predicted grasp was chosen from geometry." : "";
}

/** Nothing without an arm. */
std::string DescribeCarrier(const ArmConfig& arm) {
  if (!HasArm(arm)) return "";
  return " An arm carried the hand: " + arm.model + ", " + DescribeArmBase(CalcArmBase(arm)) +
         ". It started in its ready posture, and the hand yielded as the arm's joints do.";
}

std::string DescribeMethod(const ReportData& data) {
  const SessionConfig& config = data.session.config;
  const int num_hands = static_cast<int>(data.summary.hands.size());
  const int num_objects = static_cast<int>(data.summary.objects.size());
  return FormatCount(num_hands, "robot hand") + " grasped " + FormatCount(num_objects, "object") +
         " in a physical simulation, with " + FormatCount(config.trials, "trial") +
         " for every hand, object and grasp." + DescribeCarrier(config.arm) +
         DescribeChoice(config) + " Before each trial the object was moved by up to " +
         FormatFixed(MmFromM(config.variation.offset), 1) +
         " mm along each horizontal axis and turned by up to " +
         FormatFixed(DegFromRad(config.variation.yaw), 1) +
         " degrees about the vertical (uniform distributions), and every drive had a uniform "
         "random error within its joint accuracy. All hands and grasps have the same draws of "
         "object poses (seed " +
         std::to_string(config.seed) +
         "). Each trial ran the strategy pre-grasp, placing, closure, stabilisation and lift-off, "
         "closing from the pre-grasp to the target posture in " +
         FormatFixed(config.strategy.closure_time, 2) + " s, and then a hold of " +
         FormatFixed(config.strategy.hold_time, 2) +
         " s. A trial succeeds if the object leaves the table with the hand and stays in it until "
         "the end of the hold. The simulation used time steps of " +
         FormatFixed(MsFromS(config.sim.step), 2) + " ms (graspbench " +
         std::string(program_version()) +
         "). Rates have 95 % Wilson score intervals; times are medians and ranges over the trials "
         "in which they are defined.";
}

Html DrawMeasures() {
  Table table(
      "Measures of contact simultaneity; t is the first contact of a grasping digit, T the "
      "thumb, t0 the start of closure.",
      {"Measure", "Definition"});
  table.AddRow({"GCT, grasp closure time", "max t - t0"});
  table.AddRow({"GFT, grasp forming time", "max t - min t"});
  table.AddRow({"GOT, grasp opposing time", "|t of T - min t of the others|"});
  table.AddRow({"GFT%, GOT%", "GFT / GCT and GOT / GCT"});
  return table.ToHtml();
}

Html DrawOrigins() {
  Table table("Origin of each rule: Röthling's thesis (Bielefeld, 2007) or graspbench.",
              {"Item", "Origin"});
  const auto add = [&](const char* item, const char* origin) { table.AddRow({item, origin}); };
  add("Five-phase strategy; four grasp types, five standard grasps", "known from the thesis");
  add("Mass, size, centre of mass and friction of the 21 objects; ten trials per condition",
      "known from the thesis, table 4.1");
  add("Type of a best grasp by trials on the object", "known from the thesis, 4.2");
  add("Details of this choice: number, draws and model errors of its trials",
      "proposed by graspbench");
  add("Joint accuracy of 2 degrees of the TUM Hand", "known from the thesis");
  add("Names of GCT, GFT, GOT, GFT%, GOT%; the order GCT, GFT, GOT from large to small",
      "known from the thesis");
  add("Formulas of GFT, GOT and the ratios", "inferred from the known facts");
  add("Hand postures, geometry of the TUM Hand, shapes of the objects", "proposed by graspbench");
  add("Rule of success, names of the other outcomes", "proposed by graspbench");
  add("Variation of the object's pose; times of the phases; contact parameters",
      "proposed by graspbench");
  return table.ToHtml();
}

Html DrawTaxonomies() {
  std::vector<Column> columns = {"Taxonomy"};
  for (const GraspType type : kGraspTypes) {
    columns.push_back(std::string(CodeOf(type)) + " " + NameOf(type));
  }
  Table table("Names of the four grasp types in earlier taxonomies (Röthling 2007).", columns);
  for (const GraspTaxonomy& taxonomy : ListGraspTaxonomies()) {
    std::vector<Cell> row = {taxonomy.author + std::string(" ") + std::to_string(taxonomy.year)};
    for (const char* name : taxonomy.names) row.push_back(name);
    table.AddRow(row);
  }
  return table.ToHtml();
}

Html DrawHands(const ReportData& data) {
  Table table("Hands at the time of this page.",
              {"Hand",
               "Id",
               "Digits",
               "Joints",
               {"Joint accuracy [deg]", "half-width of the uniform error"},
               "Content hash"});
  for (const std::string& id : data.summary.hands) {
    const auto hand = data.models.FindHand(id);
    if (!hand) continue;
    table.AddRow({hand->name, id, hand->digits.size(), hand->num_joints(),
                  FormatFixed(DegFromRad(hand->joint_accuracy), 2),
                  Element("code", {}, hand->content_hash)});
  }
  return table.ToHtml();
}

Html DrawObjects(const ReportData& data) {
  Table table("Objects at the time of this page; sizes at rest.",
              {"Object",
               "Id",
               "Mass [g]",
               "Length [mm]",
               "Width [mm]",
               "Height [mm]",
               {"Compressed", "none: rigid"},
               {"Centre of mass [mm]", "from the geometric centre, along the length"},
               "Static friction",
               "Dynamic friction",
               "Content hash"});
  for (const std::string& id : data.summary.objects) {
    const auto object = data.models.FindObject(id);
    if (!object) continue;
    std::vector<Cell> row = {object->name, id,
                             FormatFixed(GFromKg(object->mass_properties.mass), 1)};
    for (double side : object->size) row.push_back(FormatFixed(MmFromM(side), 1));
    row.push_back(DescribeCompression(*object));
    row.push_back(FormatFixed(MmFromM(object->mass_properties.p_OOcm.x()), 1));
    row.push_back(FormatFixed(object->surface.friction_static, 2));
    row.push_back(FormatFixed(object->surface.friction_dynamic, 2));
    row.push_back(Element("code", {}, object->content_hash));
    table.AddRow(row);
  }
  return table.ToHtml();
}

Html DrawMethods(const ReportData& data) {
  Html html = MakeMethodsText({DescribeMethod(data)}) + DrawMeasures() + DrawHands(data);
  html += MakeDetails("Objects and their content hashes", DrawObjects(data));
  html += MakeDetails("Known from the thesis, inferred, proposed", DrawOrigins());
  html += MakeDetails("Names of the grasp types in other taxonomies", DrawTaxonomies());
  return html + MakeDetails("The session's complete configuration",
                            MakeConfigTable("The session's complete configuration.",
                                            ToJson(data.session.config)));
}

}  // namespace

Section methods_section() { return {"methods", "Method and configuration", DrawMethods}; }

}  // namespace graspbench
