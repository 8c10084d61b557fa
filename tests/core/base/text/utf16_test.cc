#include "core/base/text/utf16.h"

#include <gtest/gtest.h>

#include <string>

namespace graspbench {
namespace {

using namespace std::string_literals;

TEST(IsUtf16, ByItsMarkOrByTheZerosBesideItsLetters) {
  EXPECT_TRUE(IsUtf16("\xff\xfep\0"s));
  EXPECT_TRUE(IsUtf16("\xfe\xff\0p"s));
  EXPECT_TRUE(IsUtf16("f\0i\0l\0e\0"s));
  EXPECT_TRUE(IsUtf16("\0f\0i\0l\0e"s));
  EXPECT_FALSE(IsUtf16("file"));
  EXPECT_FALSE(IsUtf16(""));
  EXPECT_FALSE(
      IsUtf16("\xef\xbb\xbf"
              "file,participant"));  // UTF-8 with its mark
  EXPECT_FALSE(IsUtf16("\0\0\0\0\0\0\0\0"s));
  EXPECT_FALSE(IsUtf16("\x02P\0\0\x01\0\x10\0"s));  // C3D
}

}  // namespace
}  // namespace graspbench
