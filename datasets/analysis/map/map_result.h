#pragma once
/** @file
A stored simultaneity map: the success session, with the other parts in its folder
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
  MapMeasure measure = MapMeasure::kSuccess;  ///< the part's main measure
  SimultaneityMap map;
};

struct MapResult {
  std::string command;                                     ///< that makes it
  std::vector<MapPartResult> parts;                        ///< parts that have begun, success first
  std::vector<ObjectEffect> objects;                       ///< in the first part
  std::map<std::string, Answer<NaturalRelation>> natural;  ///< by hand

  /** The map's findings for each hand: over all regions, by region, by object. */
  std::vector<std::string> findings() const;
};

/** Loads a map. @param session  its first part. @pre IsMap. @throws as LoadSession. */
MapResult LoadMap(const Session& session);

/** A cell of the map with its part. */
struct MapRow {
  const MapPartResult* part;
  const MapCell* cell;

  const MapMeasureRow& measure() const { return RowOf(kMapMeasures, cell->measure); }
};
/** Lists the cells that have pairs. They point into `result`. */
std::vector<MapRow> ListMapRows(const MapResult& result);
/** Makes the displayed table of the rows. */
ShownTable ShowRegions(const std::vector<MapRow>& rows);

/** Makes map.csv, with one row per cell of every part, and map_objects.csv, with one row per
object. */
std::vector<ExportTable> MakeMapTables(const MapResult& result);

/** Writes {findings: [..], parts: [{id, trials, planned, factors, cells}], objects: [..],
precision: {HAND: ..}, natural: {HAND: ..}}. */
Json ToJson(const MapResult& result);

/** Lists the trials of one session of a map (datasets/plan/map_design.h) for MapSimultaneity,
without numerical failures. @param thresholds  LoadThresholds(session). */
MapData ListMapTrials(const Session& session, const std::vector<ThresholdSummary>& thresholds);

}  // namespace graspbench
