#pragma once
/** @file
The manual as pages for a browser: read by double click, without a network. */

#include <filesystem>
#include <string>
#include <vector>

namespace graspbench {

class Command;

struct ManualPage {
  std::string room;  ///< "tutorials"
  std::string id;    ///< "failed-trial"
};

/** In the order of the contents (workbench/manual/contents.inc). */
const std::vector<ManualPage>& ListManualPages();

/** A page of the room reference as Markdown, made of what the program itself goes by, so that it
cannot fall behind: "options" (the parser's commands), "keys" (of the files that people write),
"columns" (of the tables that the program writes), "outcomes" (of trials, exit codes, presets). */
std::string MakeReference(const std::string& page, const Command& program);

/** Writes index.html, with contents and search (of headings, options, keys and columns), and
`<id>.html` for every page. The same sources, the same bytes.
@param source  workbench/manual
@param folder  is made; other files in it stay
@throws Error(kFormat) naming page and line of what is wrong, also for links that lead nowhere. */
void WriteManual(const Command& program, const std::filesystem::path& source,
                 const std::filesystem::path& folder);

}  // namespace graspbench
