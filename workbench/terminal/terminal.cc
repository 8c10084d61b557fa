#include "workbench/terminal/terminal.h"

#include "core/base/error.h"
#include "core/base/text/escape.h"

namespace graspbench {

void PrintControlled(std::FILE* stream, std::string_view text) {
  std::fwrite(text.data(), 1, text.size(), stream);
  std::fflush(stream);
}

void PrintResult(std::string_view text) { PrintControlled(stdout, EscapeForTerminal(text)); }

void PrintJson(const Json& json) { PrintResult(FormatJson(json, 2) + "\n"); }

void PrintMessage(std::string_view text) {
  PrintControlled(stderr, EscapeForTerminal(text) + "\n");
}

void FlushResults() {
  if (std::fflush(stdout) != 0 || std::ferror(stdout)) {
    throw Error(ErrorKind::kIo, "cannot write to the standard output");
  }
}

}  // namespace graspbench
