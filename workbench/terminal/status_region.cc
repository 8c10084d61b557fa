#include "workbench/terminal/status_region.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>

#include "workbench/terminal/terminal.h"

namespace graspbench {
namespace {

constexpr char kEscape = '\x1b';

bool IsContinuation(char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; }

/** In cells; sequences of colours take none. */
size_t MeasureLine(const std::string& line) {
  size_t width = 0;
  for (size_t i = 0; i < line.size(); ++i) {
    if (line[i] == kEscape) {
      while (i < line.size() && line[i] != 'm') ++i;
    } else {
      width += !IsContinuation(line[i]);
    }
  }
  return width;
}

}  // namespace

bool CanRedraw(std::FILE* stream) {
  const char* term = std::getenv("TERM");
  return ::isatty(::fileno(stream)) && term && std::string(term) != "dumb";
}

TerminalSize FindTerminalSize(std::FILE* stream) {
  winsize size{};
  if (::ioctl(::fileno(stream), TIOCGWINSZ, &size) != 0 || size.ws_col == 0 || size.ws_row == 0) {
    return {};
  }
  return {size.ws_col, size.ws_row};
}

void CutLine(size_t width, std::string& line) {
  if (line.size() <= width) return;
  while (width > 0 && IsContinuation(line[width])) --width;
  line.resize(width);
}

/** To the first line, also when a narrower window has broken some since. */
std::string StatusRegion::MakeWayUp() const {
  const auto columns = static_cast<size_t>(FindTerminalSize(stream_).columns);
  size_t num_rows = 0;
  for (const size_t width : widths_)
    num_rows += std::max<size_t>(1, (width + columns - 1) / columns);
  return num_rows > 0 ? "\x1b[" + std::to_string(num_rows) + "A" : "";
}

void StatusRegion::Show(const std::vector<std::string>& lines) {
  if (!can_redraw_) return;
  const TerminalSize size = FindTerminalSize(stream_);
  std::string text = MakeWayUp();
  widths_.clear();
  for (std::string line : lines) {
    if (static_cast<int>(widths_.size()) >= std::max(size.rows - 1, 1)) break;
    // The last column stays free: some terminals break the line behind it.
    if (line.find(kEscape) == line.npos)
      CutLine(static_cast<size_t>(std::max(size.columns - 1, 1)), line);
    widths_.push_back(MeasureLine(line));
    text += "\r" + line + "\x1b[K\n";
  }
  text += "\x1b[J";  // what a key press or a longer region has left below
  PrintControlled(stream_, text);
}

void StatusRegion::Clear() {
  if (widths_.empty()) return;
  PrintControlled(stream_, MakeWayUp() + "\r\x1b[J");
  widths_.clear();
}

}  // namespace graspbench
