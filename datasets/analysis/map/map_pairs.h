#pragma once
/** @file
Pairs of a simultaneity map: trials of the same hand, object, draw and region without delay and with
one digit delayed. simultaneity_map.h defines the effect of a pair. */

#include <string>
#include <utility>
#include <vector>

#include "datasets/analysis/map/simultaneity_map.h"

namespace graspbench {

struct MapPair {
  std::vector<size_t> levels;  ///< of each factor
  std::string object;
  double undelayed = kUnset;                       ///< the measure's value
  std::vector<std::pair<double, double>> delayed;  ///< delay [s], the measure's value
  double effect = kUnset;
  std::string changed;  ///< name of a delayed trial with another value; empty: none
};

/** Computes the effect of a pair; NaN if a value is NaN or `delayed` is empty.
@param delayed  delays [s] and the measure's values. */
double CalcPairEffect(MapMeasure measure, double undelayed,
                      const std::vector<std::pair<double, double>>& delayed);

/** Lists the pairs of a hand, late digit and measure that have an effect. */
std::vector<MapPair> ListMapPairs(const MapData& data, const std::string& hand, LateDigit late,
                                  MapMeasure measure);

}  // namespace graspbench
