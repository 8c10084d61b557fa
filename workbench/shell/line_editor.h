#pragma once
/** @file
Reading command lines: on a terminal with editing, history, incremental search (Ctrl-R) and
completion (Tab). */

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace graspbench {

class LineEditor {
 public:
  using Completer = std::function<std::vector<std::string>(const std::string& line)>;

  /** @param prompt  called before every line.
  @param history_file  history of earlier shells, to which each line is appended; empty: none. If it
  cannot be written, editing still works. */
  LineEditor(std::function<std::string()> prompt, Completer completer,
             const std::filesystem::path& history_file = {});
  ~LineEditor();
  /** Reads the next line without its line ending; empty after Ctrl-C; unset at the end of input. */
  std::optional<std::string> Read();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/** Path in the user's state folder (XDG_STATE_HOME, else ~/.local/state); empty: there is none. */
std::filesystem::path FindHistoryFile();

/** Restores the terminal settings from before the first LineEditor. Safe in signal handlers. */
void RestoreTerminal();

}  // namespace graspbench
