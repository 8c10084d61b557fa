#pragma once
/** @file
The frozen configuration of a folder: written once, with its schema and versions, and never changed.
Sessions, scenes and campaigns each have one such file (store_kind.h), and a manifest beside it. */

#include <filesystem>
#include <string>
#include <vector>

#include "core/base/config.h"
#include "datasets/journal/sealed_store.h"

namespace graspbench {

bool HasFrozen(const StoreKind& kind, const std::filesystem::path& folder);

struct Frozen {
  Json config;                 ///< as it was written
  int physics_version = 0;     ///< kPhysicsVersion of the program that wrote it; 0: unknown
  std::vector<Damage> damage;  ///< of the whole store, if accepted, or a lost manifest
};
/** Verifies a store and reads its frozen configuration. Every reader of a store starts here.
@param only  as in VerifyStore.
@throws Error(kNotFound) for no store, kVersion for another schema, kFormat for damage; kIo. */
Frozen LoadFrozen(const StoreKind& kind, const std::filesystem::path& folder,
                  OnDamage on_damage = OnDamage::kRefuse,
                  const std::vector<std::string>& only = {});

/** Converts the configuration that LoadFrozen returns to a struct of keys (core/base/config.h).
@throws Error(kFormat) listing every missing or unknown key and every wrong value. */
template <class Config>
Config ParseFrozen(const StoreKind& kind, const std::filesystem::path& folder, const Json& frozen) {
  Diagnostics problems;
  const auto config = ConfigFromJson<Config>(frozen, (folder / kind.file).string(), problems);
  problems.ThrowIfErrors(ErrorKind::kFormat, "the frozen configuration cannot be read");
  return config;
}

/** Writes the manifest of the files already in the folder, then the configuration file, whose
presence makes the folder a store. @pre the folder exists. @throws Error(kIo). */
void WriteFrozen(const StoreKind& kind, const std::filesystem::path& folder, const Json& config);

/** @throws Error(kUsage) when the folder has another configuration, naming the top-level keys that
differ; as LoadFrozen. */
void CheckSameFrozen(const StoreKind& kind, const std::filesystem::path& folder,
                     const Json& config);

/** Formats each difference as an indented line of its own; empty if there is none. */
std::string ListDifferences(const std::vector<std::string>& differences);

}  // namespace graspbench
