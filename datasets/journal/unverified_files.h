#pragma once
/** @file
Files that a store has made and of which no hash is kept, so that nobody can tell whether they have
changed: what a program that was killed had just written, and tables and pages whose manifest is
gone. */

#include <filesystem>
#include <string>
#include <vector>

namespace graspbench {

/** From the folder, those of stores inside it too; none in what is no store. @throws Error(kIo). */
std::vector<std::string> FindUnverified(const std::filesystem::path& folder);

/** As a line for a person. */
std::string DescribeUnverified(const std::string& file);

}  // namespace graspbench
