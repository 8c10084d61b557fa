#pragma once
/** @file
What a store's results come from, as hashes that say whether something made of them is out of date.

A journal counts by its content: the whole lines of all its files, each once, in an order of their
own. So a session has the same hashes whoever ran which trial, how often it was continued, and after
a merge. */

#include <filesystem>
#include <string>
#include <vector>

#include "datasets/journal/manifest.h"
#include "datasets/journal/store_kind.h"

namespace graspbench {

/** SHA-256 of the sorted SHA-256 digests (hexadecimal, a line each) of the different checked lines
in the files that match; lines that are torn or damaged count not. @throws Error(kIo). */
std::string CalcJournalSha256(const std::filesystem::path& folder, const std::string& pattern);

/** Files, kinds of files and journals of the store, and the stores in it, by the names that
StoreKind has for them; a file that is not there is left out, a journal that is not has the hash of
nothing. Who worked on it (workers/) is no part.
@param only  of those names; with the pattern of stores all of them, and as one more source which
there are; empty: all. @throws Error(kIo). */
std::vector<ManifestSource> ListSources(const StoreKind& kind, const std::filesystem::path& folder,
                                        const std::vector<std::string>& only = {});

/** Of a file its SHA-256; of a store that of its sources; of another result that of its manifest.
Empty for what is nothing of these. @throws Error(kIo). */
std::string CalcSourceSha256(const std::filesystem::path& path);

/** The sources among those of `origin` that are not any more what they were, by their names.
@param folder  of the manifest. Inside a store it is an output of, its sources are the store's. A
source that is not to be found says nothing. @throws Error(kIo). */
std::vector<std::string> FindChangedSources(const std::filesystem::path& folder,
                                            const ManifestOrigin& origin);

}  // namespace graspbench
