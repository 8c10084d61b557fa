#include "workbench/terminal/status_region.h"

#include <gtest/gtest.h>
#include <pty.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>

namespace graspbench {
namespace {

/** A terminal of so many cells whose bytes are read back. */
class StatusRegionTest : public testing::Test {
 protected:
  StatusRegionTest() {
    ::setenv("TERM", "xterm", 1);
    winsize size = {6, 20, 0, 0};
    int terminal = -1;
    EXPECT_EQ(::openpty(&reader_, &terminal, nullptr, nullptr, &size), 0);
    stream_ = ::fdopen(terminal, "w");
  }
  ~StatusRegionTest() override {
    std::fclose(stream_);
    ::close(reader_);
  }
  void Resize(unsigned short columns) {
    winsize size = {6, columns, 0, 0};
    ::ioctl(reader_, TIOCSWINSZ, &size);
  }
  /** What was written since the last time; the terminal makes \n to \r\n. */
  std::string Read() {
    constexpr char kEnd = '~';  // a terminal hands over in pieces
    std::fputc(kEnd, stream_);
    std::fflush(stream_);
    std::string text;
    for (char c = 0; ::read(reader_, &c, 1) == 1 && c != kEnd;) {
      if (c == '\n' && !text.empty() && text.back() == '\r') text.pop_back();
      text += c;
    }
    return text;
  }

  int reader_ = -1;
  std::FILE* stream_ = nullptr;
};

TEST_F(StatusRegionTest, IsRedrawnInPlaceAndTakenAway) {
  StatusRegion region(stream_);
  EXPECT_TRUE(region.can_redraw());
  region.Show({"one", "two"});
  EXPECT_EQ(Read(), "\rone\x1b[K\n\rtwo\x1b[K\n\x1b[J");
  region.Show({"three"});
  EXPECT_EQ(Read(), "\x1b[2A\rthree\x1b[K\n\x1b[J");
  region.Clear();
  EXPECT_EQ(Read(), "\x1b[1A\r\x1b[J");
  region.Clear();  // writes nothing
  region.Show({"four"});
  region.Leave();
  region.Show({"five"});
  EXPECT_EQ(Read(), "\rfour\x1b[K\n\x1b[J\rfive\x1b[K\n\x1b[J");
}

TEST_F(StatusRegionTest, FitsTheTerminal) {
  StatusRegion region(stream_);
  region.Show(std::vector<std::string>(9, "a line that is longer than twenty"));
  const std::string shown = Read();
  EXPECT_EQ(std::count(shown.begin(), shown.end(), '\n'), 5);  // the sixth is the cursor's
  EXPECT_NE(shown.find("\ra line that is long\x1b[K"), std::string::npos) << shown;
  EXPECT_EQ(shown.find("longer"), std::string::npos);
}

TEST_F(StatusRegionTest, ANarrowerWindowHasBrokenTheLines) {
  StatusRegion region(stream_);
  region.Show({"nine cell", "\x1b[31mnine cell\x1b[0m", "x"});
  Read();
  Resize(5);  // two rows, two rows, one
  region.Clear();
  EXPECT_EQ(Read(), "\x1b[5A\r\x1b[J");
}

TEST_F(StatusRegionTest, ElsewhereNothingIsWritten) {
  ::setenv("TERM", "dumb", 1);
  StatusRegion dumb(stream_);
  EXPECT_FALSE(dumb.can_redraw());
  std::FILE* file = std::tmpfile();
  ::setenv("TERM", "xterm", 1);
  StatusRegion plain(file);
  for (StatusRegion* region : {&dumb, &plain}) {
    region->Show({"one"});
    region->Clear();
  }
  EXPECT_EQ(std::ftell(file), 0);
  std::fclose(file);
  EXPECT_EQ(Read(), "");
}

TEST(CutLine, NeverWithinALetter) {
  for (const auto& [width, expected] :
       {std::pair(5, "ab\xc3\xa4z"), std::pair(4, "ab\xc3\xa4"), std::pair(3, "ab")}) {
    std::string line = "ab\xc3\xa4z";
    CutLine(static_cast<size_t>(width), line);
    EXPECT_EQ(line, expected);
  }
}

}  // namespace
}  // namespace graspbench
