#pragma once
/** @file
The report of a human study: one self-contained HTML file, like that of session_report.h. */

#include <filesystem>
#include <string>

#include "datasets/session/session_store.h"
#include "human_study/study/run/run_study.h"

namespace graspbench {

/** A robot session to compare with the study. */
struct RobotSession {
  std::string name;  ///< as the user named it
  Session session;
};

/** Writes report/index.html below the folder and returns its path. Equal results give equal bytes.
@param robot  null: none. @throws Error(kIo) when the file cannot be written. */
std::filesystem::path WriteStudyReport(const std::filesystem::path& folder,
                                       const StudyResult& result, const RobotSession* robot);

std::string MakeStudyReport(const StudyResult& result, const RobotSession* robot);

}  // namespace graspbench
