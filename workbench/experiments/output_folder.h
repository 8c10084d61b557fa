#pragma once
/** @file
Checks where results may be written, so that no file of the user is lost.

A folder belongs to graspbench when it holds a mark: the frozen configuration of a result that can
be continued (session.json, campaign.json, scene.json), or a manifest.json that names the kind of a
whole result and lists its files with their hashes (datasets/journal/manifest.h). A new result goes
into a missing or empty folder. A whole result may replace an older one of its kind if all files
there are listed and unchanged, except those that its own scripts write. Everything else is refused
by name: foreign or changed files, an existing file, an empty name, the home folder, a mount point,
a folder that holds an input.

A new folder is filled beside the target, in `.<name>.part-<random>`, and swapped in when it is
complete, so that the target holds the old result, the new one, or nothing. Leftovers of a killed
process on this machine are removed by the next one (file_lock.h). */

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "datasets/journal/file_lock.h"

namespace graspbench {

struct OutputRequest {
  std::filesystem::path folder;
  std::string kind;      ///< of a whole result: "basin", "study"; empty: it has its own mark
  bool replace = false;  ///< overwrite an older result of this kind
  std::vector<std::filesystem::path>
      inputs;                ///< files and folders that are read; empty names are ignored
  std::string command = {};  ///< of a whole result, for its manifest; without paths
  /** Paths within a result that its own scripts write; they are replaced with it. */
  std::vector<std::string> derived = {};
};

/** @throws Error(kUsage) naming what blocks the output. */
void CheckOutputFolder(const OutputRequest& request);

/** Check for commands that copy their input. @throws Error(kUsage) when `folder` is `input` or lies
in it. */
void CheckOutside(const std::filesystem::path& folder, const std::filesystem::path& input);
/** Refuses output paths of the user inside a result's folder, which may hold only files of the
result. @throws Error(kUsage) for a path inside one. */
void CheckOutsideResults(const std::filesystem::path& path);

/** Checks that a single output file does not exist yet and lies outside of results.
@throws Error(kUsage). */
void CheckOutputFile(const std::filesystem::path& file);
/** Writes a file and creates its folders. @throws as CheckOutputFile; Error(kIo). */
void WriteOutputFile(const std::filesystem::path& file, const std::string& content);

/** Lists the files that a store, and the writers of its outputs, have put into its folder. */
std::vector<std::string> ListStoreFiles(const std::filesystem::path& folder);

class StagedFolder {
 public:
  /** Who writes the manifest of a result with a kind: this class, or the code that fills the
  folder. */
  enum class Mark { kWhole, kOwn };

  /** Checks the request and creates the folder beside the target. @throws Error(kUsage, kIo). */
  explicit StagedFolder(OutputRequest request, Mark mark = Mark::kWhole);
  /** Removes the folder unless it was committed. */
  ~StagedFolder();
  StagedFolder(const StagedFolder&) = delete;
  StagedFolder& operator=(const StagedFolder&) = delete;

  /** The folder to write into. */
  const std::filesystem::path& path() const { return staged_; }

  /** Marks the result and swaps it in; an older one is removed. @throws Error(kUsage) when the
  target has been blocked meanwhile; Error(kIo). */
  void Commit();

 private:
  /** Returns false when another process removed the folder as abandoned before it was locked. */
  bool TryStage();

  OutputRequest request_;
  Mark mark_;
  std::filesystem::path target_;  // without symbolic links
  std::filesystem::path staged_;
  int lock_file_ = -1;
  std::optional<FileLock> lock_;  // held as long as the program lives
};

}  // namespace graspbench
