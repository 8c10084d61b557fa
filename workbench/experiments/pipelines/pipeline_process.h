#pragma once
/** @file
A stage of a pipeline as a process of this program. */

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace graspbench {

class PipelineProcess {
 public:
  /** Starts `graspbench WORDS` in the folder. It ends when this program does, however that ends.
  @param output  file for what it prints; @param log  for what it says, or for both: the same file.
  @throws Error(kIo, kEnvironment). */
  PipelineProcess(const std::vector<std::string>& words, const std::filesystem::path& folder,
                  const std::filesystem::path& output, const std::filesystem::path& log);
  /** Kills it unless it has ended. */
  ~PipelineProcess();
  PipelineProcess(const PipelineProcess&) = delete;
  PipelineProcess& operator=(const PipelineProcess&) = delete;

  /** Its exit code when it has ended, 128 and the signal when that ended it. */
  std::optional<int> Poll();
  /** Asks it to end soon, so that it can be resumed. */
  void Interrupt() const;

 private:
  pid_t process_ = -1;
};

}  // namespace graspbench
