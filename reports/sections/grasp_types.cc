#include "core/trial/measures/grasp_types.h"

#include <map>
#include <set>

#include "core/base/text/text.h"
#include "datasets/analysis/type_summary.h"
#include "reports/page/layout.h"
#include "reports/sections/section.h"

namespace graspbench {
namespace {

Html DrawRules() {
  Table table("Definition of each grasp.",
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
      "Standard grasps chosen by rehearsal. Held: imagined trials of the rehearsal, whose draws "
      "belong to no session.",
      {"Hand", "Object", "Grasp", "Held"});
  for (const auto& [pair, type] : data.models.types) {
    table.AddRow({type.hand, type.object, type.grasp,
                  std::to_string(type.held) + " of " + std::to_string(type.draws)});
  }
  return table.ToHtml();
}

/** Camera's choices for a hand and the objects with a known rehearsed type. */
struct SightAgreement {
  int num_chosen = 0, num_same = 0;  ///< trials, and those among them with the rehearsed type
  std::set<std::string> others;      ///< "matchbox: g1, rehearsed g2"
};

std::map<std::string, SightAgreement> ListSightAgreements(const ReportData& data) {
  std::map<std::string, SightAgreement> hands;
  for (const TrialRecord& record : data.session.records) {
    const std::optional<std::string>& chosen = record.result.sight_grasp;
    const auto type = data.models.types.find({record.plan.hand, record.plan.object});
    if (!chosen || *chosen == kNotSeenGrasp || type == data.models.types.end()) continue;
    SightAgreement& hand = hands[record.plan.hand];
    ++hand.num_chosen;
    const std::string& rehearsed = type->second.grasp;
    if (FindGraspTaxon(*chosen).type == FindGraspTaxon(rehearsed).type) {
      ++hand.num_same;
    } else {
      hand.others.insert(record.plan.object + ": " + *chosen + ", rehearsed " + rehearsed);
    }
  }
  return hands;
}

/** Returns an empty element if the camera chose no grasp. */
Html DrawSightAgreements(const ReportData& data) {
  const std::map<std::string, SightAgreement> hands = ListSightAgreements(data);
  if (hands.empty()) return Html();
  Table table(
      "Grasp types by sight compared with types by rehearsal, in trials whose object was seen.",
      {"Hand", "Same type", "Trials", "Another type"});
  for (const auto& [id, hand] : hands) {
    std::string others;
    for (const std::string& other : hand.others) others += (others.empty() ? "" : "; ") + other;
    table.AddRow({data.models.NameOfHand(id), hand.num_same, hand.num_chosen, others});
  }
  return table.ToHtml();
}

Html DrawTypes(const ReportData& data) {
  const std::vector<TypeSummary> types = ListTypeSummaries(data.session);
  const std::string line = FormatTypeLine(types);
  Html rules = DrawSightAgreements(data);
  if (!data.models.types.empty()) {
    rules += MakeDetails("Type by rehearsal", DrawRehearsedTypes(data));
  }
  rules += MakeDetails("Definition of each grasp", DrawRules());
  if (line.empty()) {
    return MakeParagraph("No trial with a standard grasp ended with the object in the hand.") +
           rules;
  }
  return MakeParagraph(
             line +
             ". Pad: palmar surfaces press against each other; palm: the palm bears at least "
             "10 % of the normal force; side: sides of digits bear at least a third.") +
         MakeTable("Grasps of each hand: intended opposition and opposition in held trials.",
                   ShowTable(ListTypeColumns(), types)) +
         rules;
}

}  // namespace

Section grasp_types_section() { return {"types", "Intended and observed opposition", DrawTypes}; }

}  // namespace graspbench
