#include "datasets/session/frozen_folder.h"

#include "core/base/error.h"
#include "core/base/files.h"
#include "core/base/version.h"
#include "datasets/session/trial_record.h"

namespace graspbench {
namespace fs = std::filesystem;

bool HasFrozen(const FrozenKind& kind, const fs::path& folder) {
  std::error_code status;
  return fs::exists(folder / kind.file, status);
}

Json LoadFrozen(const FrozenKind& kind, const fs::path& folder) {
  if (!HasFrozen(kind, folder)) {
    throw Error(ErrorKind::kNotFound, std::string("no ") + kind.what + " in \"" + folder.string() +
                                          "\" (" + kind.file + " is not there); " + kind.command +
                                          " --out " + folder.string() + " starts one");
  }
  const fs::path path = folder / kind.file;
  try {
    const Json json = Json::parse(ReadFile(path));
    const int schema = IntFrom(json.at("schema"));
    if (schema == kind.schema) return json.value("config", Json::object());
    throw Error(ErrorKind::kVersion,
                "\"" + path.string() + "\" has schema " + std::to_string(schema) +
                    ", this program (" + program_version() + ") reads schema " +
                    std::to_string(kind.schema) + "; use graspbench " +
                    json.value("program_version", "of that time") + " for it, or " + kind.remedy);
  } catch (const Json::exception& e) {
    throw Error(ErrorKind::kFormat,
                "\"" + path.string() + "\" is damaged: " + e.what() +
                    "; it is written once and never changed, so take it from a backup");
  }
}

void WriteFrozen(const FrozenKind& kind, const fs::path& folder, const Json& config) {
  const Json frozen = {{"schema", kind.schema},
                       {"program_version", program_version()},
                       {"physics_version", kPhysicsVersion},
                       {"config", config}};
  WriteFileAtomically(folder / kind.file, FormatJson(frozen, 2) + "\n");
}

std::string ListDifferences(const std::vector<std::string>& differences) {
  std::string text;
  for (const std::string& difference : differences) text += "\n  " + difference;
  return text;
}

}  // namespace graspbench
