#pragma once
/** @file
Numbers out of JSON that others wrote; a message names file and place ("pose[3]"). */

#include <string>
#include <string_view>
#include <vector>

#include "core/base/text/json.h"

namespace graspbench {

/** @throws Error(kFormat) with line and column where it is no JSON, and where it is no object. */
Json ParseJsonObject(std::string_view bytes, const std::string& file);

/** Value of a key. @throws Error(kFormat) when it is missing. */
const Json& GetJson(const Json& object, const std::string& key, const std::string& file);

/** A list of `size` finite numbers; of any size with 0. @param where  "grasps.json: pose[3]".
@throws Error(kFormat). */
std::vector<double> ReadJsonNumbers(const Json& json, const std::string& where, size_t size = 0);

/** One verdict for each of `size` grasps: truth values, or 0 and 1. @throws Error(kFormat). */
std::vector<bool> ReadJsonLabels(const Json& json, const std::string& where, size_t size);

}  // namespace graspbench
