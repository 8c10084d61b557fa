#pragma once
/** @file
A map of simultaneity as it is stored: the success session with the other parts in its folder
(datasets/plan/map_design.h). */

#include <map>
#include <string>
#include <vector>

#include "datasets/analysis/map/common_cause.h"
#include "datasets/analysis/map/object_effects.h"
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

/** map.csv: a row for each cell of every part; map_objects.csv: a row for each object. */
std::vector<ExportTable> MakeMapTables(const MapResult& result);

/** {findings: [..], parts: [{id, trials, planned, factors, cells}], objects: [..],
precision: {HAND: ..}, natural: {HAND: ..}}. */
Json ToJson(const MapResult& result);

}  // namespace graspbench
