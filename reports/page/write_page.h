#pragma once
/** @file
The one place where the page of a stored result is written. */

#include <filesystem>
#include <string_view>

namespace graspbench {

/** Writes report/index.html in the result's folder and seals it, so that `graspbench verify`
notices when it is not what was written. @returns its path. @throws Error(kIo). */
std::filesystem::path WriteReportPage(const std::filesystem::path& folder, std::string_view page);

}  // namespace graspbench
