#pragma once
/** @file
Pairs of a map of simultaneity: the same hand, object, draw and region without delay and with one
digit late. What the effect of a pair is says simultaneity_map.h. */

#include <string>
#include <utility>
#include <vector>

#include "datasets/analysis/map/simultaneity_map.h"

namespace graspbench {

struct MapPair {
  std::vector<size_t> levels;  ///< of each factor
  std::string object;
  double undelayed = kUnset;                       ///< the measure's value
  std::vector<std::pair<double, double>> delayed;  ///< delay [s] and the measure's value with it
  double effect = kUnset;
  std::string changed;  ///< name of a late trial with another value; empty: none
};

/** @param delayed  delays [s] and the measure's values. NaN where one has none, and without any. */
double CalcPairEffect(MapMeasure measure, double undelayed,
                      const std::vector<std::pair<double, double>>& delayed);

/** Of one hand, late digit and measure, those that have a value. */
std::vector<MapPair> ListMapPairs(const MapData& data, const std::string& hand, LateDigit late,
                                  MapMeasure measure);

}  // namespace graspbench
