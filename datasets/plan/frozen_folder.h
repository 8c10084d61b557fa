#pragma once
/** @file
The frozen configuration of a folder: written once, with schema and versions, and never changed.
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
  int physics_version = 0;     ///< kPhysicsVersion of the program that wrote it; 0: not said
  std::vector<Damage> damage;  ///< of the whole store: when it is accepted, and a lost manifest
};
/** The door through which a store is read: it is verified first.
@param only  as in VerifyStore.
@throws Error(kNotFound) none there; kVersion another schema; kFormat damaged; kIo. */
Frozen LoadFrozen(const StoreKind& kind, const std::filesystem::path& folder,
                  OnDamage on_damage = OnDamage::kRefuse,
                  const std::vector<std::string>& only = {});

/** The configuration that LoadFrozen gives, as a struct of keys (core/base/config.h).
@throws Error(kFormat) listing every missing, unknown or wrong key or value. */
template <class Config>
Config ParseFrozen(const StoreKind& kind, const std::filesystem::path& folder, const Json& frozen) {
  Diagnostics problems;
  const auto config = ConfigFromJson<Config>(frozen, (folder / kind.file).string(), problems);
  problems.ThrowIfErrors(ErrorKind::kFormat, "the frozen configuration cannot be read");
  return config;
}

/** Writes the manifest of what is there already, and then the file, whose presence makes the folder
a store; the folder exists. @throws Error(kIo). */
void WriteFrozen(const StoreKind& kind, const std::filesystem::path& folder, const Json& config);

/** @throws Error(kUsage) when the folder was made of another configuration, naming the first keys
that differ; as LoadFrozen. */
void CheckSameFrozen(const StoreKind& kind, const std::filesystem::path& folder,
                     const Json& config);

/** Every difference on a line of its own, indented; empty: none. */
std::string ListDifferences(const std::vector<std::string>& differences);

}  // namespace graspbench
