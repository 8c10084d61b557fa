#pragma once
/** @file
The options by which a command names what to run: a session file and what overrides it. */

#include <string>
#include <vector>

#include "datasets/plan/session_config.h"

namespace CLI {
class App;
}

namespace graspbench {

class SessionOptions {
 public:
  /** @param file_text  what the file is that may be named. */
  void AddTo(CLI::App& command, const std::string& file_text =
                                    "session file: YAML, or session.json of a session; absent: the "
                                    "benchmark");
  /** Whether any of them was given. */
  bool HasAny() const;
  /** The session file, then --set, then the options. @throws Error(kUsage) for a setting given by
  both; as LoadSessionConfig, ApplySetting. */
  SessionConfig MakeConfig() const;
  /** The same over what another kind of file says. */
  void ApplyTo(SessionConfig& config) const;
  const std::string& file() const { return session_file_; }
  /** The session file's name without folder and extension; "benchmark" without one. */
  std::string name() const;

 private:
  bool IsGiven(const char* option) const;
  void RefuseTwice(const std::string& setting) const;

  std::string session_file_;
  SessionConfig given_;  ///< the values of the options that were given, else defaults
  std::vector<std::string> settings_;
  const CLI::App* command_ = nullptr;
};

}  // namespace graspbench
