/** @file
STO (OpenSim's storage) of marker positions: a header up to the line "endheader", a row of names
time, A_x, A_y, A_z, .., and one row a frame. */

#include "human_study/recording/importers/importer_list.h"
#include "human_study/recording/importers/text_rows.h"

namespace graspbench {
namespace {

Recording ImportSto(const ImportSource& source, const ImportOptions& options) {
  Recording recording;
  LineReader reader(source.stream, source.name);
  while (LowerCase(reader.Require("endheader")) != "endheader") {
  }
  Cells cells;
  const std::string names(reader.Require("the row of names"));
  SplitCells(names, '\t', cells);
  DropEmptyEnd(cells);
  const size_t num_points = cells.size() / 3;
  recording.points.resize(num_points);
  for (size_t i = 0; i < num_points; ++i) {
    const std::string_view name = cells[std::min(1 + 3 * i, cells.size() - 1)];
    recording.points[i].label = std::string(name.substr(0, name.rfind('_')));
  }
  SetLengthUnit(recording, options.unit, "--unit");
  MakeLabelsUnique(recording, "the row of names");
  std::string_view line;
  std::vector<double> times;
  size_t num_zeros = 0;
  int first_line = 0;
  while (reader.Next(line)) {
    SplitCells(line, '\t', cells);
    if (IsBlank(cells)) continue;
    if (!HasAllColumns(cells, 1 + 3 * num_points, reader, options, recording)) break;
    if (recording.num_frames == 0) first_line = reader.line();
    times.push_back(ParseNumber(cells, 0, reader));
    for (size_t i = 0; i < num_points; ++i) {
      AppendTriple(cells, 1 + 3 * i, reader, recording.points[i], num_zeros);
    }
    ++recording.num_frames;
  }
  NoteZeros(num_zeros, recording);
  SettleTimes(std::move(times), first_line, source.name, recording);
  return recording;
}

}  // namespace

Importer MakeStoImporter() {
  return {"sto",
          "STO",
          {".sto"},
          [](std::string_view head) { return head.find("endheader") != std::string_view::npos; },
          ImportSto,
          nullptr};
}

}  // namespace graspbench
