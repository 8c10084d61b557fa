#include "workbench/manual/maker/reference.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "workbench/program.h"
#include "workbench/terminal/command_line.h"

namespace graspbench {
namespace {

TEST(Reference, EveryCommandHasItsHelp) {
  ExitCode exit_code = kExitOk;
  Command program;
  AddCommands(program, exit_code);
  const std::string page = MakeCommandReference(program);
  EXPECT_NE(page.find("\n## graspbench hand import\n"), page.npos);
  EXPECT_NE(page.find("Examples:\n  graspbench hand import"), page.npos) << page.substr(0, 2000);
}

TEST(Reference, KeysColumnsAndCodesStandInTables) {
  const std::string files = MakeFileReference();
  EXPECT_NE(files.find("\n## object.yaml\n"), files.npos);
  EXPECT_NE(files.find("| `mass_kg` | kg | 0.0001 to 100 | "), files.npos);
  EXPECT_NE(MakeColumnReference().find("| `gft_s` | number | s | "), std::string::npos);
  const std::string outcomes = MakeOutcomeReference();
  EXPECT_NE(outcomes.find("| dropped while holding | `DH` |"), outcomes.npos);
  EXPECT_EQ(outcomes.find("not run"), outcomes.npos);
  EXPECT_NE(outcomes.find("| 75 | "), outcomes.npos);
}

}  // namespace
}  // namespace graspbench
