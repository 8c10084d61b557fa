#pragma once
/** @file
The manual as HTML pages that open by double click, without a network. */

#include <filesystem>
#include <string>
#include <vector>

namespace graspbench {

class Command;

struct ManualPage {
  std::string room;  ///< "tutorials"
  std::string id;    ///< "failed-trial"
};

/** All pages in the order of the contents (workbench/manual/contents.inc). */
const std::vector<ManualPage>& ListManualPages();

/** Makes a page of the reference as Markdown from the program's own tables, so that it is never out
of date: "options" (the parser's commands), "keys" (of the files that users write), "columns" (of
the tables that the program writes), "outcomes" (of trials, exit codes, presets). */
std::string MakeReference(const std::string& page, const Command& program);

/** Writes index.html, with contents and search (of headings, options, keys and columns), and
`<id>.html` for every page. Equal sources give equal bytes.
@param source  workbench/manual
@param folder  is created if missing; other files in it are kept
@throws Error(kFormat) naming page and line of the fault, dead links included. */
void WriteManual(const Command& program, const std::filesystem::path& source,
                 const std::filesystem::path& folder);

}  // namespace graspbench
