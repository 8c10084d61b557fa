#pragma once
/** @file
Lines below all that was printed, redrawn in place on a terminal that can move its cursor; anywhere
else (pipe, file, TERM=dumb) nothing is shown and no escape byte is written. */

#include <cstdio>
#include <string>
#include <vector>

namespace graspbench {

/** Whether it is a terminal that can move its cursor. */
bool CanRedraw(std::FILE* stream);

struct TerminalSize {
  int columns = 80, rows = 24;
};
/** Those of the terminal; 80 x 24 where there is none. */
TerminalSize FindTerminalSize(std::FILE* stream);

/** To so many bytes at most, and never within a letter. */
void CutLine(size_t width, std::string& line);

class StatusRegion {
 public:
  explicit StatusRegion(std::FILE* stream) : stream_(stream), can_redraw_(CanRedraw(stream)) {}
  bool can_redraw() const { return can_redraw_; }

  /** In the place of what it showed; lines and columns beyond the terminal's size are cut. A line
  with colours must fit by itself. @pre foreign parts are escaped. */
  void Show(const std::vector<std::string>& lines);
  /** Takes the lines away; what is printed next stands in their place. */
  void Clear();
  /** Leaves them as they are, above what is printed next. */
  void Leave() { widths_.clear(); }

 private:
  std::string MakeWayUp() const;

  std::FILE* stream_;
  bool can_redraw_;
  std::vector<size_t> widths_;  // of the lines shown, in cells
};

}  // namespace graspbench
