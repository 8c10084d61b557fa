#pragma once
/** @file
From where a hand comes to an object: a grasp, an object and a session may each say so. What a
session says comes before what the object says, and that before the grasp's own word. */

#include "core/base/enum_table.h"
#include "core/base/text/yaml.h"

namespace graspbench {

enum class Approach {
  kAutomatic,  ///< by the rule in core/grasp/placement.h
  kAbove,
  kSide
};

struct ApproachRow {
  Approach value;
  const char* name;  ///< in files
};
inline constexpr ApproachRow kApproaches[] = {
    {Approach::kAutomatic, "automatic"}, {Approach::kAbove, "above"}, {Approach::kSide, "side"}};

/** The key `approach`, which may be left out; another word is a problem with a hint. */
void ReadApproach(YamlMap& map, Approach& approach);

}  // namespace graspbench
