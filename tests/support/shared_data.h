#pragma once
/** @file
Where data of others lie that tests read and the project does not hold: $GRASPBENCH_DATA, else
shared/data beside the checkout. */

#include <cstdlib>
#include <filesystem>

#include "core/base/files/files.h"

namespace graspbench {

inline std::filesystem::path FindSharedData() {
  const char* root = std::getenv("GRASPBENCH_DATA");
  return root != nullptr && *root != '\0' ? std::filesystem::path(root)
                                          : FindDataRoot().parent_path() / "shared" / "data";
}

}  // namespace graspbench
