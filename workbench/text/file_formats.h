#pragma once
/** @file
The files that people write, and their keys: the rows that the readers check. */

#include <string>
#include <vector>

#include "core/base/file_keys.h"

namespace graspbench {

struct FileFormat {
  std::string name;  ///< "object.yaml"
  std::string about;
  FileKeys keys;
};
const std::vector<FileFormat>& ListFileFormats();

}  // namespace graspbench
