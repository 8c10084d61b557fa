#pragma once
/** @file
The files that `graspbench trial` writes of one trial: one row of a list each. */

#include <string>
#include <vector>

#include "workbench/text/trial_text.h"

namespace graspbench {

/** How a person wants the pictures. */
struct TrialFileOptions {
  std::string folder;  ///< name of the session's, for a page
  std::string at;      ///< empty: when it was closed, or the end of a shorter trial
  std::vector<std::string> view;
  std::string size = "960x720";
};

struct TrialFile {
  const char* option;  ///< may have several rows: the file's ending says which
  const char* ending;
  const char* hint;  ///< the option's, in the help; of its first row
  const char* text;
  bool needs_every_step;  ///< of the trial; else some 0.01 s apart is enough
  /** The file's bytes. @throws Error when there is nothing to be seen. */
  std::string (*make)(const TrialFileOptions& options, const ExaminedTrial& trial);
};

const std::vector<TrialFile>& ListTrialFiles();

/** The row for a file that was asked for.
@throws Error(kUsage) when it ends in nothing that the option writes. */
const TrialFile& FindTrialFile(const std::string& option, const std::string& file);

}  // namespace graspbench
