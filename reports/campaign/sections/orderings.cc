#include "core/base/text/text.h"
#include "core/base/units.h"
#include "datasets/analysis/campaign/thesis_claims.h"
#include "reports/campaign/campaign_section.h"
#include "reports/people_and_robots.h"

namespace graspbench {
namespace {

/** Formats how often each digit touched first: "thumb 6, index 4". */
std::string FormatFirstTouches(const CellSummary& cell, const SessionModels& models) {
  std::string text;
  for (const auto& [digit, count] : CountFirstTouches(cell)) {
    text += (text.empty() ? "" : ", ") + models.NameOfDigit(cell.hand, digit) + " " +
            std::to_string(count);
  }
  return text;
}

void AddRow(Table& table, const std::string& what, const std::string& found, bool holds) {
  table.AddRow({what, found, holds ? "holds" : "does not hold"});
}

std::vector<Column> MakeColumns() { return {"Known from the thesis", "Found here", "Verdict"}; }

Html DrawTape(const SceneVariants& scene, const SessionModels& models) {
  const TapeCourse course = FindTapeCourse(scene);
  Table table("Adhesive tape, " + models.NameOfHand(scene.hand) + ", power grasp.", MakeColumns());
  std::string rates;
  for (const CellSummary* cell : scene.cells) {
    rates += (rates.empty() ? "" : ", ") + std::to_string(cell->tally.successes()) + " of " +
             std::to_string(cell->tally.finished);
  }
  AddRow(table, "Every variant succeeds in all ten trials.", rates, course.always_succeeds);
  AddRow(table, "Standard grasp: the index finger touches first and drags the tape to the thumb.",
         "trials in which a digit touched first: " +
             FormatFirstTouches(scene.cell(kStandardGrasp), models),
         course.index_is_first);
  AddRow(table, "After step 1 index and middle finger arrive together.",
         "mean time between them " + FormatFixed(MsFromS(course.gap_before), 0) + " ms before, " +
             FormatFixed(MsFromS(course.gap_after), 0) + " ms after",
         course.fingers_meet);
  const auto describe = [&](Variant before, Variant after) {
    return "mean sigma " + FormatFixed(course.sigma[before], 2) + " before, " +
           FormatFixed(course.sigma[after], 2) + " after";
  };
  AddRow(table, "The stability is much larger after step 1 (here: by half or more).",
         describe(kStandardGrasp, kNewPreGrasp), course.is_much_firmer);
  AddRow(table, "It is larger again after step 2.", describe(kNewPreGrasp, kNewTarget),
         course.is_firmer_again);
  return table.ToHtml();
}

Html DrawPropeller(const SceneVariants& scene, const Hand& hand, const GraspObject& object) {
  const PropellerCourse course = FindPropellerCourse(scene, hand, object);
  Table table("Toy propeller, " + hand.name + ".", MakeColumns());
  const auto describe = [](const ThumbPlace& place) {
    return "thumb " + FormatFixed(MmFromM(place.height), 1) + " mm above the table's side, " +
           FormatFixed(place.from_blade_deg, 0) + " degrees from the nearest blade";
  };
  AddRow(table, "Standard grasp: the thumb is on the side of a blade.",
         describe(course.places[kStandardGrasp]), course.starts_on_blade);
  AddRow(table, "After step 1 the contacts are between the blades.",
         describe(course.places[kNewPreGrasp]), course.moves_between_blades);
  AddRow(table, "After step 2 the contacts are on the cube below them.",
         describe(course.places[kNewTarget]), course.ends_on_cube);
  return table.ToHtml();
}

/** States the decision of each step and links to the pictures. */
Html ExplainSteps(const SceneVariants& scene) {
  std::string decisions;
  for (const auto& [step, name] :
       {std::pair("pregrasp_step", "Step 1: "), std::pair("target_step", "Step 2: ")}) {
    if (const Json* const found = scene.scene->result.find(step)) {
      decisions += name + found->at("verdict").get<std::string>() + ". ";
    }
  }
  return Element(
      "p", {}, Text(decisions) + LinkTo(scene.key, "Pictures and contacts of the three variants"));
}

/** Explains why this hand's own postures lack the flaw from which a thesis scenario starts. */
Html ExplainStart(const std::string& hand, const std::string& object) {
  if (hand != "tum") return {};
  if (object == "adhesive_tape") {
    return MakeParagraph(
        "The standard posture of the thesis is not known. In the posture proposed here index and "
        "middle finger mirror each other, so they touch together when the tape is at its nominal "
        "pose. Their delay comes from the sampled pose of the tape, which no pre-grasp can know.");
  }
  return MakeParagraph(
      "The placement rule aims at half the object height, 25.7 mm, and the blades begin at 31 mm. "
      "The thumb therefore meets the cube below the blades from the start; in the thesis it does "
      "so only after step 2.");
}

/** Draws the sequences of events that the thesis describes. */
Html DrawCourses(const CampaignData& data) {
  Html courses;
  for (const char* hand_id : {"tum", "tum-courses"}) {
    const auto hand = data.models.FindHand(hand_id);
    if (const SceneVariants* scene = FindScene(data.scenes, hand_id, "adhesive_tape")) {
      courses += DrawTape(*scene, data.models) + ExplainStart(hand_id, "adhesive_tape") +
                 ExplainSteps(*scene);
    }
    const auto object = data.models.FindObject("toy_propeller");
    const SceneVariants* scene = FindScene(data.scenes, hand_id, "toy_propeller");
    if (scene && hand && object) {
      courses += DrawPropeller(*scene, *hand, *object) + ExplainStart(hand_id, "toy_propeller") +
                 ExplainSteps(*scene);
    }
  }
  if (courses.empty()) {
    return MakeParagraph(
        "The thesis describes two scenes in detail: adhesive tape and toy propeller with the TUM "
        "Hand. Neither is among the finished scenes. The hand tum-courses starts both with the "
        "faults described in the thesis.");
  }
  return MakeParagraph(
             "The thesis describes two scenes in detail. Means are over the benchmark trials; the "
             "thumb position is that of its pad in the closed grasp. The hand tum-courses starts "
             "both scenes with the faults described in the thesis.") +
         courses;
}

Html DrawOrderings(const CampaignData& data) {
  return DrawCourses(data) + Element("h3", {}, "People and robots") +
         DrawSchedules(LoadSchedules(data.campaign.benchmark), data.models, "DIR/benchmark");
}

}  // namespace

CampaignSection orderings_campaign_section() {
  return {"orderings", "Known orderings", DrawOrderings};
}

}  // namespace graspbench
