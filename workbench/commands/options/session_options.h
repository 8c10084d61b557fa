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
  void AddTo(CLI::App& command);
  /** Whether any of them was given. */
  bool HasAny() const;
  /** The session file, then --set, then the options. @throws Error(kUsage) for a setting given by
  both; as LoadSessionConfig, ApplySetting. */
  SessionConfig MakeConfig() const;
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
