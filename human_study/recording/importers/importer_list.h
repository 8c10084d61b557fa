#pragma once
/** @file
Declares Make<Name>Importer() for every line of importer_list.inc. */

#include "human_study/recording/importers/importer.h"

namespace graspbench {

#define GRASPBENCH_IMPORTER(name) Importer Make##name##Importer();
#include "human_study/recording/importers/importer_list.inc"
#undef GRASPBENCH_IMPORTER

}  // namespace graspbench
