#pragma once
/** @file
A study analysed into a folder of tables. */

#include <filesystem>
#include <functional>

#include "human_study/study/run/run_study.h"

namespace graspbench {

/** Runs the study and writes its tables, the tidy data with their R script (tidy/) and the BIDS
derivative (bids/). @param on_row  as StudyWatch::on_row.
@throws as RunStudy; Error(kIo). */
StudyResult AnalyseStudy(const Study& study, const std::filesystem::path& folder,
                         const std::function<void(size_t, size_t)>& on_row);

}  // namespace graspbench
