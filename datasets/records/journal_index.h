#pragma once
/** @file
Which trials a journal holds, as short lines beside it, so that a million of them are counted
without reading gigabytes of records:

    progress/3of7-0.jsonl   of journal/3of7-0.jsonl, one line per trial: its id and where
                            its record's line ends in the journal [bytes], as a checked line

Made from the journal, never sealed, not synced, and may be deleted at any time: what it lacks is
read in the journal. It is believed as far as its last line is true of the journal, and while the
journal was not written to after it. A byte that a disk changes inside a record is therefore not
noticed here; `graspbench verify` looks at every byte. */

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <string_view>

namespace graspbench {

/** Of a line of the plan, a journal or an index: ids stand first in all of them. Empty: the line
begins otherwise. */
std::string_view FindTrialId(std::string_view line);

enum class IndexUse { kBelieve, kIgnore };

/** Calls `take` with the id of each whole record and its line, which is empty where the index names
it.
@param sealed  so many bytes at the journal's beginning are sealed by a manifest: their lines are
counted without a look at their checksums.
@returns how many lines were none, among those that the index does not know.
@throws Error(kNotFound, kIo). */
int ForEachTrialOf(
    const std::filesystem::path& journal, IndexUse index_use, uintmax_t sealed,
    const std::function<void(std::string_view trial_id, std::string_view line)>& take);

class JournalIndex {
 public:
  /** Makes it again unless it ends where the journal ends, which nobody else writes.
  @throws Error(kIo). */
  explicit JournalIndex(const std::filesystem::path& journal);

  /** A record that is on the disk. What cannot be written is missing, no more. */
  void Append(const std::string& trial_id, uintmax_t end);

 private:
  std::ofstream file_;
};

}  // namespace graspbench
