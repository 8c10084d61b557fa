#pragma once
/** @file
Lines of a journal that are whole and have a right checksum, and yet do not belong there: those of
another kind of journal or of another search, different answers to one question of a search, and
what somebody has added to a search that has its result. */

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "datasets/journal/manifest.h"
#include "datasets/journal/store_kind.h"

namespace graspbench {

/** In the order of their lines; where two answer one question differently, both are named. Lines
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
