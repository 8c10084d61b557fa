#pragma once
/** @file
How every journal is read, whatever its lines say. A line

- that ends without a line break was not finished when the program stopped: a finding;
- whose checksum is wrong is ignored: a finding, which the door calls damage
  (sealed_store.h);
- whose checksum is right and which is no record of its journal, or one that nobody asked for:
  damage. */

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

/** Calls `take` for the whole lines that are not empty.
@param journal  from the folder, with slashes: it is named so.
@param take  throws Error or Json::exception for what it cannot take; it checks the checksum.
@throws Error(kNotFound, kIo). */
void ReadJournal(const std::filesystem::path& folder, const std::string& journal,
                 const std::function<void(const FileLine&)>& take, Diagnostics& findings,
                 std::vector<Damage>& damage);

/** Damage that hashes and checksums cannot show. @param store  "the session".
@param remedy  the end of a sentence: what can be done.
@throws Error(kFormat) naming it, unless there is none or it is accepted. */
void RefuseDamage(const std::string& store, const std::filesystem::path& folder,
                  const std::vector<Damage>& damage, OnDamage on_damage, const std::string& remedy);

/** The journals of a store: which there are, and which one a worker writes.

The journals in a subfolder of the store, by name; none when there is no such folder. */
std::vector<std::filesystem::path> ListJournals(const std::filesystem::path& folder,
                                                const std::string& subfolder = "journal");

/** The journal of a worker: 0.jsonl without a label; with one 3of7-0.jsonl, or, because what a
crash has torn is not continued there, 3of7-0-2.jsonl and so on. */
std::filesystem::path FindJournal(const std::filesystem::path& subfolder, int worker,
                                  const std::string& label);

/** Lines of a journal that are whole and have a right checksum, and yet do not belong there: those
of another kind of journal or of another search, different answers to one question of a search, and
what somebody has added to a search that has its result.

In the order of their lines; where two answer one question differently, both are named. Lines
that are torn or whose checksum is wrong are not looked at.
@param journal  from the folder, with slashes. @param manifest  of the folder. @throws
Error(kNotFound, kIo). */
std::vector<Damage> FindForeignLines(const StoreKind& kind, const std::filesystem::path& folder,
                                     const std::string& journal, const Manifest& manifest);

/** What every line of a search's journal says of it: a hash of the frozen configuration of its store
and of its name there, so that an answer to another search is not taken. None where no store is
around it. @param journal  a path. */
std::optional<std::string> FindJournalId(const std::filesystem::path& journal);

}  // namespace graspbench
