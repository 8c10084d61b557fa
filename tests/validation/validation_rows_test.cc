#include "tests/validation/validation_rows.h"

#include <gtest/gtest.h>

#include "core/base/files/files.h"
#include "core/physics/sim_config.h"

namespace graspbench {
namespace {

/** A good file, a line each from 1; tests spoil one line. */
std::vector<std::string> MakeLines() {
  return {"topic: Speed",
          "rows:",
          "  - claim: a trial, processor time",
          "    figure: 52 ms",
          "    interval: none",
          "    bar: 30 ms",
          "    met: no",
          "    command: build/release/tests/bench/sim_bench",
          "    physics_version: 8",
          "    program_version: 0.1.0",
          "    date: 2026-11-22",
          "    machine: 2 cores, AMD EPYC"};
}

std::string Join(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

/** The problems of the good file with line `number` replaced; empty: taken out. */
std::string FindProblems(int number, const std::string& line) {
  std::vector<std::string> lines = MakeLines();
  lines[number - 1] = line;
  if (line.empty()) lines.erase(lines.begin() + number - 1);
  Diagnostics problems;
  ParseValidationRows(Join(lines), "speed.yaml", problems);
  return problems.Format();
}

TEST(ValidationRows, AreReadAsTheyStand) {
  Diagnostics problems;
  const std::vector<ValidationRow> rows =
      ParseValidationRows(Join(MakeLines()) + "    row: 6\n", "speed.yaml", problems);
  ASSERT_EQ(problems.Format(), "");
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0].topic, "Speed");
  EXPECT_EQ(rows[0].figure, "52 ms");
  EXPECT_EQ(rows[0].met, "no");
  EXPECT_EQ(rows[0].physics_version, "8");
  EXPECT_EQ(rows[0].date, "2026-11-22");
  EXPECT_EQ(rows[0].row, 6);
}

TEST(ValidationRows, FaultsAreToldWithFileAndLine) {
  struct Case {
    int number;
    std::string line;
    std::string expected;
  };
  const Case cases[] = {
      {12, "", "speed.yaml:3: error: a row: the key \"machine\" is missing"},
      {8, "", "speed.yaml:3: error: a row: the key \"command\" is missing"},
      {4, "    figures: 52 ms", "speed.yaml:4: error: a row: unknown key \"figures\""},
      {4, "    figure: \"  \"", "speed.yaml:4: error: a row, figure: is empty"},
      {7, "    met: none", "speed.yaml:7: error: a row, met: none though there is a bar"},
      {6, "    bar: none", "speed.yaml:7: error: a row, met: \"no\" though there is no bar"},
      {7, "    met: nearly", "speed.yaml:7: error: a row, met: \"nearly\"; expected yes, no"},
      {9, "    physics_version: eight", "speed.yaml:9: error: a row, physics_version: \"eight\""},
      {9, "    physics_version: 0", "speed.yaml:9: error: a row, physics_version: \"0\""},
      {10, "    program_version: new", "speed.yaml:10: error: a row, program_version: \"new\""},
      {11, "    date: 22.11.2026", "speed.yaml:11: error: a row, date: \"22.11.2026\""},
      {11, "    date: 2026-13-22", "speed.yaml:11: error: a row, date: \"2026-13-22\""},
      {1, "", "speed.yaml:1: error: the file: the key \"topic\" is missing"},
      {1, "topic: [", "speed.yaml:3: error: not valid YAML"},
  };
  for (const Case& c : cases) {
    const std::string problems = FindProblems(c.number, c.line);
    EXPECT_NE(problems.find(c.expected), std::string::npos) << c.line << "\n" << problems;
  }
  Diagnostics of_nothing;
  ParseValidationRows("topic: Speed\nrows: []\n", "speed.yaml", of_nothing);
  EXPECT_NE(of_nothing.Format().find("rows has no row"), std::string::npos) << of_nothing.Format();
  Diagnostics of_text;
  ParseValidationRows("topic: Speed\nrows:\n  - a figure\n", "speed.yaml", of_text);
  EXPECT_NE(of_text.Format().find("speed.yaml:3: error: a row: expected a map"), std::string::npos)
      << of_text.Format();
}

TEST(ValidationRows, SixtyWordsAreAllowed) {
  // Without those of the figure the row has 4 + 1 + 2 + 1 + 1 + 1 + 1 + 1 + 4 = 16.
  std::string words;
  for (int i = 0; i < 44; ++i) words += " word";
  EXPECT_EQ(FindProblems(4, "    figure:" + words), "");
  EXPECT_NE(FindProblems(4, "    figure: one" + words)
                .find("speed.yaml:3: error: a row, claim: the row has 61 words in all, at most 60"),
            std::string::npos);
}

TEST(ValidationRows, ClaimsStandOnce) {
  std::vector<std::string> lines = MakeLines();
  const std::vector<std::string> again(lines.begin() + 2, lines.end());
  lines.insert(lines.end(), again.begin(), again.end());
  Diagnostics problems;
  ParseValidationRows(Join(lines), "speed.yaml", problems);
  EXPECT_NE(problems.Format().find("speed.yaml:13: error: the claim \"a trial, processor time\" "
                                   "stands in line 3 already"),
            std::string::npos)
      << problems.Format();

  const std::filesystem::path folder =
      std::filesystem::path(testing::TempDir()) / "validation_rows_claims";
  MakeFolder(folder);
  WriteFile(folder / "a.yaml", Join(MakeLines()));
  WriteFile(folder / "b.yaml", Join(MakeLines()));
  Diagnostics of_folder;
  EXPECT_EQ(LoadValidationRows(folder, of_folder).size(), 2u);
  EXPECT_NE(of_folder.Format().find("b.yaml: error: the claim \"a trial, processor time\" stands "
                                    "in a.yaml already"),
            std::string::npos)
      << of_folder.Format();
  std::filesystem::remove_all(folder);
}

TEST(ValidationRows, BenchmarksReplaceTheirOwnRows) {
  const std::filesystem::path path =
      std::filesystem::path(testing::TempDir()) / "validation_rows_update.yaml";
  WriteFile(path, Join(MakeLines()) + "    row: 6\n");
  ValidationRow again = MakeValidationRow("another topic", true);
  again.claim = "a trial, processor time";
  again.figure = "29 ms";
  again.bar = "30 ms";
  again.met = "yes";
  again.command = "sim_bench: x | y #z";
  ValidationRow other = again;
  other.claim = "a step";
  UpdateValidationFile(path, {again, other});
  Diagnostics problems;
  const std::vector<ValidationRow> rows =
      ParseValidationRows(ReadFile(path), path.string(), problems);
  ASSERT_EQ(problems.Format(), "");
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0].figure, "29 ms");
  EXPECT_EQ(rows[0].met, "yes");
  EXPECT_EQ(rows[0].command, "sim_bench: x | y #z");
  EXPECT_EQ(rows[0].row, 6);
  EXPECT_EQ(rows[0].physics_version, std::to_string(kPhysicsVersion));
  EXPECT_EQ(rows[1].claim, "a step");
  EXPECT_EQ(rows[1].topic, "Speed");

  // A row that could not be read again leaves the file as it was.
  const std::string before = ReadFile(path);
  again.met = "none";
  EXPECT_THROW(UpdateValidationFile(path, {again}), Error);
  EXPECT_EQ(ReadFile(path), before);
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace graspbench
