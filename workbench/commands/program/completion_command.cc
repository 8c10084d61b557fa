#include <memory>
#include <string>

#include "workbench/commands/command.h"
#include "workbench/text/command_line_text.h"

namespace graspbench {

void AddCompletionCommand(Command& program, ExitCode&) {
  Command& command = AddSubcommand(program, "completion",
                                   "Print a script that completes command lines, or the man page.",
                                   "  source <(graspbench completion bash)\n"
                                   "  graspbench completion man >graspbench.1");
  std::vector<std::string> names = ListShells();
  names.emplace_back("man");
  const auto name = std::make_shared<std::string>();
  command.AddOption("for", *name, ListNames(names))->Require()->OneOf(names)->ValueName("FOR");
  command.SetAction([&program, name] {
    PrintResult(*name == "man" ? FormatManPage(program) : FormatCompletion(program, *name));
  });
}

}  // namespace graspbench
