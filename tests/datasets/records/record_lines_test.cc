#include "datasets/records/record_lines.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "tests/datasets/session/fake_session.h"

namespace graspbench {
namespace {

TEST(RecordLines, GiveTheLineAtItsPlaceAndNameIt) {
  const TemporaryFolder folder;
  WriteFile(folder.path() / "a.jsonl", "one\n\nthree\n");
  WriteFile(folder.path() / "b.jsonl", "uno\n");
  const RecordLines lines = {folder.path(), {"a.jsonl", "b.jsonl"}, {}, {}};
  EXPECT_EQ(ReadLine(lines, {0, 3, 5, 5}), "three");
  EXPECT_EQ(ReadLine(lines, {1, 1, 0, 3}), "uno");
  EXPECT_EQ(NameOfLine(lines, {0, 3, 5, 5}), "a.jsonl:3");
}

TEST(RecordLines, AShorterOrMissingFileIsAnError) {
  const TemporaryFolder folder;
  WriteFile(folder.path() / "a.jsonl", "one\n");
  const RecordLines lines = {folder.path(), {"a.jsonl", "none.jsonl"}, {}, {}};
  for (const LinePlace& place : {LinePlace{0, 2, 2, 9}, LinePlace{1, 1, 0, 3}}) {
    try {
      ReadLine(lines, place);
      FAIL() << NameOfLine(lines, place);
    } catch (const Error& e) {
      EXPECT_EQ(e.kind(), ErrorKind::kIo);
      EXPECT_NE(std::string(e.what()).find(" again: "), std::string::npos) << e.what();
    }
  }
}

}  // namespace
}  // namespace graspbench
