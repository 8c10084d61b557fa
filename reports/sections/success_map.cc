#include <algorithm>
#include <limits>

#include "core/base/text/text.h"
#include "reports/page/layout.h"
#include "reports/plots/svg_plot.h"
#include "reports/sections/section.h"

namespace graspbench {
namespace {

struct MapColumn {
  std::string hand;
  std::string grasp;  ///< empty: the hand has one grasp per object
};

/** Lists one column per hand, or per hand and grasp if some object is grasped in several ways. */
std::vector<MapColumn> ListColumns(const SessionSummary& summary) {
  std::vector<MapColumn> columns;
  for (const std::string& hand : summary.hands) {
    bool has_several = false;
    for (const std::string& object : summary.objects) {
      int num_grasps = 0;
      for (const std::string& grasp : summary.grasps) {
        num_grasps += summary.FindCell(hand, object, grasp) != nullptr;
      }
      has_several = has_several || num_grasps > 1;
    }
    if (!has_several) {
      columns.push_back({hand, {}});
      continue;
    }
    for (const std::string& grasp : summary.grasps) {
      if (summary.TallyOf(hand, grasp).planned > 0) columns.push_back({hand, grasp});
    }
  }
  return columns;
}

const CellSummary* FindCellOf(const MapColumn& column, const std::string& object,
                              const SessionSummary& summary) {
  if (!column.grasp.empty()) return summary.FindCell(column.hand, object, column.grasp);
  for (const std::string& grasp : summary.grasps) {
    if (const CellSummary* cell = summary.FindCell(column.hand, object, grasp)) return cell;
  }
  return nullptr;
}

HeatMap::Cell MakeCell(const CellSummary* cell, const MapColumn& column,
                       const SessionModels& models) {
  HeatMap::Cell drawn;
  if (cell == nullptr) return drawn;
  const int n = cell->tally.finished;
  drawn.rate = cell->tally.rate();
  drawn.text = std::to_string(cell->tally.successes()) + " / " + std::to_string(n);
  if (column.grasp.empty()) drawn.text += " " + cell->grasp;
  drawn.hint = NameOfCell(*cell, models) + ": " + FormatRate(cell->tally);
  drawn.anchor = cell->key;
  return drawn;
}

Html DrawSuccessMap(const ReportData& data) {
  if (data.summary.cells.empty()) return MakeParagraph("There is nothing to show.");
  const std::vector<MapColumn> columns = ListColumns(data.summary);
  HeatMap map;
  map.text.title = "Successes by object and hand";
  map.text.description =
      "Objects in rows, hands in columns; every entry gives successes, finished trials and grasp, "
      "and links to its section.";
  const bool has_groups = std::any_of(columns.begin(), columns.end(), [](const MapColumn& column) {
    return !column.grasp.empty();
  });
  for (const MapColumn& column : columns) {
    const std::string name = data.models.NameOfHand(column.hand);
    map.columns.push_back(column.grasp.empty() ? name : column.grasp);
    if (has_groups) map.groups.push_back(column.grasp.empty() ? "" : name);
  }
  for (const std::string& object : data.summary.objects) {
    map.rows.push_back(data.models.NameOfObject(object));
    for (const MapColumn& column : columns) {
      map.cells.push_back(MakeCell(FindCellOf(column, object, data.summary), column, data.models));
    }
  }
  return MakeFigure("Successes and finished trials of every condition; g1 to g6 is the grasp.",
                    "dashed frames (no success) and objects that fail with every hand. Entries "
                    "link to pictures and times.",
                    MakeScroll(map.text.title, DrawHeatMap(map)));
}

}  // namespace

Section success_map_section() { return {"map", "Successes by object and hand", DrawSuccessMap}; }

}  // namespace graspbench
