#include "datasets/plan/frozen_folder.h"

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "core/base/version.h"
#include "datasets/journal/checked_line.h"
#include "datasets/plan/grip_check.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

/** A manifest of ours: any other file of that name says nothing. */
bool HasManifestOf(const StoreKind& kind, const fs::path& folder) {
  const std::optional<Manifest> manifest = FindManifest(folder);
  return manifest && manifest->kind == kind.name;
}

/** Advice must not lead a new result into a folder that holds something. */
bool MayBegin(const fs::path& folder) {
  std::error_code status;
  return !fs::exists(folder, status) || fs::is_empty(folder, status);
}

}  // namespace

bool HasFrozen(const StoreKind& kind, const fs::path& folder) {
  std::error_code status;
  return fs::exists(folder / kind.file, status);
}

Frozen LoadFrozen(const StoreKind& kind, const fs::path& folder, OnDamage on_damage,
                  const std::vector<std::string>& only) {
  const fs::path path = folder / kind.file;
  if (!HasFrozen(kind, folder) && HasManifestOf(kind, folder)) {
    throw Error(ErrorKind::kFormat, "\"" + path.string() +
                                        "\" is missing, which the manifest beside it names; take "
                                        "it from a backup");
  }
  if (!HasFrozen(kind, folder)) {
    const std::optional<Manifest> other = FindManifest(folder);
    const std::string place = MayBegin(folder) ? folder.string() : "NEW_FOLDER";
    const std::string there =
        other ? "; it holds the result \"" + other->kind + "\")" +
                    (other->kind == "study" ? "; the tables of a study are in its folder" : "")
              : "); " + std::string(kind.command) + " --out " + place + " starts one";
    throw Error(ErrorKind::kNotFound, std::string("no ") + kind.name + " in \"" + folder.string() +
                                          "\" (" + kind.file + " is not there" + there);
  }
  Frozen frozen;
  try {
    const Json json = Json::parse(ReadFile(path));
    const int schema = IntFrom(json.at("schema"));
    if (schema != kind.schema) {
      throw Error(ErrorKind::kVersion,
                  "\"" + path.string() + "\" has schema " + std::to_string(schema) +
                      ", this program (" + program_version() + ") reads schema " +
                      std::to_string(kind.schema) + "; use graspbench " +
                      json.value("program_version", "of that time") + " for it, or " + kind.remedy);
    }
    frozen.config = json.value("config", Json::object());
    frozen.physics_version = json.value("physics_version", 0);
    AddFirmGrip(frozen.config.contains("session") ? frozen.config["session"] : frozen.config);
  } catch (const Json::exception& e) {
    throw Error(ErrorKind::kFormat,
                "\"" + path.string() + "\" is damaged: " + DescribeJsonFault(e) +
                    "; it is written once and never changed, so take it from a backup");
  }
  StoreState state = VerifyStore(folder, on_damage, only);
  frozen.damage = std::move(state.damages);
  if (state.is_made_anew) {
    frozen.damage.push_back(
        {kManifestFile, 0, "was rebuilt after a loss: earlier changes cannot be detected"});
  }
  return frozen;
}

void WriteFrozen(const StoreKind& kind, const fs::path& folder, const Json& config) {
  const Json frozen = {{"schema", kind.schema},
                       {"program_version", program_version()},
                       {"physics_version", kPhysicsVersion},
                       {"config", config}};
  const std::string text = FormatJson(frozen, 2) + "\n";
  SealNewStore(kind, folder, text);
  WriteFileAtomically(folder / kind.file, text);
}

void CheckSameFrozen(const StoreKind& kind, const fs::path& folder, const Json& config) {
  const Json there = LoadFrozen(kind, folder).config;
  std::vector<std::string> differences;
  for (const auto& [key, value] : config.items()) {
    if (!there.contains(key) || there.at(key) != value) differences.push_back(key);
  }
  for (const auto& [key, value] : there.items()) {
    if (!config.contains(key)) differences.push_back(key);
  }
  if (differences.empty()) return;
  throw Error(ErrorKind::kUsage, "\"" + folder.string() +
                                     "\" was started with other inputs or settings; differences:" +
                                     ListDifferences(differences) +
                                     "\nuse those, or choose another folder with --out");
}

std::string ListDifferences(const std::vector<std::string>& differences) {
  std::string text;
  for (const std::string& difference : differences) text += "\n  " + difference;
  return text;
}

}  // namespace graspbench
