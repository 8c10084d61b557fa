#pragma once
/** @file
What the hand knows of where the object lies before it places itself. */

#include "core/base/enum_table.h"

namespace graspbench {

enum class Positioning {
  kNominal,  ///< nothing: it goes to where the object should be
  kTrue,     ///< the object's pose, exactly
  kCamera    ///< what its own camera finds (core/vision/wrist_camera.h)
};

struct PositioningRow {
  Positioning value;
  const char* name;  ///< in files
};
inline constexpr PositioningRow kPositionings[] = {{Positioning::kNominal, "nominal"},
                                                   {Positioning::kTrue, "true"},
                                                   {Positioning::kCamera, "camera"}};

}  // namespace graspbench
