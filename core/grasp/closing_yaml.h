#pragma once
/** @file
The closing schedule of a grasp in YAML, by digit; what is left out is that of all:

    closing: {FF: {delay_s: 0.05, speed: 1.5}, TH: {speed: 0.8}} */

#include <string>

#include "core/base/text/yaml.h"
#include "core/grasp/standard_grasp.h"

namespace graspbench {

/** The key "closing" of a grasp whose digits are read. Digits that do not grasp, and values with
which one would stay open for good, go into `problems`.
@param keys  the format's rows   @param prefix  of the grasp's keys there. */
void ReadClosing(const std::string& file, const std::string& where, Diagnostics& problems,
                 const FileKeys& keys, const std::string& prefix, YamlMap& map, Grasp& grasp);

/** On one line, with six decimals. */
std::string FormatClosing(const Grasp& grasp);

}  // namespace graspbench
