#pragma once
/** @file
Tables whose columns need no mapping one by one, because a tool always writes them alike (`layout` of
table_mapping.h). Every point becomes three columns `<point>_x`, _y, _z.

  deeplabcut: three heading rows (scorer, bodyparts, coords), four with several individuals
    (scorer, individuals, bodyparts, coords: points are individual:bodypart); a column with the
    frame's number, then x, y, z of each body part. Lengths are counted in squares of the
    checkerboard that the cameras were calibrated with, so the mapping must say `scale`.
  freemocap: one heading row right_hand_wrist_x, right_hand_wrist_y, right_hand_wrist_z, ..; without
    times. Millimetres when the board's size was given in them.

Sources: DeepLabCut, docs/Overviewof3D.md and pose_estimation_3d; FreeMoCap's output_data folder. */

#include <string>
#include <vector>

#include "core/base/text/delimited_text.h"

namespace graspbench {

struct TableLayout {
  const char* id;
  const char* text;  ///< for messages
  bool needs_scale;  ///< its lengths are counted in something that only the person knows
  /** Reads the heading rows and names every column; "" for those that are no coordinate.
  @throws Error(kFormat) at the line of what is not of this layout. */
  std::vector<std::string> (*read_names)(LineReader& reader, char delimiter);
};

const std::vector<TableLayout>& TableLayoutList();
/** Null for a name that is none. */
const TableLayout* FindTableLayout(const std::string& id);

/** The points whose three columns are all there, in their order. @throws Error(kFormat) at the
reader's line when there are none, or when one has x and y alone. */
std::vector<std::string> FindLayoutPoints(const std::vector<std::string>& names,
                                          const LineReader& reader);

}  // namespace graspbench
