#pragma once
/** @file
The report of a human study: one self-contained HTML file in the manner of session_report.h. */

#include <filesystem>
#include <string>

#include "datasets/session/session_store.h"
#include "human_study/study/run/run_study.h"

namespace graspbench {

/** A robot's session to stand beside the study. */
struct RobotSession {
  std::string name;  ///< as a person gave it
  Session session;
};

/** Writes report/index.html below the folder and returns its path. Same result, same bytes.
@param robot  null: none. @throws Error(kIo) when the file cannot be written. */
std::filesystem::path WriteStudyReport(const std::filesystem::path& folder,
                                       const StudyResult& result, const RobotSession* robot);

std::string MakeStudyReport(const StudyResult& result, const RobotSession* robot);

}  // namespace graspbench
