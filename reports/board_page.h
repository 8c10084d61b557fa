#pragma once
/** @file
The page of a benchmark's entries (datasets/benchmark/board.h): ranks, success by object, who is
best where, failures, entries in their authors' words, entries without a rank, and the rules. Beside
it, where somebody asks for them, a page for each line with a trial of every object as a scene
(scenes/scene_3d.h): 21 objects take some 5 MB. */

#include <string>

#include "datasets/benchmark/board.h"
#include "reports/session_views.h"

namespace graspbench {

/** The same board, the same bytes.
@param has_trials  cells lead to the pages of MakeTrialsPage; else to the commands that make one. */
std::string MakeBoardPage(const Board& board, bool has_trials = false);

inline constexpr char kTrialPages[] = "trials";  ///< folder beside the board's page
/** "trials/0.html". @pre a line of the board. */
std::string NameTrialsPage(const Board& board, const BoardLine& line);
std::string MakeTrialsPage(const Board& board, const BoardLine& line, const TrialTracer& trace);

}  // namespace graspbench
