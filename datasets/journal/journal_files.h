#pragma once
/** @file
The journals of a store: which there are, and which one a worker writes. */

#include <filesystem>
#include <string>
#include <vector>

namespace graspbench {

/** The journals in a subfolder of the store, by name; none when there is no such folder. */
std::vector<std::filesystem::path> ListJournals(const std::filesystem::path& folder,
                                                const std::string& subfolder = "journal");

/** The journal of a worker: 0.jsonl without a label; with one 3of7-0.jsonl, or, because what a
crash has torn is not continued there, 3of7-0-2.jsonl and so on. */
std::filesystem::path FindJournal(const std::filesystem::path& subfolder, int worker,
                                  const std::string& label);

}  // namespace graspbench
