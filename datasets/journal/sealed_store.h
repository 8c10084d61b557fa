#pragma once
/** @file
Seals a store with a manifest, verifies it before reading, and repairs it.

A store is sealed when it is created, when a run begins and when it ends. Lines that a killed
program appended after the last seal are protected by their own checksums. A store of a schema older
than manifests can be read, with a notice; its next run seals it.

Tables and pages derived from a store have their own manifests, in their folders inside it. They are
never read again, so their damage does not prevent reading the store; CheckStore reports it. */

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "datasets/journal/manifest.h"
#include "datasets/journal/store_kind.h"

namespace graspbench {

enum class OnDamage { kRefuse, kAccept };

/** An intact derived result whose inputs have changed since. */
struct StaleResult {
  std::string path;     ///< "report", relative to the folder; ".": the folder itself
  std::string input;    ///< changed input, relative to `path`: "../journal/*.jsonl"
  std::string command;  ///< that reproduces it
};

struct StoreState {
  std::string kind;                ///< as in Manifest
  bool is_made_anew = false;       ///< a manifest was rebuilt: earlier changes are undetected
  std::vector<Damage> damages;     ///< with relative paths, including stores inside
  std::vector<StaleResult> stale;  ///< outputs, if checked
};

/** Writes the manifest of a folder whose frozen configuration, with this text, is written next.
@throws Error(kFormat, kIo). */
void SealNewStore(const StoreKind& kind, const std::filesystem::path& folder,
                  const std::string& frozen);

/** Writes the manifest of the folder's present files. Files that never change keep their first
seal.
@pre no one else writes there.
@param inputs  see Manifest; empty: as in the previous manifest.
@throws Error(kNotFound) when the folder is not a store; kFormat; kIo. */
void SealStore(const StoreKind& kind, const std::filesystem::path& folder,
               const std::string& inputs = "");

/** Writes derived files (StoreKind::derived) and seals the store, unless it is already sealed with
the same contents.
@param contents  by path relative to the folder. @throws as SealStore. */
void WriteDerived(const StoreKind& kind, const std::filesystem::path& folder,
                  const std::map<std::string, std::string>& contents);

/** Call before outputs are written into their folder: removes their seal. Files that were changed
since they were written are renamed to `<file>.set-aside`.
@throws Error(kUsage) when the folder is a link; kIo. */
void UnsealOutput(const std::filesystem::path& output);
/** Call after outputs are written: seals them. @param files  all of them, relative to the folder.
@throws Error(kIo). */
void SealOutput(const std::filesystem::path& output, const std::vector<std::string>& files,
                const ManifestOrigin& origin);

/** Checks the manifest, its files, each whole line appended since, the outputs, and whether derived
results are out of date.
@throws Error(kNotFound) when there is neither a store nor a manifest. */
StoreState CheckStore(const std::filesystem::path& folder);

/** As CheckStore without the outputs, to be called before anything is read from the folder.
@param only  patterns of the store's own files that will be read; empty: everything.
@throws Error(kFormat) naming all damage and its remedy, unless damage is accepted. */
StoreState VerifyStore(const std::filesystem::path& folder, OnDamage on_damage,
                       const std::vector<std::string>& only = {});

/** Names damaged files that can be neither repaired nor rebuilt, and the remedy; empty if a repair
fixes everything. */
std::string DescribeLostFiles(const std::filesystem::path& folder,
                              const std::vector<Damage>& damages);

/** Removes a journal from an intact store: renames it to `<journal>.set-aside`, so that its trials
count as not run. @throws Error(kUsage) when there is no such journal, naming the existing ones; as
VerifyStore; kIo. */
void SetJournalAside(const std::filesystem::path& folder, const std::string& journal);

struct StoreRepair {
  std::vector<std::string> actions;  ///< what was done, in words
  StoreState state;                  ///< state after the repair, with damage that remains
};
/** Moves each invalid line to `<journal>.damaged`, and renames damaged derived files and outputs
likewise; no byte is lost. Seals what remains; damage to files that never change remains. Does
nothing in a store older than manifests.
@throws as CheckStore; kFormat; kIo. */
StoreRepair RepairStore(const std::filesystem::path& folder);

/** Lists files of a store without a hash, so that changes cannot be detected: files that a killed
program had just written, and tables and pages whose manifest is missing. Paths are relative to the
folder and include stores inside it; empty if the folder is not a store.
@throws Error(kIo). */
std::vector<std::string> FindUnverified(const std::filesystem::path& folder);

/** Describes such a file in one line. */
std::string DescribeUnverified(const std::string& file);

}  // namespace graspbench
