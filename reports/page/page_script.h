#pragma once
/** @file
A page that runs a script of its own beside what every page has. */

#include <string>

namespace graspbench {

/** A script as a page's content security policy names it: 'sha256-...'. */
std::string FormatScriptSource(const std::string& script);

/** The page of MakePage or MakePlainPage with a style sheet of its own. */
std::string AddStyle(std::string page, const std::string& style);

/** Both are ours, never from a file. */
struct PageScript {
  std::string style;   ///< sheet
  std::string script;  ///< neither "</script" nor "]]>" is in it
};

/** The page of MakePage with style and script: the content security policy lets this script run, by
its hash, and nothing else of what it forbade. Without a script the page as it is. */
std::string AddScript(std::string page, const PageScript& added);

}  // namespace graspbench
