#pragma once
/** @file
The pictures of one trial side by side, with their moments and times. */

#include <string>
#include <vector>

#include "core/trial/trial_result.h"
#include "reports/page/html.h"
#include "reports/scenes/cell_pictures.h"

namespace graspbench {

/** @param of  what is grasped by what, for people who cannot see it. */
Html DrawFilmstrip(const std::vector<Picture>& pictures, const TrialResult& result,
                   const std::string& of);

/** The hand when it was closed, else the trial's last picture, small and without words of its own;
nothing without pictures. */
Html DrawThumbnail(const std::vector<Picture>& pictures);

/** That of the first or the last of a cell's strips: its success, and a failure. */
///@{
Html DrawFirstThumbnail(const CellPictures& pictures, const std::string& cell);
Html DrawLastThumbnail(const CellPictures& pictures, const std::string& cell);
///@}

}  // namespace graspbench
