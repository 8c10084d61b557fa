#include <algorithm>
#include <set>

#include "core/base/text/text.h"
#include "core/base/units.h"
#include "core/grasp/standard_grasp.h"
#include "core/hand/tactile.h"
#include "datasets/analysis/sensor_summary.h"
#include "datasets/plan/grasp_choice.h"
#include "reports/page/layout.h"
#include "reports/scenes/sight_picture.h"
#include "reports/sections/section.h"

namespace graspbench {
namespace {

constexpr size_t kMostSensedTrials = 5000;  // reading more would delay the page
constexpr double kSurelyLong = 1.15;        // length over width; below it an orientation is
                                            // uncertain
constexpr size_t kFewElements = 12;         // at most this many are shown as a table instead of a
                                            // map

std::string FormatMm(double length) { return FormatFixed(MmFromM(length), 2); }

Html DrawPlaces(const SensorSummary& summary, const SessionModels& models) {
  Table table("Estimated and true object poses.",
              {"Hand",
               "Object",
               "Trials",
               "Found",
               "Position, median [mm]",
               "Position, worst [mm]",
               {"Direction, median [deg]", "modulo half a turn; for elongated objects"},
               "Direction, worst [deg]"});
  for (const PlaceErrors& place : summary.places) {
    const auto object = models.FindObject(place.object);
    const bool has_direction = object && object->size.x() > kSurelyLong * object->size.y();
    const auto turn = [&](double angle) {
      return has_direction ? FormatFixed(DegFromRad(angle), 2) : std::string("n/a");
    };
    table.AddRow({models.NameOfHand(place.hand), models.NameOfObject(place.object),
                  place.num_trials, place.num_found, FormatMm(place.median), FormatMm(place.worst),
                  turn(place.median_turn), turn(place.worst_turn)});
  }
  return MakeDetails("Errors of every object", table.ToHtml());
}

/** Tabulates success with one row per hand and offset class and one column per positioning. */
Html DrawOffsets(const std::vector<OffsetClass>& offsets, const SessionModels& models) {
  std::vector<std::string> positionings;
  std::vector<Column> columns = {"Hand", "Offset [mm]"};
  for (const OffsetClass& offset : offsets) {
    if (std::count(positionings.begin(), positionings.end(), offset.positioning)) continue;
    positionings.push_back(offset.positioning);
    columns.push_back("Success, " + offset.positioning);
  }
  Table table(std::string("Success rate by offset of the object") +
                  (positionings.size() > 1 ? ", on the same draws." : "."),
              columns);
  for (const OffsetClass& row : offsets) {
    if (row.positioning != positionings.front()) continue;
    std::vector<Cell> cells = {
        models.NameOfHand(row.hand),
        FormatFixed(MmFromM(row.low), 1) + " to " + FormatFixed(MmFromM(row.high), 1)};
    for (const OffsetClass& offset : offsets) {
      if (offset.hand != row.hand || offset.low != row.low) continue;
      cells.push_back(offset.tally.finished > 0 ? FormatRate(offset.tally) : "n/a");
    }
    table.AddRow(cells);
  }
  return table.ToHtml();
}

/** Draws the first trial of each object, seen from above its estimated position. */
Html DrawSights(const ReportData& data) {
  Html pictures;
  std::set<std::string> shown;
  for (const TrialRecord& record : data.session.records) {
    const auto hand = data.models.FindHand(record.plan.hand);
    const auto object = data.models.FindObject(record.plan.object);
    if (!hand || !hand->camera || !object || !shown.insert(object->id).second) continue;
    try {
      WristCamera camera(hand, object, data.session.config.camera);
      const TrialDraw draw =
          MakeObjectDraw(data.session.config, record.plan.object, record.plan.trial);
      const Pose X_WO = MakePose(
          MakeRotationRpy(0.0, 0.0, draw.offset_yaw),
          Eigen::Vector3d(draw.offset_x, draw.offset_y, OutlineModel(object->mesh).middle()));
      PlanarPose supposed;
      const TrialRecord whole = LoadWhole(data.session, record);
      if (!std::isnan(whole.result.believed_x)) {
        supposed = {whole.result.believed_x, whole.result.believed_y, whole.result.believed_yaw};
      }
      pictures += DrawSight(camera, *object, X_WO, LoadStandardGrasps(*hand).front().q_pre,
                            supposed, object->name);
    } catch (const Error& e) {
      return MakeNote("info", "No pictures of the camera", MakeParagraph(e.what()));
    }
  }
  if (pictures.empty()) return Html();
  return MakeFigure(
      "Camera pictures and detected outlines.",
      "the solid outline should lie on the object's edge and the cross on its centre; the line "
      "marks its length, the dashed frame is the smallest rectangle.",
      Element("div", {{"class", "film"}}, pictures));
}

std::string FormatShare(int count, int all) {
  return std::to_string(count) + " of " + std::to_string(all) +
         (all > 0 ? " (" + FormatFixed(100.0 * count / all, 1) + " %)" : "");
}

Html DrawTouches(const SensorSummary& summary, const SessionModels& models) {
  Table table("Contacts above 0.1 N, by link of the hand, and their detection.",
              {"Hand",
               "Trials",
               "On sensed surface: detected within 10 ms",
               "Detected later",
               "Never detected",
               "Longest delay [ms]",
               {"Elsewhere", "share of contacts outside the sensed surface"}});
  for (const FeltTouches& felt : summary.touches) {
    const TouchRecord& sum = felt.sum;
    const int missed = sum.num_touches - sum.num_felt_in_time - sum.num_felt_late;
    table.AddRow({models.NameOfHand(felt.hand), felt.num_trials,
                  FormatShare(sum.num_felt_in_time, sum.num_touches), sum.num_felt_late, missed,
                  FormatFixed(MsFromS(sum.longest_delay), 0),
                  FormatShare(sum.num_elsewhere, sum.num_touches + sum.num_elsewhere)});
  }
  return table.ToHtml();
}

Html DrawPeakTable(const Hand& hand, const std::vector<double>& peak) {
  Table table("Largest force on each sensor of the " + hand.name + ".", {"Link", "Peak [N]"});
  for (size_t i = 0; i < peak.size(); ++i) {
    table.AddRow({hand.links[hand.skin->elements[i].link].name, FormatFixed(peak[i], 2)});
  }
  return table.ToHtml();
}

Html DrawPeaks(const FeltTouches& felt, const SessionModels& models) {
  const auto hand = models.FindHand(felt.hand);
  const std::vector<double>& peak = felt.sum.peak;
  if (!hand || !hand->skin || hand->skin->elements.size() != peak.size() || peak.empty()) {
    return Html();
  }
  if (peak.size() <= kFewElements) return DrawPeakTable(*hand, peak);
  PlotText text;
  text.title = "Largest force on each cell of the " + hand->name;
  text.description = "At most " + FormatFixed(*std::max_element(peak.begin(), peak.end()), 2) +
                     " N, over all trials.";
  return MakeFigure(text.title + ".",
                    "the darkest cell had " +
                        FormatFixed(*std::max_element(peak.begin(), peak.end()), 2) +
                        " N, an empty cell none; palmar view of the stretched hand.",
                    MakeScroll(text.title, DrawHandMap(*hand, peak, text)));
}

Html DrawSensors(const ReportData& data) {
  const SessionConfig& config = data.session.config;
  const SessionConfig defaults;
  const std::vector<OffsetClass>& offsets = data.sensitivity.offsets;
  Html html;
  if (std::any_of(offsets.begin(), offsets.end(), [&](const OffsetClass& offset) {
        return offset.positioning != defaults.positioning;
      })) {
    html += DrawOffsets(offsets, data.models);
  }
  const bool looks = NeedsCamera(config);
  if (config.positioning == defaults.positioning && config.touch == defaults.touch && !looks) {
    return html;
  }
  if (data.session.records.size() > kMostSensedTrials) {
    return html +
           MakeParagraph(
               "Omitted: this session has too many trials for the sensor statistics of a page.");
  }
  const SensorSummary summary = SummariseSensors(data.session);
  if (looks) html += DrawSights(data);
  if (config.positioning != defaults.positioning) html += DrawPlaces(summary, data.models);
  if (summary.touches.empty()) return html;
  html += DrawTouches(summary, data.models);
  for (const FeltTouches& felt : summary.touches) html += DrawPeaks(felt, data.models);
  return html;
}

}  // namespace

Section sensors_section() { return {"sensors", "Perception and touch", DrawSensors}; }

}  // namespace graspbench
