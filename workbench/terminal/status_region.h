#pragma once
/** @file
Status lines below the printed output, redrawn in place on a terminal that can move its cursor.
Anywhere else (pipe, file, TERM=dumb) nothing is shown and no escape byte is written. */

#include <cstdio>
#include <string>
#include <vector>

namespace graspbench {

/** Whether the stream is a terminal that can move its cursor. */
bool CanRedraw(std::FILE* stream);

struct TerminalSize {
  int columns = 80, rows = 24;
};
/** Size of the terminal; 80 x 24 where there is none. */
TerminalSize FindTerminalSize(std::FILE* stream);

/** Cuts the line to at most `width` bytes, never within a UTF-8 character. */
void CutLine(size_t width, std::string& line);

class StatusRegion {
 public:
  explicit StatusRegion(std::FILE* stream) : stream_(stream), can_redraw_(CanRedraw(stream)) {}
  bool can_redraw() const { return can_redraw_; }

  /** Replaces the lines shown; lines and columns beyond the terminal's size are cut. A line with
  colours is not cut and must fit. @pre text from files is escaped. */
  void Show(const std::vector<std::string>& lines);
  /** Erases the lines; the next output takes their place. */
  void Clear();
  /** Keeps the lines on the screen; the next output follows below. */
  void Leave() { widths_.clear(); }

 private:
  std::string MakeWayUp() const;

  std::FILE* stream_;
  bool can_redraw_;
  std::vector<size_t> widths_;  // of the lines shown, in cells
};

}  // namespace graspbench
