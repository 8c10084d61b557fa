#pragma once
/** @file
CMA-ES of a maintained library, pagmo 2 (F. Biscani and D. Izzo, J. Open Source Softw. 5 (2020)), on
the box, start and first step of a search of ours. */

#include "core/optimise/methods/search.h"

namespace graspbench {

/** As RunSearch; pagmo asks for one point at a time, in whole generations of 4 + floor(3 ln n), at
least 5, so that some evaluations less than a generation may be left over. */
SearchResult RunPagmoSearch(const SearchSpace& space, int num_evaluations, unsigned seed,
                            const EvaluateGeneration& evaluate);

}  // namespace graspbench
