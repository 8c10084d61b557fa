#pragma once
/** @file
Things to grasp: the catalogue's 21 objects by id, or any mesh of a user by path. */

#include <memory>
#include <string>
#include <vector>

#include "core/shape/grasp_object.h"

namespace graspbench {

/** Ids of the catalogue in the order of the thesis's table 4.1. */
std::vector<std::string> ListObjects();

/** Loads a catalogue object, or the folder of a user's object (object.yaml and a mesh). The
distance field comes from the cache when it is there.
@throws Error(kNotFound) with suggestions; Error(kFormat) listing every problem. */
std::shared_ptr<const GraspObject> LoadObject(const std::string& id_or_folder);

}  // namespace graspbench
