// Descriptions of hands written from the formats alone, by somebody who had not read the reader:
// every wrong one is refused or reported by its subject, no right one is refused. cases.tsv beside
// the files says what is wrong with each and which words the message must have.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "tests/core/hand/import/doubts.h"
#include "tests/core/hand/import/import_file.h"

namespace graspbench {
namespace {
namespace fs = std::filesystem;

std::vector<std::string> SplitAt(const std::string& text, const std::string& separator) {
  std::vector<std::string> parts;
  size_t begin = 0;
  for (size_t end; (end = text.find(separator, begin)) != std::string::npos;) {
    parts.push_back(text.substr(begin, end - begin));
    begin = end + separator.size();
  }
  parts.push_back(text.substr(begin));
  return parts;
}

std::vector<std::vector<std::string>> ReadCases(const std::string& folder) {
  std::ifstream file(fs::path(IMPORT_TEST_DATA_DIR) / folder / "cases.tsv");
  std::vector<std::vector<std::string>> rows;
  for (std::string line; std::getline(file, line);) {
    if (!line.empty() && line[0] != '#') rows.push_back(SplitAt(line, "\t"));
  }
  return rows;
}

/** @param option  "palm=LINK", "normal=X,Y,Z" or nothing. What is wrong is found before links are
covered. */
ImportedFiles ImportDescription(const fs::path& file, const std::string& option,
                                Diagnostics& problems, int num_cover_points = 0) {
  const std::vector<std::string> parts = SplitAt(option, "=");
  const std::string palm = parts[0] == "palm" ? parts[1] : "";
  HandSource source = MakeFileSource(file);
  source.num_cover_points = num_cover_points;
  if (parts[0] == "normal") {
    const std::vector<std::string> numbers = SplitAt(parts[1], ",");
    source.palm_normal =
        Eigen::Vector3d(std::stod(numbers[0]), std::stod(numbers[1]), std::stod(numbers[2]));
  }
  return ImportHand(ReadFile(file), source, palm, problems);
}

std::string NameOfFile(const testing::TestParamInfo<std::vector<std::string>>& info) {
  std::string name = info.param[0];
  for (char& c : name) c = std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
  return name;
}

class WrongDescriptionTest : public testing::TestWithParam<std::vector<std::string>> {};

TEST_P(WrongDescriptionTest, IsRefusedOrReported) {
  const std::vector<std::string>& row = GetParam();
  ASSERT_GE(row.size(), 4u);
  Diagnostics problems;
  ImportDescription(fs::path(IMPORT_TEST_DATA_DIR) / "wrong" / row[0], row.size() > 4 ? row[4] : "",
                    problems);
  if (row[1] == "refused") {
    EXPECT_GT(problems.num_errors(), 0) << row[3];
  }
  bool is_told = false;
  for (const Diagnostic& problem : problems.entries()) {
    bool has_all = row[1] == "reported" || problem.severity == Severity::kError;
    for (const std::string& word : SplitAt(row[2], " & ")) {
      has_all = has_all && problem.text.find(word) != std::string::npos;
    }
    is_told = is_told || has_all;
  }
  EXPECT_TRUE(is_told) << row[3] << "; expected \"" << row[2] << "\" in\n" << problems.Format();
}
INSTANTIATE_TEST_SUITE_P(All, WrongDescriptionTest, testing::ValuesIn(ReadCases("wrong")),
                         NameOfFile);

class RightDescriptionTest : public testing::TestWithParam<std::vector<std::string>> {};

TEST_P(RightDescriptionTest, IsImportedWithoutDoubtAndLoads) {
  const std::vector<std::string>& row = GetParam();
  ASSERT_EQ(row.size(), 3u);
  Diagnostics problems;
  const ImportedFiles imported =
      ImportDescription(fs::path(IMPORT_TEST_DATA_DIR) / "right" / row[0],
                        row[1] == "-" ? "" : row[1], problems, 1500);
  ASSERT_EQ(problems.num_errors(), 0) << row[2] << "\n" << problems.Format();
  WriteAndLoad(imported);
  // What is right must not be drowned in doubts of unit, scale, axis or mass either.
  EXPECT_EQ(FindDoubts(problems), "");
  EXPECT_EQ(problems.Format().find("of a finger's drive"), std::string::npos) << problems.Format();
}
INSTANTIATE_TEST_SUITE_P(All, RightDescriptionTest, testing::ValuesIn(ReadCases("right")),
                         NameOfFile);

/** What stands behind "normal:" in hand.yaml. */
std::string ReadNormal(const char* file) {
  Diagnostics problems;
  const ImportedFiles imported =
      ImportDescription(fs::path(IMPORT_TEST_DATA_DIR) / "right" / file, "", problems);
  const std::string& yaml = imported.files.at("hand.yaml");
  const size_t begin = yaml.find("normal: ") + 8;
  return yaml.substr(begin, yaml.find(']', begin) + 1 - begin);
}

// Thumb and fingers are as far apart in both: around a flat palm that faces along x the thumb stands
// out of it, on a hub that faces along z all three spread outwards.
TEST(DescriptionsTest, AThumbThatPointsAwayDoesNotMakeAHandAClaw) {
  EXPECT_EQ(ReadNormal("joint_beside_body.xml"), "[1, 0, 0]");
  EXPECT_EQ(ReadNormal("spread_open_outwards.urdf"), "[0, 0, 1]");
  EXPECT_EQ(ReadNormal("spread_by_two_drives.urdf"), "[0, 0, 1]");
}

TEST(DescriptionsTest, AFixedJawDoesNotTurnThePalm) {
  EXPECT_EQ(ReadNormal("vise.urdf"), "[0, 0, 1]");
}

TEST(DescriptionsTest, ThereAreAsManyAsClaimed) {
  EXPECT_GE(ReadCases("wrong").size(), 60u);
  EXPECT_GE(ReadCases("right").size(), 25u);
}

}  // namespace
}  // namespace graspbench
