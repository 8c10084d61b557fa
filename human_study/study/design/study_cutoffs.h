#pragma once
/** @file
Cut-offs of a study against the rates of its recordings. A filter needs its cut-off below 0.4 of the
rate (butterworth.h). A cut-off that nobody stated is lowered for a slow recording, to
kMaxCutoffShare of its rate: from 58.9 samples a second on all stay at their defaults. One that
study.yaml or --set states is used as it is, or the recording is refused. */

#include <set>
#include <string>
#include <vector>

#include "core/base/text/yaml.h"
#include "human_study/study/design/study_config.h"

namespace graspbench {

inline constexpr const char* kMultiverseCutoff = "multiverse.cutoff_hz";

/** Keys of the cut-offs that the document or a setting ("contact.cutoff_hz=12") gives. */
std::set<std::string> FindStatedCutoffs(const YAML::Node& root,
                                        const std::vector<std::string>& settings);

/** The settings for recordings of `rate` [Hz]; NaN: as they are. */
StudyConfig FitCutoffs(StudyConfig config, double rate);

/** What is wrong with the stated cut-offs for a recording of `rate` [Hz], with every key; empty: all
fit. */
std::string FindCutoffFault(const StudyConfig& config, double rate);

/** The stated cut-offs that do not fit that rate, lowered: "contact.cutoff_hz=10.2", as --set takes
them. */
std::vector<std::string> LowerStatedCutoffs(const StudyConfig& config, double rate);

}  // namespace graspbench
