#pragma once
/** @file
The options by which a command names what to run: a session file or a preset, and what overrides
it. */

#include <string>
#include <vector>

#include "datasets/plan/session_config.h"

namespace graspbench {

class Command;

class SessionOptions {
 public:
  /** @param file_text  what the file is that may be named. */
  void AddTo(Command& command, const std::string& file_text =
                                   "session file: YAML, or session.json of a session; absent: the "
                                   "benchmark");
  /** "--benchmark": other settings than it leaves open are refused. */
  void AddBenchmarkTo(Command& command);
  /** Whether any of them was given. */
  bool HasAny() const;
  /** The benchmark's session; without one the defaults. @throws as LoadPinned. */
  SessionConfig FindBase() const;
  /** The session file, the preset or else `config`, then --set, then the options.
  @throws Error(kUsage) for a setting given by both, a file and a preset, or what the benchmark does
  not leave open; as LoadSessionConfig, LoadPreset, ApplySetting. */
  SessionConfig MakeConfig(SessionConfig config = {}) const;
  /** The same over what another kind of file says. @throws as MakeConfig. */
  void ApplyTo(SessionConfig& config) const;
  const std::string& file() const { return session_file_; }
  /** That of the preset or the benchmark, or of the session file without folder and extension; else
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
