#include <algorithm>
#include <cmath>
#include <map>

#include "core/base/text.h"
#include "core/base/units.h"
#include "datasets/analysis/grasp_course.h"
#include "reports/campaign/campaign_section.h"

namespace graspbench {
namespace {

/** In how many trials each digit came first, as text: "thumb 6, index 4". */
std::string FormatFirstTouches(const CellSummary& cell, const SessionModels& models) {
  std::string text;
  for (const auto& [digit, count] : CountFirstTouches(cell)) {
    text += (text.empty() ? "" : ", ") + models.NameOfDigit(cell.hand, digit) + " " +
            std::to_string(count);
  }
  return text;
}

void AddRow(Table& table, const std::string& what, const std::string& found, bool holds) {
  table.AddRow({Text(what), Text(found), Text(holds ? "holds" : "does not hold")});
}

std::vector<Column> MakeColumns() {
  return {{"Known from the thesis", Align::kProse}, {"Found here", Align::kProse}, {"Verdict"}};
}

Html DrawTape(const SceneVariants& scene, const SessionModels& models) {
  constexpr double kMuchLarger = 1.5;
  Table table("Adhesive tape, TUM Hand, power grasp.", MakeColumns());
  std::string rates;
  int num_all = 0;
  std::array<double, kNumVariants> sigma{};
  for (int v = 0; v < kNumVariants; ++v) {
    const Tally& tally = scene.cells[v]->tally;
    rates += (v > 0 ? ", " : "") + std::to_string(tally.successes()) + " of " +
             std::to_string(tally.finished);
    num_all += tally.successes() == tally.finished ? 1 : 0;
    sigma[v] = CalcCellValue(FindVariantMeasure("sigma"), *scene.cells[v]);
  }
  AddRow(table, "Every variant succeeds in all ten trials.", rates, num_all == kNumVariants);
  AddRow(table, "Standard grasp: the index finger touches first and drags the tape to the thumb.",
         "trials in which a digit touched first: " +
             FormatFirstTouches(scene.cell(kStandardGrasp), models),
         FindFirstDigit(scene.cell(kStandardGrasp)) == "FF");
  const double before = CalcContactGap(scene.cell(kStandardGrasp), "FF", "MF");
  const double after = CalcContactGap(scene.cell(kNewPreGrasp), "FF", "MF");
  AddRow(table, "After step 1 index and middle finger arrive together.",
         "mean time between them " + FormatFixed(MsFromS(before), 0) + " ms before, " +
             FormatFixed(MsFromS(after), 0) + " ms after",
         after < before);
  AddRow(table, "The stability is much larger after step 1 (here: by half or more).",
         "mean sigma " + FormatFixed(sigma[kStandardGrasp], 2) + " before, " +
             FormatFixed(sigma[kNewPreGrasp], 2) + " after",
         sigma[kNewPreGrasp] >= kMuchLarger * sigma[kStandardGrasp]);
  AddRow(table, "It is larger again after step 2.",
         "mean sigma " + FormatFixed(sigma[kNewPreGrasp], 2) + " before, " +
             FormatFixed(sigma[kNewTarget], 2) + " after",
         sigma[kNewTarget] > sigma[kNewPreGrasp]);
  return table.ToHtml() +
         MakeParagraph(
             "The thesis's standard posture is not known. In the one proposed here index and "
             "middle "
             "finger mirror each other, so where the tape stands as expected they come together "
             "from the start; what parts them is the tape's place, which differs from trial to "
             "trial, and no pre-grasp can know it.");
}

Html DrawPropeller(const SceneVariants& scene, const Hand& hand, const GraspObject& object) {
  constexpr double kClearTurnDeg = 5.0;
  constexpr double kCubeHeight = 0.031;  ///< the blades lie on the cube [m]
  Table table("Toy propeller, TUM Hand.", MakeColumns());
  std::array<ThumbPlace, kNumVariants> places;
  for (int v = 0; v < kNumVariants; ++v) {
    places[v] = CalcThumbPlace(*scene.cells[v], hand, object);
  }
  const auto describe = [](const ThumbPlace& place) {
    return "thumb " + FormatFixed(MmFromM(place.height), 1) + " mm above the table's side, " +
           FormatFixed(place.from_blade_deg, 0) + " degrees from the nearest blade";
  };
  AddRow(table, "Standard grasp: the thumb is on the side of a blade.",
         describe(places[kStandardGrasp]), places[kStandardGrasp].height > kCubeHeight);
  AddRow(
      table, "After step 1 the contacts are between the blades.", describe(places[kNewPreGrasp]),
      places[kNewPreGrasp].from_blade_deg > places[kStandardGrasp].from_blade_deg + kClearTurnDeg);
  AddRow(table, "After step 2 the contacts are on the cube below them.",
         describe(places[kNewTarget]), places[kNewTarget].height < kCubeHeight);
  return table.ToHtml() +
         MakeParagraph(
             "The rule that places the hand aims at half the object's height, 25.7 mm, and the "
             "blades begin at 31 mm: here the thumb meets the cube below the blades from the "
             "start, where in the thesis only step 2 leads it.");
}

Html LinkToPictures(const SceneVariants& scene) {
  return Element("p", {}, LinkTo(scene.key, "Pictures and contacts of the three variants"));
}

Html DrawOrderings(const CampaignData& data) {
  Html html = MakeParagraph(
      "Two courses of events are known from the thesis. Means are over the benchmark's trials; "
      "the thumb's place is that of its pad when the grasp is closed.");
  if (const SceneVariants* scene = FindScene(data.scenes, "tum", "adhesive_tape")) {
    html += DrawTape(*scene, data.models) + LinkToPictures(*scene);
  } else {
    html += MakeParagraph("The adhesive tape with the TUM Hand is not among the finished scenes.");
  }
  const auto hand = data.models.FindHand("tum");
  const auto object = data.models.FindObject("toy_propeller");
  const SceneVariants* scene = FindScene(data.scenes, "tum", "toy_propeller");
  if (scene && hand && object) {
    html += DrawPropeller(*scene, *hand, *object) + LinkToPictures(*scene);
  } else {
    html += MakeParagraph("The toy propeller with the TUM Hand is not among the finished scenes.");
  }
  return html;
}

}  // namespace

CampaignSection orderings_campaign_section() {
  return {"orderings", "Known orderings", DrawOrderings};
}

}  // namespace graspbench
