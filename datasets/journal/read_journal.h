#pragma once
/** @file
How every journal is read, whatever its lines say. A line

- that ends without a line break was not finished when the program stopped: a finding;
- whose checksum is wrong counts as not there: a finding, which the door calls damage
  (sealed_store.h);
- whose checksum is right and which is no record of its journal, or one that nobody asked for:
  damage. */

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/base/diagnostics.h"
#include "datasets/journal/checked_line.h"
#include "datasets/journal/manifest.h"
#include "datasets/journal/sealed_store.h"

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

}  // namespace graspbench
