#pragma once
/** @file
A store and its manifest: sealing what was written, verifying it before it is read, repairing it.

Sealed when it is created, when a run begins and when it ends; what a killed program appended behind
the last seal is good line by line. A store of a schema older than manifests can be read and says
so; from its next run on it is sealed too.

Tables and pages that are made from a store have a manifest each, in their own folder inside it.
Nothing is read from them again, so that they stop no reader; CheckStore reports when one is not
what was written. */

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "datasets/journal/manifest.h"
#include "datasets/journal/store_kind.h"

namespace graspbench {

enum class OnDamage { kRefuse, kAccept };

/** Something that is whole and was made from what has changed since. */
struct StaleResult {
  std::string path;     ///< "report", from the folder; ".": the folder itself
  std::string input;    ///< what has changed, from there: "../journal/*.jsonl"
  std::string command;  ///< that makes it again
};

struct StoreState {
  std::string kind;                ///< as in Manifest
  bool is_made_anew = false;       ///< a manifest was: what had changed before is not noticed
  std::vector<Damage> damages;     ///< names from the folder, those of stores inside it too
  std::vector<StaleResult> stale;  ///< of the outputs, where they were checked
};

/** Writes the manifest of a folder whose frozen configuration comes next, with this text.
@throws Error(kFormat, kIo). */
void SealNewStore(const StoreKind& kind, const std::filesystem::path& folder,
                  const std::string& frozen);

/** Writes the manifest of a folder as its files are now; nobody else writes there. What never
changes keeps the seal it has.
@param inputs  see Manifest; empty: as in the manifest before.
@throws Error(kNotFound) when the folder is no store; kFormat; kIo. */
void SealStore(const StoreKind& kind, const std::filesystem::path& folder,
               const std::string& inputs = "");

/** Writes files that are made from the rest of the store (StoreKind::derived) and seals it, unless
it is sealed with just these.
@param contents  by their names from the folder. @throws as SealStore. */
void WriteDerived(const StoreKind& kind, const std::filesystem::path& folder,
                  const std::map<std::string, std::string>& contents);

/** Before outputs are written into their folder: from now on the integrity of what is there cannot
be verified.
Files that somebody has changed since they were written are renamed to `<file>.set-aside`.
@throws Error(kUsage) when the folder is a link; kIo. */
void UnsealOutput(const std::filesystem::path& output);
/** When they are written. @param files  all of them, named from the folder. @throws Error(kIo). */
void SealOutput(const std::filesystem::path& output, const std::vector<std::string>& files,
                const ManifestOrigin& origin);

/** The manifest's own text and files, each whole line behind them, the outputs, and whether what
was made from something is older than that.
@throws Error(kNotFound) when there is neither a store nor a manifest. */
StoreState CheckStore(const std::filesystem::path& folder);

/** CheckStore, but of the outputs, before anything is read from the folder.
@param only  patterns of the store's own files that will be read; empty: everything.
@throws Error(kFormat) naming all damage and what can be done about it, unless it is accepted. */
StoreState VerifyStore(const std::filesystem::path& folder, OnDamage on_damage,
                       const std::vector<std::string>& only = {});

/** Which damaged files never change and cannot be made again, and what to do then; empty: a repair
mends all. */
std::string DescribeLostFiles(const std::filesystem::path& folder,
                              const std::vector<Damage>& damages);

/** Takes a journal out of a whole store: it is renamed to `<journal>.set-aside`, and what it holds
counts as not run. @throws Error(kUsage) when there is no such journal, naming those that are there;
as VerifyStore; kIo. */
void SetJournalAside(const std::filesystem::path& folder, const std::string& journal);

struct StoreRepair {
  std::vector<std::string> actions;  ///< what was done, in words
  StoreState state;                  ///< afterwards: what cannot be repaired
};
/** Moves each line that is no record into `<journal>.damaged`, and files and outputs that can be
made again aside under such a name; no byte is lost. What is left is sealed; damage to files that
never change stays damage. Nothing is done in a store older than manifests.
@throws as CheckStore; kFormat; kIo. */
StoreRepair RepairStore(const std::filesystem::path& folder);

/** Files that a store has made and of which no hash is kept, so that it is unknown whether they
have changed: what a program that was killed had just written, and tables and pages whose manifest
is gone. From the folder, those of stores inside it too; none in what is no store.
@throws Error(kIo). */
std::vector<std::string> FindUnverified(const std::filesystem::path& folder);

/** As a line for a person. */
std::string DescribeUnverified(const std::string& file);

}  // namespace graspbench
