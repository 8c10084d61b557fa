#pragma once
/** @file
Command options that name the session to run: a session file or a preset, and overrides. */

#include <string>
#include <vector>

#include "datasets/plan/session_config.h"

namespace graspbench {

class Command;

class SessionOptions {
 public:
  /** @param file_text  help text of the file argument. */
  void AddTo(Command& command, const std::string& file_text =
                                   "session file: YAML, or session.json of a session; absent: the "
                                   "benchmark");
  /** "--benchmark": settings that the benchmark fixes are refused. */
  void AddBenchmarkTo(Command& command);
  /** Whether any option was given. */
  bool HasAny() const;
  /** Returns the benchmark's session; without a benchmark, the defaults. @throws as LoadPinned. */
  SessionConfig FindBase() const;
  /** Applies the session file, the preset or else `config`, then --set, then the options.
  @throws Error(kUsage) for a setting given twice, for both a file and a preset, and for a setting
  that the benchmark fixes; as LoadSessionConfig, LoadPreset, ApplySetting. */
  SessionConfig MakeConfig(SessionConfig config = {}) const;
  /** Applies the options over a configuration from another kind of file. @throws as MakeConfig. */
  void ApplyTo(SessionConfig& config) const;
  const std::string& file() const { return session_file_; }
  /** Name of the preset, the benchmark or the session file (without folder and extension); else
  "benchmark". */
  std::string name() const;

 private:
  bool IsGiven(const char* option) const;
  void RefuseTwice(const std::string& setting) const;

  std::string session_file_, preset_, benchmark_;
  std::string arm_base_;  ///< X,Y,Z,YAW [m], [deg]
  SessionConfig given_;   ///< the values of the options that were given, else defaults
  std::vector<std::string> settings_;
  const Command* command_ = nullptr;
};

}  // namespace graspbench
