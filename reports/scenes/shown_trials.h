#pragma once
/** @file
What a page shows one by one of a session that is too large for it: of 100,000 trials a table alone
would be 90 MB. Rates, medians and ranges are always of all trials. */

#include <string>
#include <vector>

#include "datasets/analysis/session_summary.h"

namespace graspbench {

/** True for all cells of most sessions, and for the first 250 of a larger one: the others have no
pictures, strips and tables of trials. */
bool IsDrawnInFull(const CellSummary& cell, const SessionSummary& summary);

/** Of a session of up to 3,000 finished trials all of the cell's; of a larger one evenly spaced
ones, as many for every cell, at least 10 and 3,000 in all. */
std::vector<const TrialRecord*> ChooseShownTrials(const CellSummary& cell,
                                                  const SessionSummary& summary);

/** Of a shown trial's row, for links: "trial-3f2a...". */
std::string MakeTrialAnchor(const PlannedTrial& planned);

/** Of its scene in 3-D, where the page has one: "view-3f2a...". */
std::string MakeViewAnchor(const PlannedTrial& planned);

/** "71 of 2381 trials, evenly spaced; export/trials.csv has all of them." Empty when all are shown.
*/
std::string DescribeShownTrials(size_t num_shown, const CellSummary& cell);

}  // namespace graspbench
