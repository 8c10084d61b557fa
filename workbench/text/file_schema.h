#pragma once
/** @file
A file format as a JSON Schema (draft 2020-12), for editors and validators of YAML: which keys there
are, which are needed, which numbers are in range. The readers check more: ids, files, sums. */

#include "core/base/text/json.h"
#include "workbench/text/file_formats.h"

namespace graspbench {

Json MakeFileSchema(const FileFormat& format);

}  // namespace graspbench
