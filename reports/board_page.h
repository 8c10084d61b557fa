#pragma once
/** @file
The page of a benchmark's entries (datasets/benchmark/board.h): ranks, success by object, the best
entry by object, failures, entries in their authors' words, entries without a rank, and the rules.
On request, a page per entry shows one trial on every object as a 3-D scene (scenes/scene_3d.h); 21
objects take some 5 MB. */

#include <string>

#include "datasets/benchmark/board.h"
#include "reports/session_views.h"

namespace graspbench {

/** Makes the page; equal boards give equal bytes.
@param has_trials  cells link to the pages of MakeTrialsPage; else to the commands that make one. */
std::string MakeBoardPage(const Board& board, bool has_trials = false);

inline constexpr char kTrialPages[] = "trials";  ///< folder beside the board's page
/** Returns "trials/0.html" for the first line. @pre `line` belongs to the board. */
std::string NameTrialsPage(const Board& board, const BoardLine& line);
std::string MakeTrialsPage(const Board& board, const BoardLine& line, const TrialTracer& trace);

}  // namespace graspbench
