#pragma once
/** @file
A map of simultaneity as it is stored: the success session with the other parts in its folder
(datasets/plan/map_design.h). */

#include <map>
#include <string>
#include <vector>

#include "datasets/analysis/map/common_cause.h"
#include "datasets/session/session_store.h"

namespace graspbench {

struct MapPartResult {
  std::string id, title;
  int num_trials = 0, num_planned = 0;
  SimultaneityMap map;
};

struct MapResult {
  std::vector<MapPartResult> parts;                        ///< success first; those that have begun
  std::map<std::string, Answer<NaturalRelation>> natural;  ///< by hand

  /** What the map finds of each hand, a sentence a hand. */
  std::vector<std::string> findings() const;
};

/** @param session  the first part, IsMap. @throws as LoadSession. */
MapResult LoadMap(const Session& session);

/** map.csv: a row for each cell of every part. */
std::vector<ExportTable> MakeMapTables(const MapResult& result);

/** {findings: [..], parts: [{id, trials, planned, factors, says, cells}], natural: {HAND: ..}}. */
Json ToJson(const MapResult& result);

}  // namespace graspbench
