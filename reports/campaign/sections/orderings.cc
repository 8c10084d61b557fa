#include <algorithm>
#include <cmath>
#include <map>

#include "core/base/text.h"
#include "core/base/units.h"
#include "reports/campaign/campaign_section.h"

namespace graspbench {
namespace {

const SceneVariants* FindScene(const CampaignData& data, const char* hand, const char* object) {
  for (const SceneVariants& scene : data.scenes) {
    if (scene.hand == hand && scene.object == object && scene.IsComplete()) return &scene;
  }
  return nullptr;
}

double CalcMean(const std::vector<double>& values) {
  double sum = 0.0;
  for (double value : values) sum += value;
  return values.empty() ? std::nan("") : sum / static_cast<double>(values.size());
}

double FindContact(const TrialResult& result, const char* digit) {
  for (const DigitContact& contact : result.contacts) {
    if (contact.digit == digit) return contact.time;
  }
  return std::nan("");
}

/** Mean time between the first touches of index and middle finger [s]. */
double CalcFingerGap(const CellSummary& cell) {
  std::vector<double> gaps;
  for (const TrialRecord* record : cell.records) {
    const double gap =
        std::abs(FindContact(record->result, "FF") - FindContact(record->result, "MF"));
    if (std::isfinite(gap)) gaps.push_back(gap);
  }
  return CalcMean(gaps);
}

/** In how many trials each digit came first, as text: "thumb 6, index 4". */
struct FirstTouches {
  std::string text;
  std::string most;  ///< id of the digit that came first most often
};

FirstTouches CountFirstTouches(const CellSummary& cell, const SessionModels& models) {
  std::map<std::string, int> counts;
  for (const TrialRecord* record : cell.records) {
    const DigitContact* first = nullptr;
    for (const DigitContact& contact : record->result.contacts) {
      if (std::isfinite(contact.time) && (!first || contact.time < first->time)) first = &contact;
    }
    if (first) ++counts[first->digit];
  }
  FirstTouches touches;
  int most = 0;
  for (const auto& [digit, count] : counts) {
    touches.text += (touches.text.empty() ? "" : ", ") + models.NameOfDigit(cell.hand, digit) +
                    " " + std::to_string(count);
    if (count > most) touches.most = digit;
    most = std::max(most, count);
  }
  return touches;
}

/** Where the pad of the thumb stands when the grasp is closed. */
struct ThumbPlace {
  double height = 0.0;          ///< above the object's lowest plane [m]
  double from_blade_deg = 0.0;  ///< horizontal angle from the nearest blade's axis, 0..45
};

ThumbPlace CalcThumbPlace(const CellSummary& cell, const Hand& hand, const GraspObject& object) {
  std::vector<double> heights, angles;
  const auto thumb = std::find_if(hand.digits.begin(), hand.digits.end(),
                                  [](const Digit& digit) { return digit.is_thumb; });
  for (const TrialRecord* record : cell.records) {
    for (const SceneSnapshot& snapshot : record->result.snapshots) {
      if (snapshot.name != "closed" || thumb == hand.digits.end()) continue;
      if (snapshot.q.size() != hand.num_joints()) continue;
      const Pose X_HL = CalcLinkPoses(hand, snapshot.q)[static_cast<size_t>(thumb->distal_link)];
      const Eigen::Vector3d p_OPad = snapshot.X_WO.inverse() * snapshot.X_WH * X_HL * thumb->p_LPad;
      heights.push_back(p_OPad.z() + 0.5 * object.size.z());
      const double angle = DegFromRad(std::atan2(std::abs(p_OPad.y()), std::abs(p_OPad.x())));
      angles.push_back(std::min(angle, 90.0 - angle));
    }
  }
  return {CalcMean(heights), CalcMean(angles)};
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
  const FirstTouches first = CountFirstTouches(scene.cell(kStandardGrasp), models);
  AddRow(table, "Standard grasp: the index finger touches first and drags the tape to the thumb.",
         "trials in which a digit touched first: " + first.text, first.most == "FF");
  const double before = CalcFingerGap(scene.cell(kStandardGrasp));
  const double after = CalcFingerGap(scene.cell(kNewPreGrasp));
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
  return Element("p", {}, LinkTo(scene.anchor, "Pictures and contacts of the three variants"));
}

Html Draw(const CampaignData& data) {
  Html html = MakeParagraph(
      "Two courses of events are known from the thesis. Means are over the benchmark's trials; "
      "the thumb's place is that of its pad when the grasp is closed.");
  if (const SceneVariants* scene = FindScene(data, "tum", "adhesive_tape")) {
    html += DrawTape(*scene, data.models) + LinkToPictures(*scene);
  } else {
    html += MakeParagraph("The adhesive tape with the TUM Hand is not among the finished scenes.");
  }
  const auto hand = data.models.FindHand("tum");
  const auto object = data.models.FindObject("toy_propeller");
  const SceneVariants* scene = FindScene(data, "tum", "toy_propeller");
  if (scene && hand && object) {
    html += DrawPropeller(*scene, *hand, *object) + LinkToPictures(*scene);
  } else {
    html += MakeParagraph("The toy propeller with the TUM Hand is not among the finished scenes.");
  }
  return html;
}

}  // namespace

CampaignSection orderings_campaign_section() { return {"orderings", "Known orderings", Draw}; }

}  // namespace graspbench
