#pragma once
/** @file
The program's file formats: the keys of files that users write, as their readers check them, and the
columns of tables that the program writes, as their writers list them. Help, schemas and the
manual's pages of keys and columns are generated from these lists. */

#include <string>
#include <vector>

#include "core/base/file_keys.h"
#include "core/base/text/json.h"

namespace graspbench {

struct FileFormat {
  std::string name;  ///< "object.yaml"
  std::string about;
  FileKeys keys;
  bool is_frozen = false;  ///< written by a store from the options of its command
};
/** Formats that users write, then those that a store freezes. */
const std::vector<FileFormat>& ListFileFormats();

/** Returns a format as a JSON Schema (draft 2020-12), for YAML editors and validators: keys,
required keys and ranges. The readers also check ids, files and sums. */
Json MakeFileSchema(const FileFormat& format);

struct TableColumn {
  std::string
      name;  ///< "gct_s"; words in capitals stand for names from the data: "open_without_DIGIT"
  std::string type;  ///< "string", "integer", "number" or "boolean"
  std::string unit;  ///< empty: none
  std::string meaning;
};
struct TableFormat {
  std::string name;  ///< file name: "trials.csv"; some names are shared by sessions and studies
  std::string about;
  std::vector<TableColumn> columns;
};
const std::vector<TableFormat>& ListTableFormats();

/** Whether `name` is the column's name, or matches it with another word in place of the
capitals. */
bool IsNameOf(const TableColumn& column, const std::string& name);

}  // namespace graspbench
