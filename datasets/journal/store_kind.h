#pragma once
/** @file
The folders that are continued and vouched for: what makes a folder one, which of its files never
change and which only grow. One row a kind; whoever changes the layout or the records of one raises
its schema here. */

#include <filesystem>
#include <string>
#include <vector>

namespace graspbench {

/** What the lines of a journal are, by the keys of their objects. */
struct LineKind {
  std::vector<std::string> journals;  ///< patterns
  std::vector<std::string> keys;      ///< that every line has
  const char* other_key = "";         ///< that lines of a similar kind have, and these do not
  const char* question_key = "";      ///< whose value a journal answers once; empty: none
  const char* result = "";            ///< derived file that says that no line follows; empty: none
};

struct StoreKind {
  const char* name;     ///< "session"
  const char* file;     ///< of the frozen configuration: its presence makes the folder one
  int schema;           ///< of the layout and the records: the only one that is written and read
  const char* command;  ///< "graspbench run": starts one
  const char* remedy;   ///< for another schema: "rerun the session into a new folder"

  // Names from the folder; one star in a part stands for any letters but a slash.
  std::vector<std::string> files;     ///< never change
  std::vector<std::string> derived;   ///< never change, and can be made again from the rest
  std::vector<std::string> journals;  ///< grow by checked lines
  std::vector<std::string> stores;    ///< folders with a manifest of their own

  /** Whether a line that a crash has torn stays in its journal, and the next one follows on a line
  of its own; or it is cut off before the journal is continued. */
  bool keeps_torn_lines = false;

  /** Journals among these that other processes may be writing while the store is sealed: only their
  whole lines are. None of them is continued behind a torn line (FindJournal of session_store.h). */
  std::vector<std::string> shared_journals = {};

  /** Folders of what is made from the store and can be made again at any time: see SealOutput. */
  std::vector<std::string> outputs = {};

  /** Of the journals; in one that is named by none of them any checked line may stand. */
  std::vector<LineKind> lines = {};
};

extern const StoreKind kSessionStore;
extern const StoreKind kSceneStore;
extern const StoreKind kCampaignStore;
extern const StoreKind kDevelopmentStore;
extern const StoreKind kJudgedGraspStore;
extern const StoreKind kRehearsalStore;

/** The kind whose frozen configuration the folder holds; null: none. */
const StoreKind* FindStoreKind(const std::filesystem::path& folder);

bool IsMatch(const std::string& name, const std::vector<std::string>& patterns);

/** Names in the folder that match a pattern, sorted. */
std::vector<std::string> ListMatches(const std::filesystem::path& folder,
                                     const std::vector<std::string>& patterns);

}  // namespace graspbench
