#pragma once
/** @file
The files of the program and what stands in them: the keys of those that people write, as their
readers check them, and the columns of the tables that the program writes, as their writers list
them. Help, schemas and the manual's pages of keys and columns are made from these lists. */

#include <string>
#include <vector>

#include "core/base/file_keys.h"
#include "core/base/text/json.h"

namespace graspbench {

struct FileFormat {
  std::string name;  ///< "object.yaml"
  std::string about;
  FileKeys keys;
  bool is_frozen = false;  ///< written by a store, from the options of its command
};
/** Those that people write first, then those that a store freezes. */
const std::vector<FileFormat>& ListFileFormats();

/** A format as a JSON Schema (draft 2020-12), for editors and validators of YAML: which keys there
are, which are needed, which numbers are in range. The readers check more: ids, files, sums. */
Json MakeFileSchema(const FileFormat& format);

struct TableColumn {
  std::string
      name;  ///< "gct_s"; words in capitals stand for names of the data: "open_without_DIGIT"
  std::string type;  ///< "string", "integer", "number" or "boolean"
  std::string unit;  ///< empty: none
  std::string meaning;
};
struct TableFormat {
  std::string name;  ///< of its file: "trials.csv"; tables of a session and of a study share some
  std::string about;
  std::vector<TableColumn> columns;
};
const std::vector<TableFormat>& ListTableFormats();

/** Whether `name` is that of the column, or fits the word in capitals behind its beginning. */
bool IsNameOf(const TableColumn& column, const std::string& name);

}  // namespace graspbench
