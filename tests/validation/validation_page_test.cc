#include "tests/validation/validation_page.h"

#include <gtest/gtest.h>

#include "core/base/files/files.h"
#include "core/physics/sim_config.h"

namespace graspbench {
namespace {

ValidationRow MakeRow(const std::string& topic, const std::string& claim) {
  ValidationRow row;
  row.topic = topic;
  row.claim = claim;
  row.figure = "1 | 2";
  row.interval = row.bar = row.met = "none";
  row.command = "ask it";
  row.physics_version = "8";
  row.program_version = "0.1.0";
  row.date = "2026-11-22";
  row.machine = "a machine";
  return row;
}

TEST(ValidationPage, MissedBarsComeFirstAndOtherPhysicsIsStale) {
  std::vector<ValidationRow> rows = {MakeRow("Zebras", "z"), MakeRow("Apes", "a"),
                                     MakeRow("Zebras", "y"), MakeRow("Apes", "b")};
  rows[1].physics_version = "9";
  rows[1].bar = "3";
  rows[1].met = "yes";
  rows[2].physics_version = "none";
  rows[2].bar = "4";
  rows[2].met = "no";
  rows[3].physics_version = rows[3].date = "not recorded";
  const std::string head =
      "| claim | figure | interval | bar | met | command | measured |\n"
      "| --- | --- | --- | --- | --- | --- | --- |\n";
  const std::string missed =
      "| y | 1 \\| 2 | - | 4 | **no** | `ask it` | 2026-11-22, program 0.1.0; a machine |\n";
  const std::string expected =
      "4 figures, 2 bars: 1 met, 1 not met. Physics version 9; 1 figure is stale: measured with "
      "another version. Until 2026-11-26 `tum` and `shadow` were the hands\n"
      "that are `tum-evolved` and `shadow-evolved` now, unless a row says \"developed\".\n\n"
      "## Bars that are not met\n\n" +
      head + missed + "\n## Apes\n\n" + head +
      "| a | 1 \\| 2 | - | 3 | yes | `ask it` | 2026-11-22, physics 9, program 0.1.0; a machine |\n"
      "| b | 1 \\| 2 | - | - | - | `ask it` | day not recorded, physics not recorded, program "
      "0.1.0; a machine |\n\n"
      "## Zebras\n\n" +
      head +
      "| z | 1 \\| 2 | - | - | - | `ask it` | 2026-11-22, **stale: physics 8**, program 0.1.0; a "
      "machine |\n" +
      missed;
  const std::string page = FormatValidationPage(rows, 9);
  EXPECT_EQ(page.substr(page.find("4 figures")), expected);
}

TEST(ValidationPage, IsMadeFromTheRowsThatAreThere) {
  const std::filesystem::path manual = FindDataRoot() / "workbench" / "manual";
  Diagnostics problems;
  const std::vector<ValidationRow> rows = LoadValidationRows(manual / "validation", problems);
  ASSERT_EQ(problems.Format(), "") << "mend these rows in workbench/manual/validation";
  EXPECT_TRUE(ReadFile(manual / "validation.md") == FormatValidationPage(rows, kPhysicsVersion))
      << "workbench/manual/validation.md is not what its rows make; write it again with\n"
         "  cmake --build build/release --target validation";
}

}  // namespace
}  // namespace graspbench
