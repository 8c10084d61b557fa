#include "datasets/journal/journal_files.h"

#include <algorithm>

#include "core/base/error.h"
#include "datasets/journal/append_file.h"

namespace graspbench {
namespace fs = std::filesystem;

std::vector<fs::path> ListJournals(const fs::path& folder, const std::string& subfolder) {
  std::vector<fs::path> paths;
  std::error_code status;
  for (const auto& entry : fs::directory_iterator(folder / subfolder, status)) {
    if (entry.path().extension() == ".jsonl") paths.push_back(entry.path());
  }
  if (status && status != std::errc::no_such_file_or_directory) {
    throw Error(ErrorKind::kIo, "cannot read folder \"" + (folder / subfolder).string() +
                                    "\": " + status.message());
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

fs::path FindJournal(const fs::path& subfolder, int worker, const std::string& label) {
  const std::string name = (label.empty() ? "" : label + "-") + std::to_string(worker);
  fs::path path = subfolder / (name + ".jsonl");
  for (int number = 2; !label.empty() && EndsInTornLine(path); ++number) {
    path = subfolder / (name + "-" + std::to_string(number) + ".jsonl");
  }
  return path;
}

}  // namespace graspbench
