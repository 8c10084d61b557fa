#pragma once
/** @file
The session as an SQLite database, for questions in SQL: table `trials` (the columns of
trial_table.h) and table `cells` (one row per hand, object and grasp of the plan). Made from plan
and journals; nothing is stored in it alone. */

#include <filesystem>
#include <memory>

#include "datasets/records/trial_table.h"
#include "datasets/session/session_store.h"

namespace graspbench {

/** Filled trial by trial, in memory; the same session gives the same bytes. */
class SessionIndex {
 public:
  /** @throws Error(kFormat) when the columns' names are not those of a table. */
  explicit SessionIndex(const std::vector<TrialColumn>& columns);
  ~SessionIndex();
  /** A row of the table of trials. */
  void AddTrial(const std::vector<Json>& cells);
  /** Adds the cells. @throws Error(kIo). */
  void Write(const Session& session, const std::filesystem::path& path);

 private:
  class Database;
  std::unique_ptr<Database> db_;
};

}  // namespace graspbench
