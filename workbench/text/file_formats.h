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

/** For `graspbench help KEY`: what a key such as "model.friction_scale" means, its unit, range and
default, and the files that have it; a paragraph for each meaning. Empty: no file has this key. */
std::string ExplainFileKey(const std::string& key);

/** SuggestNames of `names` and the keys of all files. A key is found by its last part, too:
"model.friction_scale" by "friction_scale". */
std::string SuggestFileKeys(const std::string& misspelt, std::vector<std::string> names);

}  // namespace graspbench
