#pragma once
/** @file
When each link of the hand touched the object in one trial, as a strip chart. */

#include <string>

#include "datasets/session/trial_record.h"
#include "reports/html.h"
#include "reports/models.h"

namespace graspbench {

/** Empty when nothing touched. @param name  of what is grasped, for the title. */
Html DrawContactStrip(const TrialRecord& record, const std::string& name,
                      const SessionModels& models);

}  // namespace graspbench
