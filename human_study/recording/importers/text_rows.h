#pragma once
/** @file
Common parts of all text formats: rows of numbers under named columns. */

#include <array>
#include <string>
#include <vector>

#include "core/base/text/delimited_text.h"
#include "human_study/recording/importers/importer.h"

namespace graspbench {

/** Returns true when the row has all columns. A short row fails with its line. When truncated files
are accepted, it is noted instead and false is returned; reading must stop there. This check also
bounds memory: every stored value corresponds to a cell of the file. */
bool HasAllColumns(const Cells& cells, size_t num_columns, const LineReader& reader,
                   const ImportOptions& options, Recording& recording);

/** Samples that are not positions. */
struct OddSamples {
  size_t num_zeros = 0;  ///< at exactly (0, 0, 0)
  size_t num_huge = 0;   ///< with a number above 3.4e38, which a coordinate cannot hold
};

/** Appends the triple in these columns to the point; one that is not a position is invalid and
counted. */
void AppendTriple(const Cells& cells, const std::array<size_t, 3>& columns,
                  const LineReader& reader, RecordedPoint& point, OddSamples& odd);
/** As above, for three columns starting at `column`. */
void AppendTriple(const Cells& cells, size_t column, const LineReader& reader, RecordedPoint& point,
                  OddSamples& odd);
void NoteOdd(const OddSamples& odd, Recording& recording);

/** Notes a header count that differs from the number of rows. */
void NoteFrameCount(double declared, const std::string& where, Recording& recording);

/** Decides between an even clock and the file's own time stamps [s], one per frame. Stamps within 5
% of a frame of an even clock at `recording.rate` only set the start; others are kept
("irregular_times"). Without a rate, it is computed from the intervals: their mean when they are
even, else their median ("rate_from_times"). Without stamps, the number of the first frame sets the
start. @throws Error(kFormat) with the line where time does not increase. */
void SettleTimes(std::vector<double> times, int first_line, const std::string& file,
                 Recording& recording);

/** Frames below the headings of a file, before their clock is determined. */
struct FrameRows {
  std::vector<double> times;  ///< [s]
  int first_line = 0;
};

/** Delimiter value for runs of blanks. */
inline constexpr char kBlanks = ' ';
/** Returns the row's delimiter: a tab, a semicolon or a comma if present, else kBlanks. */
char FindDelimiter(std::string_view row);
/** Splits a row into cells. A run of kBlanks is one delimiter. If splitting at every blank yields
`num_columns` cells, every blank is a delimiter, so that cells may be empty (as when a program has
replaced tabs by blanks). */
void SplitRow(std::string_view line, char delimiter, size_t num_columns, Cells& cells);

/** Appends the rows of a table with frame number and time, and with a point starting at each of
`columns`. Notes irregularities. */
FrameRows ReadFrameRows(LineReader& reader, char delimiter, const std::vector<size_t>& columns,
                        const ImportOptions& options, Recording& recording);

/** Replaces line `line` (one-based) of a text; keeps its line ending. */
void ReplaceLine(std::string& bytes, int line, const std::string& text);
/** Returns line `line` (one-based) without its ending; empty when there is none. */
std::string FindLine(const std::string& bytes, int line);

}  // namespace graspbench
