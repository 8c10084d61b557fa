#pragma once
/** @file
The page of a benchmark's entries (datasets/benchmark/board.h): ranks, success by object, who is
best where, failures, entries in their authors' words, entries without a rank, and the rules. */

#include <string>

#include "datasets/benchmark/board.h"

namespace graspbench {

/** The same board, the same bytes. */
std::string MakeBoardPage(const Board& board);

}  // namespace graspbench
