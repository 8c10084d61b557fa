#pragma once
/** @file
The manual's glossary (workbench/manual/pages/glossary.md), compiled in, for
`graspbench help WORD`. */

#include <string>
#include <string_view>
#include <vector>

namespace graspbench {

namespace assets {
extern const std::string_view kGlossaryMd;
}

struct GlossaryEntry {
  std::string term;     ///< "GFT, grasp forming time"
  std::string columns;  ///< of tables: "gft_s, grasp_forming_time_s"; empty: none
  std::string meaning;
};

/** The entries with this term, one of its alternatives between commas, or with this column; letters
of either case. Empty: none. */
std::vector<GlossaryEntry> FindInGlossary(std::string_view word);
/** Every term and every column. */
std::vector<std::string> ListGlossaryWords();

std::string FormatGlossary(const std::vector<GlossaryEntry>& entries);

}  // namespace graspbench
