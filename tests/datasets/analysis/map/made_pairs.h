#pragma once
/** @file
Trials of a map, made up from a function of object, draw and delay. */

#include <array>
#include <functional>
#include <string>

#include "datasets/analysis/map/simultaneity_map.h"

namespace graspbench {

using Values = std::array<double, std::size(kMapMeasures)>;

inline MapTrial MakeTrial(int object, int draw, LateDigit late, double delay,
                          const Values& values) {
  MapTrial trial;
  trial.hand = "tum";
  trial.object = "object" + std::to_string(object);
  trial.draw = draw;
  trial.levels = {static_cast<size_t>(draw % 2)};
  trial.late = late;
  trial.delay = delay;
  trial.values = values;
  trial.name = trial.object + ":" + std::to_string(draw);
  return trial;
}

/** Objects with four draws each, two a level; what a delay gives is `value(object, draw, delay)`. */
inline MapData MakeData(int num_objects, const std::function<Values(int, int, double)>& value) {
  MapData data;
  data.factors = {{"grip", {"weak", "firm"}}};
  for (int object = 0; object < num_objects; ++object) {
    for (int draw = 0; draw < 4; ++draw) {
      data.trials.push_back(
          MakeTrial(object, draw, LateDigit::kNone, 0.0, value(object, draw, 0.0)));
      for (const double delay : {0.1, 0.3}) {
        data.trials.push_back(
            MakeTrial(object, draw, LateDigit::kLast, delay, value(object, draw, delay)));
      }
    }
  }
  return data;
}

}  // namespace graspbench
