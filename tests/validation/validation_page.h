#pragma once
/** @file
The rows of workbench/manual/validation as the page workbench/manual/validation.md: bars that are
not met first, then by topic; what was measured with other physics is marked. */

#include <string>
#include <vector>

#include "tests/validation/validation_rows.h"

namespace graspbench {

/** Markdown. Topics in alphabetical order, rows as given.
@param physics_version  of this program: rows of another one are stale. */
std::string FormatValidationPage(const std::vector<ValidationRow>& rows, int physics_version);

}  // namespace graspbench
