#pragma once
/** @file
An index of the trials in a journal, so that a million trials are counted without reading gigabytes
of records:

    progress/3of7-0.jsonl   index of journal/3of7-0.jsonl: one checked line per trial with its id
                            and the end of its record's line in the journal [bytes]

The index is made from the journal, never sealed, not synced, and may be deleted at any time;
missing entries are read from the journal. It is used if its last line matches the journal and the
journal was not written after it. So it does not detect a changed byte inside a record; `graspbench
verify` checks every byte. */

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <string_view>

namespace graspbench {

/** Returns the trial id at the beginning of a line of the plan, a journal or an index; empty if the
line does not begin with one. */
std::string_view FindTrialId(std::string_view line);

enum class IndexUse { kBelieve, kIgnore };

/** Calls `take` with the id and the line of each valid record. The line is empty if the index has
the record.
@param sealed  number of bytes at the journal's beginning that a manifest seals; checksums of their
lines are not verified.
@returns the number of invalid lines among those that the index does not have.
@throws Error(kNotFound, kIo). */
int ForEachTrialOf(
    const std::filesystem::path& journal, IndexUse index_use, uintmax_t sealed,
    const std::function<void(std::string_view trial_id, std::string_view line)>& take);

class JournalIndex {
 public:
  /** Opens the index, and rebuilds it unless it covers the whole journal. @pre no one else writes
  the journal.
  @throws Error(kIo). */
  explicit JournalIndex(const std::filesystem::path& journal);

  /** Adds a record that is on disk. A failed write only leaves the entry missing. */
  void Append(const std::string& trial_id, uintmax_t end);

 private:
  std::ofstream file_;
};

}  // namespace graspbench
