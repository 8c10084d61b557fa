#pragma once
/** @file
The keys of study.yaml: what each is, and what its numbers may be. */

#include "core/base/file_keys.h"

namespace graspbench {

/** In the order of StudyConfig, with its defaults. */
const FileKeys& ListStudyKeys();

}  // namespace graspbench
