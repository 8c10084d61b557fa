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

  /** @param prompt  asked before every line.
  @param history_file  of earlier shells, to which each line is added; empty: none. Without it,
  or when it cannot be written, everything else goes on. */
  LineEditor(std::function<std::string()> prompt, Completer completer,
             const std::filesystem::path& history_file = {});
  ~LineEditor();
  /** The next line without its end; empty after Ctrl-C; unset at the end of input. */
  std::optional<std::string> Read();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/** In the user's folder of states (XDG_STATE_HOME, else ~/.local/state); empty: there is none. */
std::filesystem::path FindHistoryFile();

/** Gives the terminal the settings that it had before the first LineEditor. For signal handlers. */
void RestoreTerminal();

}  // namespace graspbench
