#pragma once
/** @file
When each link of the hand touched the object in one trial, as a strip chart. */

#include <string>

#include "datasets/records/trial_record.h"
#include "reports/page/html.h"
#include "reports/page/models.h"

namespace graspbench {

/** Empty when nothing touched. @param name  of what is grasped, for the title. */
Html DrawContactStrip(const TrialRecord& record, const std::string& name,
                      const SessionModels& models);

}  // namespace graspbench
