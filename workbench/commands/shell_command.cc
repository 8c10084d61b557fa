#include <unistd.h>

#include <CLI/CLI.hpp>
#include <fstream>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/files.h"
#include "core/base/text.h"
#include "workbench/commands/command.h"
#include "workbench/experiments/output_folder.h"
#include "workbench/shell/line_editor.h"
#include "workbench/shell/shell.h"
#include "workbench/shell/shell_commands.h"

namespace graspbench {
namespace {

struct ShellOptions {
  std::vector<std::string> commands;
  std::string file;
  std::string log;
};

/** Lines of a script, of the standard input or of a person, one after the other. */
using LineSource = std::function<std::optional<std::string>()>;

LineSource ReadFrom(std::istream& stream) {
  return [&stream]() -> std::optional<std::string> {
    std::string line;
    return std::getline(stream, line) ? std::optional(line) : std::nullopt;
  };
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
    if (!stream_.is_open()) return;
    stream_ << line << std::endl;
    if (!stream_) throw Error(ErrorKind::kIo, "cannot write the log; is the disk full?");
  }

 private:
  std::ofstream stream_;
};

/** Refused lines of a script make it end with the exit code of a wrong usage; a person sees them. */
ExitCode Converse(Shell& shell, ShellLog& log, const LineSource& next, bool is_person) {
  ExitCode exit_code = kExitOk;
  while (const std::optional<std::string> line = next()) {
    log.Write(*line);
    const Shell::Reply reply = shell.Execute(*line);
    if (MustShellEnd()) return kExitInterrupted;
    if (shell.was_stopped()) log.Write("goto " + FormatFixed(shell.scene().time(), 6));
    if (reply == Shell::Reply::kQuit) break;
    if (reply == Shell::Reply::kRefused && !is_person) exit_code = kExitUsage;
    if (!is_person && shell.was_stopped()) return kExitInterrupted;
  }
  return exit_code;
}

ExitCode RunShell(const ShellOptions& options) {
  if (!options.commands.empty() && !options.file.empty()) {
    throw Error(ErrorKind::kUsage, "-c and a file were given; expected one of them");
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
    return Converse(
        shell, log,
        [&]() -> std::optional<std::string> {
          return next < options.commands.size() ? std::optional(options.commands[next++])
                                                : std::nullopt;
        },
        false);
  }
  if (!options.file.empty()) return Converse(shell, log, ReadFrom(script), false);
  if (!::isatty(STDIN_FILENO)) return Converse(shell, log, ReadFrom(std::cin), false);
  ShowScene(shell, {});
  PrintResult("help lists the commands\n");
  LineEditor editor("graspbench> ",
                    [&shell](const std::string& line) { return FindCompletions(shell, line); });
  return Converse(
      shell, log, [&editor] { return editor.Read(); }, true);
}

}  // namespace

void AddShellCommand(CLI::App& program, ExitCode& exit_code) {
  CLI::App& command =
      AddSubcommand(program, "shell", "Move one trial step by step, at a prompt or by a script.",
                    "  graspbench shell\n"
                    "  graspbench shell -c 'hand shadow' -c 'object light bulb' -c run -c why");
  const auto options = std::make_shared<ShellOptions>();
  command.add_option("file", options->file, "script: a command a line")->option_text("FILE");
  command.add_option("-c", options->commands, "a command; again for more")
      ->allow_extra_args(false)
      ->option_text("CMD");
  command.add_option("--log", options->log, "keep all lines as a script")->option_text("FILE");
  command.callback([options, &exit_code] { exit_code = RunShell(*options); });
}

}  // namespace graspbench
