#pragma once
/** @file
What `graspbench help WORD` explains: an entry of the manual's glossary (measure, term, outcome,
mechanism), a table column, a file key, a preset, or a code for a warning or a removal in a
study. */

#include <string>
#include <string_view>
#include <vector>

#include "workbench/text/file_formats.h"

namespace graspbench {

namespace assets {
extern const std::string_view kGlossaryMd;  ///< workbench/manual/pages/glossary.md
}

struct GlossaryEntry {
  std::string term;                  ///< "GFT, grasp forming time"
  std::vector<std::string> columns;  ///< table columns that hold it
  std::string meaning;
};
const std::vector<GlossaryEntry>& ListGlossary();
/** Finds an entry by its whole term; null: none. */
const GlossaryEntry* FindGlossaryEntry(const std::string& term);

/** Returns a paragraph for each meaning of the word: as a glossary entry, a column, a preset, a
warning or removal of a study, or a key (with unit, range, default and files). A glossary entry is
found, in either case, by its term, by one of the alternatives between commas, or by a column.
Empty: the word is unknown. */
std::string ExplainWord(const std::string& word);

/** Only the paragraphs about keys: what a key such as "model.friction_scale" means. */
std::string ExplainFileKey(const std::string& key);

/** Applies SuggestNames to `names`, the glossary's terms, all columns and all keys. A key is also
found by its last part: "model.friction_scale" by "friction_scale". */
std::string SuggestWords(const std::string& misspelt, std::vector<std::string> names);

/** Text for the user: a line per column with type and unit, and its meaning below. */
std::string FormatTableColumns(const TableFormat& table);

/** The same formats as JSON. */
///@{
Json MakeFormatJson(const FileFormat& format);
Json MakeTableJson(const TableFormat& table);
///@}

}  // namespace graspbench
