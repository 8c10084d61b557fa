#pragma once
/** @file
What `graspbench help WORD` explains: an entry of the manual's glossary (measure, term, outcome,
mechanism), a column of a table, a key of a file, a preset, or a warning or removal of a study. */

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
  std::vector<std::string> columns;  ///< of tables that hold it
  std::string meaning;
};
const std::vector<GlossaryEntry>& ListGlossary();
/** By its whole term; null: none. */
const GlossaryEntry* FindGlossaryEntry(const std::string& term);

/** A paragraph for each meaning of the word: as a glossary entry, by its term, one of the
alternatives between commas or a column, in letters of either case; as a column; as a preset; as a
warning or removal of a study; as a key, with unit, range, default and the files that have it.
Empty: it is none of these. */
std::string ExplainWord(const std::string& word);

/** The last paragraphs of these: what a key such as "model.friction_scale" means. */
std::string ExplainFileKey(const std::string& key);

/** SuggestNames of `names`, the glossary's terms, the columns and the keys of all files. A key is
found by its last part, too: "model.friction_scale" by "friction_scale". */
std::string SuggestWords(const std::string& misspelt, std::vector<std::string> names);

/** For people: a column to a line, its type and unit, and below it what it is. */
std::string FormatTableColumns(const TableFormat& table);

/** For programs. */
///@{
Json MakeFormatJson(const FileFormat& format);
Json MakeTableJson(const TableFormat& table);
///@}

}  // namespace graspbench
