#include "core/trial/measures/grasp_types.h"

#include "core/base/text/text.h"
#include "datasets/analysis/type_summary.h"
#include "reports/page/layout.h"
#include "reports/sections/section.h"

namespace graspbench {
namespace {

Html DrawRules() {
  Table table("What each grasp is by its name.",
              {"Grasp", "Name", "Digits", "Opposition", "Parts that bear", "Widths [mm]"});
  for (const GraspTypeRule& rule : ListGraspTypeRules()) {
    const std::string object = rule.object[0] == '\0' ? "" : std::string(", for ") + rule.object;
    table.AddRow(
        {rule.grasp, FindGraspTaxon(rule.grasp).name + object, NameOf(rule.digits),
         RowOf(kOppositions, rule.opposition).name, rule.bears,
         FormatFixed(rule.least_width_mm, 0) + " to " + FormatFixed(rule.most_width_mm, 0)});
  }
  return table.ToHtml();
}

Html DrawRehearsedTypes(const ReportData& data) {
  Table table(
      "Standard grasps that rehearsal chose. Held: of the imagined trials of the choice, whose "
      "draws are none of this session's.",
      {"Hand", "Object", "Grasp", "Held"});
  for (const auto& [pair, type] : data.models.types) {
    table.AddRow({type.hand, type.object, type.grasp,
                  std::to_string(type.held) + " of " + std::to_string(type.draws)});
  }
  return table.ToHtml();
}

Html DrawTypes(const ReportData& data) {
  const std::vector<TypeSummary> types = ListTypeSummaries(data.session);
  const std::string line = FormatTypeLine(types);
  Html rules;
  if (!data.models.types.empty()) {
    rules = MakeDetails("Type by rehearsal", DrawRehearsedTypes(data));
  }
  rules += MakeDetails("What each grasp is by its name", DrawRules());
  if (line.empty()) {
    return MakeParagraph("No trial with a standard grasp ended with the object in the hand.") +
           rules;
  }
  return MakeParagraph(
             line +
             ". Pad: palmar surfaces press against each other; palm: the palm bears at least "
             "10 % of the normal force; side: sides of digits bear at least a third.") +
         MakeTable("Grasps of each hand: opposition asked for and found in what was held.",
                   ShowTable(ListTypeColumns(), types)) +
         rules;
}

}  // namespace

Section grasp_types_section() { return {"types", "Grasps by name and by opposition", DrawTypes}; }

}  // namespace graspbench
