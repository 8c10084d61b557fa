#include <unistd.h>

#include <fstream>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/files/files.h"
#include "core/base/text/text.h"
#include "workbench/command.h"
#include "workbench/experiments/output_folder.h"
#include "workbench/shell/line_editor.h"
#include "workbench/shell/shell.h"
#include "workbench/shell/shell_commands.h"
#include "workbench/terminal/terminal.h"

namespace graspbench {
namespace {

struct ShellOptions {
  std::vector<std::string> commands;
  std::string file;
  std::string log;
};

/** Lines of a script, of the standard input or of a person, one after the other. */
struct LineSource {
  std::function<std::optional<std::string>()> next;
  bool is_person = false, is_numbered = false;  ///< messages say which line was wrong
};

LineSource ReadFrom(std::istream& stream) {
  LineSource source;
  source.is_numbered = true;
  source.next = [&stream]() -> std::optional<std::string> {
    std::string line;
    return std::getline(stream, line) ? std::optional(line) : std::nullopt;
  };
  return source;
}

/** Every line as it was given, before it is carried out: the log is a script. */
class ShellLog {
 public:
  explicit ShellLog(const std::string& file) {
    if (file.empty()) return;
    CheckOutputFile(file);
    stream_.open(file);
    if (!stream_) throw Error(ErrorKind::kIo, "cannot write the log \"" + file + "\"");
  }
  void Write(const std::string& line) {
    if (!stream_.is_open() || has_failed_) return;
    stream_ << line << std::endl;
    if (stream_) return;
    has_failed_ = true;
    PrintMessage("cannot write the log; is the disk full? The shell continues without it.");
  }
  bool has_failed() const { return has_failed_; }

 private:
  bool has_failed_ = false;
  std::ofstream stream_;
};

/** A script ends at its first line that is refused, unless it says "set -e off"; its exit code is
that of a wrong usage either way. A person goes on. */
ExitCode Converse(Shell& shell, ShellLog& log, const LineSource& source) {
  ExitCode exit_code = kExitOk;
  int number = 0;
  while (const std::optional<std::string> line = source.next()) {
    log.Write(*line);
    ++number;
    const Shell::Reply reply =
        shell.Execute(*line, source.is_numbered ? "line " + std::to_string(number) + ": " : "");
    if (MustShellEnd()) return kExitInterrupted;
    if (shell.was_stopped()) log.Write("goto " + FormatFixed(shell.scene().time(), 6));
    if (reply == Shell::Reply::kQuit) break;
    if (reply == Shell::Reply::kRefused && !source.is_person) {
      exit_code = kExitUsage;
      if (shell.stops_at_errors()) {
        PrintMessage("the script ended at its first error (set -e off: continue after errors)");
        break;
      }
    }
    if (!source.is_person && shell.was_stopped()) return kExitInterrupted;
  }
  return log.has_failed() ? kExitFailed : exit_code;
}

ExitCode RunShell(const ShellOptions& options) {
  if (!options.commands.empty() && !options.file.empty()) {
    throw Error(ErrorKind::kUsage, "both -c and a file are given; expected one of them");
  }
  std::ifstream script;
  if (!options.file.empty()) {
    ReadFile(options.file);  // says what is wrong with it
    script.open(options.file);
  }
  ShellLog log(options.log);
  Shell shell;
  CatchShellSignals();
  if (!options.commands.empty()) {
    size_t next = 0;
    LineSource source;
    source.next = [&]() -> std::optional<std::string> {
      return next < options.commands.size() ? std::optional(options.commands[next++])
                                            : std::nullopt;
    };
    return Converse(shell, log, source);
  }
  if (!options.file.empty()) return Converse(shell, log, ReadFrom(script));
  if (!::isatty(STDIN_FILENO)) return Converse(shell, log, ReadFrom(std::cin));
  const SessionConfig& first = shell.choice().config;
  PrintResult("hand " + first.hands.front() + ", object " + first.objects.front() +
              "; help lists the commands, Tab completes names, Ctrl-C stops what runs\n");
  LineEditor editor([&shell] { return FormatPrompt(shell); },
                    [&shell](const std::string& line) { return FindCompletions(shell, line); },
                    FindHistoryFile());
  LineSource source;
  source.next = [&editor] { return editor.Read(); };
  source.is_person = true;
  return Converse(shell, log, source);
}

}  // namespace

void AddShellCommand(Command& program) {
  Command& command =
      AddSubcommand(program, "shell", "Run one trial interactively or by a script.",
                    "  graspbench shell\n"
                    "  graspbench shell -c 'hand shadow' -c 'object light bulb' -c run -c why");
  const auto options = std::make_shared<ShellOptions>();
  command.AddOption("file", options->file, "script with one command per line", "FILE");
  command.AddOption("-c", options->commands, "a command; may be repeated", "CMD")->OneValueEach();
  command.AddOption("--log", options->log, "file for the entered lines, usable as a script",
                    "FILE");
  command.SetAction([options] { return RunShell(*options); });
}

}  // namespace graspbench
