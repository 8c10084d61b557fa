#pragma once
/** @file
Declares Make<Name>Detector() for every line of detector_list.inc. */

#include "human_study/events/contact_detector.h"

namespace graspbench {

#define GRASPBENCH_DETECTOR(name) ContactDetector Make##name##Detector();
#include "human_study/events/detectors/detector_list.inc"
#undef GRASPBENCH_DETECTOR

}  // namespace graspbench
