#pragma once
/** @file
Kinds of store, folders that can be resumed and are sealed: what identifies each kind, which files
never change and which only grow. There is one row per kind; a change of its layout or records must
increase its schema here. */

#include <filesystem>
#include <string>
#include <vector>

namespace graspbench {

/** Lines of a kind of journal, identified by the keys of their objects. */
struct LineKind {
  std::vector<std::string> journals;  ///< patterns
  std::vector<std::string> keys;      ///< present in every line
  const char* other_key = "";         ///< present in lines of a similar kind only
  const char* question_key = "";      ///< each value occurs once per journal; empty: none
  const char* result = "";            ///< derived file after which no line follows; empty: none
};

struct StoreKind {
  const char* name;     ///< "session"
  const char* file;     ///< the frozen configuration, which makes a folder a store
  int schema;           ///< of layout and records; no other is read or written
  const char* command;  ///< that starts one: "graspbench run"
  const char* remedy;   ///< if the schema differs: "rerun the session into a new folder"

  // Paths relative to the folder; one star per component stands for any characters but a slash.
  std::vector<std::string> files;     ///< never change
  std::vector<std::string> derived;   ///< never change, and can be rebuilt from the rest
  std::vector<std::string> journals;  ///< grow by checked lines
  std::vector<std::string> stores;    ///< folders with their own manifest

  /** Whether a line torn by a crash stays in its journal and the next one starts on a new line.
  Otherwise it is cut off before the journal is continued. */
  bool keeps_torn_lines = false;

  /** Journals that other processes may be writing while the store is sealed: only their whole lines
  are sealed. None of them is continued after a torn line (FindJournal in read_journal.h). */
  std::vector<std::string> shared_journals = {};

  /** Folders of derived results that can be rebuilt at any time; see SealOutput. */
  std::vector<std::string> outputs = {};

  /** Kinds of lines in the journals; a journal that matches none may contain any checked line. */
  std::vector<LineKind> lines = {};
};

extern const StoreKind kSessionStore;
extern const StoreKind kSceneStore;
extern const StoreKind kCampaignStore;
extern const StoreKind kDevelopmentStore;
extern const StoreKind kJudgedGraspStore;
extern const StoreKind kRehearsalStore;

/** Returns the kind whose frozen configuration the folder contains; null: none. */
const StoreKind* FindStoreKind(const std::filesystem::path& folder);

bool IsMatch(const std::string& name, const std::vector<std::string>& patterns);

/** Lists paths in the folder that match a pattern, sorted. */
std::vector<std::string> ListMatches(const std::filesystem::path& folder,
                                     const std::vector<std::string>& patterns);

}  // namespace graspbench
