#pragma once
/** @file
What all text formats share: rows of numbers under named columns. */

#include <array>
#include <string>
#include <vector>

#include "core/base/text/delimited_text.h"
#include "human_study/recording/importers/importer.h"

namespace graspbench {

/** True when the row has all columns. A short row fails with its line, or, when truncated files are
accepted, is noted and false is returned: stop reading there. This check is also what keeps memory
bounded: every stored value has paid for itself with a cell of the file. */
bool HasAllColumns(const Cells& cells, size_t num_columns, const LineReader& reader,
                   const ImportOptions& options, Recording& recording);

/** Samples that are no places. */
struct OddSamples {
  size_t num_zeros = 0;  ///< at exactly (0, 0, 0)
  size_t num_huge = 0;   ///< with a number that a coordinate cannot hold, above 3.4e38
};

/** Appends the triple in those columns to the point; one that is no place is invalid and counted. */
void AppendTriple(const Cells& cells, const std::array<size_t, 3>& columns,
                  const LineReader& reader, RecordedPoint& point, OddSamples& odd);
/** The same of three columns from `column` on. */
void AppendTriple(const Cells& cells, size_t column, const LineReader& reader, RecordedPoint& point,
                  OddSamples& odd);
void NoteOdd(const OddSamples& odd, Recording& recording);

/** Notes a count of the header that the rows do not keep. */
void NoteFrameCount(double declared, const std::string& where, Recording& recording);

/** Decides between an even clock and the file's own time stamps [s], one per frame: stamps that
stay within 5 % of a frame of an even clock at `recording.rate` only set the start, others are kept
("irregular_times"). Without a rate the intervals give it: their mean when they are even, else their
median ("rate_from_times"). No stamps at all: the first frame's number sets the start.
@throws Error(kFormat) with the line where time does not increase. */
void SettleTimes(std::vector<double> times, int first_line, const std::string& file,
                 Recording& recording);

/** Frames behind the headings of a file, before their clock is settled. */
struct FrameRows {
  std::vector<double> times;  ///< [s]
  int first_line = 0;
};

/** As a delimiter: runs of blanks. */
inline constexpr char kBlanks = ' ';
/** Of a row: a tab, a semicolon or a comma that it has, else kBlanks. */
char FindDelimiter(std::string_view row);
/** A row's cells. A run of kBlanks is one delimiter; where single blanks alone give `num_columns`
cells, every blank is one, so that cells may be empty (tabs that a program replaced by blanks). */
void SplitRow(std::string_view line, char delimiter, size_t num_columns, Cells& cells);

/** Appends the rows of a table with the frame's number, the time and, from each of `columns` on, a
point of the recording. Notes what is odd about them. */
FrameRows ReadFrameRows(LineReader& reader, char delimiter, const std::vector<size_t>& columns,
                        const ImportOptions& options, Recording& recording);

/** Replaces line `line` (one-based) of a text; keeps its line ending. */
void ReplaceLine(std::string& bytes, int line, const std::string& text);
/** Line `line` (one-based) without its ending; empty when there is none. */
std::string FindLine(const std::string& bytes, int line);

}  // namespace graspbench
