#pragma once
/** @file
Reads journals of all kinds. A line

- without a line break was not finished when the program stopped: a finding;
- with a wrong checksum is ignored: a finding, which verification reports as damage
  (sealed_store.h);
- with a correct checksum that is not a record of this journal, or not a requested one: damage. */

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "datasets/journal/checked_line.h"
#include "datasets/journal/manifest.h"
#include "datasets/journal/sealed_store.h"
#include "datasets/journal/store_kind.h"

namespace graspbench {

/** Calls `take` for all whole, non-empty lines.
@param journal  path relative to the folder, with slashes; used in messages.
@param take  verifies the checksum and throws Error or Json::exception for a line that it rejects.
@throws Error(kNotFound, kIo). */
void ReadJournal(const std::filesystem::path& folder, const std::string& journal,
                 const std::function<void(const FileLine&)>& take, Diagnostics& findings,
                 std::vector<Damage>& damage);

/** Reports damage that hashes and checksums cannot detect. @param store  "the session".
@param remedy  end of a sentence: what can be done.
@throws Error(kFormat) naming the damage, unless there is none or it is accepted. */
void RefuseDamage(const std::string& store, const std::filesystem::path& folder,
                  const std::vector<Damage>& damage, OnDamage on_damage, const std::string& remedy);

/** Lists the journals in a subfolder of a store, by name; empty if there is no such folder. */
std::vector<std::filesystem::path> ListJournals(const std::filesystem::path& folder,
                                                const std::string& subfolder = "journal");

/** Returns the journal of a worker: 0.jsonl without a label, 3of7-0.jsonl with one. A labelled
journal with a torn last line is not continued; the next one is 3of7-0-2.jsonl, and so on. */
std::filesystem::path FindJournal(const std::filesystem::path& subfolder, int worker,
                                  const std::string& label);

/** Lists intact lines of a journal that do not belong there, in order: lines of another kind of
journal or another search, different answers to one question of a search (both are listed), and
lines added to a search that has its result. Ignores torn lines and wrong checksums.
@param journal  path relative to the folder, with slashes. @param manifest  of the folder.
@throws Error(kNotFound, kIo). */
std::vector<Damage> FindForeignLines(const StoreKind& kind, const std::filesystem::path& folder,
                                     const std::string& journal, const Manifest& manifest);

/** Returns the id that every line of a search's journal carries: a hash of the store's frozen
configuration and of the journal's name in it, so that answers to another search are not accepted.
None outside a store. @param journal  its path. */
std::optional<std::string> FindJournalId(const std::filesystem::path& journal);

}  // namespace graspbench
