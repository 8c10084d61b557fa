#pragma once
/** @file
Reading command lines: on a terminal with editing, history, incremental search (Ctrl-R) and
completion (Tab), elsewhere as they come. */

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace graspbench {

class LineEditor {
 public:
  using Completer = std::function<std::vector<std::string>(const std::string& line)>;

  LineEditor(const std::string& prompt, Completer completer);
  ~LineEditor();
  /** The next line without its end; empty after Ctrl-C; unset at the end of input. */
  std::optional<std::string> Read();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace graspbench
