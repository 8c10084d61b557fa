#pragma once
/** @file
Where results may go, so that nothing of the user's is lost.

A folder is graspbench's when it holds a mark: the frozen configuration of what can be continued
(session.json, campaign.json, scene.json), or a manifest.json that names the kind of a whole result
and lists its files with their hashes (datasets/journal/manifest.h). A new result goes into a folder
that is not there or empty; a whole result may take the place of an older one of its kind whose
files are all listed and unchanged, but for those that its own scripts write. Everything else is
refused and named: foreign or changed files, an existing file, an empty name, the home folder, a
mount point, a folder that holds an input.

A new folder is filled beside the target, in `.<name>.part-<random>`, and swapped in when it is
complete, so that the target holds the old result, the new one, or nothing. What a killed program of
this machine left there is removed by the next (file_lock.h). */

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "datasets/journal/file_lock.h"

namespace graspbench {

struct OutputRequest {
  std::filesystem::path folder;
  std::string kind;      ///< of a whole result: "basin", "study"; empty: it brings its own mark
  bool replace = false;  ///< an older result of this kind
  std::vector<std::filesystem::path>
      inputs;                ///< files and folders that are read; empty ones count not
  std::string command = {};  ///< of a whole result, for its manifest; without names of places
  /** Paths within a result that programs which come with it write there; they go with it. */
  std::vector<std::string> derived = {};
};

/** @throws Error(kUsage) naming what stands in the way. */
void CheckOutputFolder(const OutputRequest& request);

/** For what copies its input. @throws Error(kUsage) when `folder` is `input` or lies in it. */
void CheckOutside(const std::filesystem::path& folder, const std::filesystem::path& input);
/** Into a result's folder goes only what belongs to the result: no file or folder that a person
names. @throws Error(kUsage) for a place inside of one. */
void CheckOutsideResults(const std::filesystem::path& path);

/** A single file is written only where none is, outside of results. @throws Error(kUsage). */
void CheckOutputFile(const std::filesystem::path& file);
/** Writes it, and the folders that it needs. @throws as CheckOutputFile; Error(kIo). */
void WriteOutputFile(const std::filesystem::path& file, const std::string& content);

/** What a store, and whoever made outputs of it, has written into its folder. */
std::vector<std::string> ListStoreFiles(const std::filesystem::path& folder);

class StagedFolder {
 public:
  /** Who writes the manifest of a result with a kind: this, or what fills the folder. */
  enum class Mark { kWhole, kOwn };

  /** Checks the request and creates the folder beside the target. @throws Error(kUsage, kIo). */
  explicit StagedFolder(OutputRequest request, Mark mark = Mark::kWhole);
  /** Removes the folder unless it was committed. */
  ~StagedFolder();
  StagedFolder(const StagedFolder&) = delete;
  StagedFolder& operator=(const StagedFolder&) = delete;

  /** Write here. */
  const std::filesystem::path& path() const { return staged_; }

  /** Marks the result and swaps it in; an older one is removed. @throws Error(kUsage) when something
  has come into the way since; Error(kIo). */
  void Commit();

 private:
  /** False where another program took the folder for abandoned before the lock was there. */
  bool TryStage();

  OutputRequest request_;
  Mark mark_;
  std::filesystem::path target_;  // without links
  std::filesystem::path staged_;
  int lock_file_ = -1;
  std::optional<FileLock> lock_;  // held as long as the program lives
};

}  // namespace graspbench
