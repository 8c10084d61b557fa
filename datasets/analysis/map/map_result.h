#pragma once
/** @file
A map of simultaneity as it is stored: the success session with the other parts in its folder
(datasets/plan/map_design.h). */

#include <map>
#include <string>
#include <vector>

#include "core/base/enum_table.h"
#include "core/base/text/csv.h"
#include "datasets/analysis/conditions/threshold_summary.h"
#include "datasets/analysis/map/common_cause.h"
#include "datasets/analysis/map/simultaneity_map.h"
#include "datasets/session/session_store.h"

namespace graspbench {

struct MapPartResult {
  std::string id, title;
  int num_trials = 0, num_planned = 0;
  MapMeasure measure = MapMeasure::kSuccess;  ///< what the part was run for
  SimultaneityMap map;
};

struct MapResult {
  std::vector<MapPartResult> parts;                        ///< success first; those that have begun
  std::vector<ObjectEffect> objects;                       ///< of the first part
  std::map<std::string, Answer<NaturalRelation>> natural;  ///< by hand

  /** What the map finds: of each hand over all regions, by region, by object. */
  std::vector<std::string> findings() const;
};

/** @param session  the first part, IsMap. @throws as LoadSession. */
MapResult LoadMap(const Session& session);

/** A cell of the map with the part that it is of. */
struct MapRow {
  const MapPartResult* part;
  const MapCell* cell;

  const MapMeasureRow& measure() const { return RowOf(kMapMeasures, cell->measure); }
};
/** Those that have pairs. They point into `result`. */
std::vector<MapRow> ListMapRows(const MapResult& result);
/** As people see them. */
ShownTable ShowRegions(const std::vector<MapRow>& rows);

/** map.csv: a row for each cell of every part; map_objects.csv: a row for each object. */
std::vector<ExportTable> MakeMapTables(const MapResult& result);

/** {findings: [..], parts: [{id, trials, planned, factors, cells}], objects: [..],
precision: {HAND: ..}, natural: {HAND: ..}}. */
Json ToJson(const MapResult& result);

/** The trials of one session of a map (datasets/plan/map_design.h) as its analysis takes them.
Trials that ended as numerical failures are left out: they say nothing of a grasp.
@param thresholds  LoadThresholds(session). */
MapData ListMapTrials(const Session& session, const std::vector<ThresholdSummary>& thresholds);

}  // namespace graspbench
