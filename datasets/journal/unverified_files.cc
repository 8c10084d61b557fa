#include "datasets/journal/unverified_files.h"

#include <algorithm>
#include <optional>

#include "datasets/journal/manifest.h"
#include "datasets/journal/store_kind.h"

namespace graspbench {
namespace fs = std::filesystem;

std::vector<std::string> FindUnverified(const fs::path& folder) {
  std::vector<std::string> files;
  const StoreKind* kind = FindStoreKind(folder);
  const std::optional<Manifest> manifest = FindManifest(folder);
  if (!kind || !manifest) return files;
  for (const std::string& file : ListMatches(folder, kind->derived)) {
    const bool is_sealed =
        std::any_of(manifest->files.begin(), manifest->files.end(),
                    [&](const ManifestFile& sealed) { return sealed.path == file; });
    if (!is_sealed && fs::is_regular_file(folder / file)) files.push_back(file);
  }
  for (const std::string& output : kind->outputs) {
    if (HasManifest(folder / output) || !fs::is_directory(folder / output)) continue;
    for (const std::string& file : ListMatches(folder, {output + "/*"})) {
      if (fs::is_regular_file(folder / file)) files.push_back(file);
    }
  }
  for (const std::string& store : ListMatches(folder, kind->stores)) {
    for (const std::string& file : FindUnverified(folder / store)) {
      files.push_back(store + "/" + file);
    }
  }
  return files;
}

std::string DescribeUnverified(const std::string& file) {
  return file + ": cannot be verified, no hash of it is kept";
}

}  // namespace graspbench
