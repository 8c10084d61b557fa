#pragma once
/** @file
What is wrong with a JSON text, in words of a person. */

#include <string>

#include "core/base/text/json.h"

namespace graspbench {

/** "it is no JSON from line 1, column 3 on", "its key "schema" is missing", or that a value is not
of its type: the end of a sentence that names the file. */
std::string DescribeJsonFault(const Json::exception& fault);

}  // namespace graspbench
