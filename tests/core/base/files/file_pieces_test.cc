#include "core/base/files/file_pieces.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/files/files.h"

namespace graspbench {
namespace {

TEST(FilePieces, AreTheFileAndStopWhenNoMoreIsWanted) {
  const std::filesystem::path path = std::filesystem::path(testing::TempDir()) / "pieces";
  std::string content;
  for (int i = 0; i < 200000; ++i) content += std::to_string(i);
  WriteFile(path, content);
  std::string read;
  int num_pieces = 0;
  ReadPieces(path, [&](std::string_view piece) {
    ++num_pieces;
    read += piece;
    return true;
  });
  EXPECT_TRUE(read == content);
  EXPECT_GT(num_pieces, 2);
  ReadPieces(path, [&](std::string_view) {
    --num_pieces;
    return num_pieces > 2;
  });
  EXPECT_EQ(num_pieces, 2);
}

TEST(FilePieces, RefusesWhatIsNoFile) {
  const auto ignore = [](std::string_view) { return true; };
  EXPECT_THROW(ReadPieces("/dev/zero", ignore), Error);
  EXPECT_THROW(ReadPieces(testing::TempDir(), ignore), Error);
  EXPECT_THROW(ReadPieces("no/such/file", ignore), Error);
}

}  // namespace
}  // namespace graspbench
