/** @file make_manual SOURCE FOLDER SHARE: at build time. Writes the manual's pages to FOLDER, and
the man page and the completions, which the parser knows, to where they are installed below SHARE.
*/

#include <filesystem>
#include <string>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "workbench/manual/maker/manual_site.h"
#include "workbench/program.h"
#include "workbench/terminal/command_line.h"
#include "workbench/terminal/terminal.h"
#include "workbench/text/command_line_text.h"

int main(int argc, char** argv) {
  using namespace graspbench;
  namespace fs = std::filesystem;
  if (argc != 4) {
    PrintMessage("usage: make_manual SOURCE FOLDER SHARE");
    return kExitUsage;
  }
  try {
    Command program;
    AddCommands(program);
    WriteManual(program, argv[1], argv[2]);
    const fs::path share = argv[3];
    const std::pair<fs::path, std::string> texts[] = {
        {share / "man/man1/graspbench.1", FormatManPage(program)},
        {share / "bash-completion/completions/graspbench", FormatCompletion(program, "bash")},
        {share / "zsh/site-functions/_graspbench", FormatCompletion(program, "zsh")},
        {share / "fish/vendor_completions.d/graspbench.fish", FormatCompletion(program, "fish")}};
    for (const auto& [file, text] : texts) {
      MakeFolder(file.parent_path());
      WriteFile(file, text);
    }
  } catch (const Error& error) {
    PrintMessage(std::string("make_manual: ") + error.what());
    return ExitCodeOf(error.kind());
  }
  return kExitOk;
}
