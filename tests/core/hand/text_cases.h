#pragma once
/** @file
Wrong inputs as data: changes of a good text, each with what its reader reports. */

#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <string>
#include <vector>

#include "core/base/files/files.h"

namespace graspbench {

struct TextCase {
  std::string file;  ///< which of several texts; mostly empty
  std::string from, to;
  std::string expected;

  /** The text with the change; a failure where the good one does not have it. */
  std::string Change(std::string text) const {
    const size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << "not in the good text: " << from;
    return at == std::string::npos ? text : text.replace(at, from.size(), to);
  }
};

/** From a YAML list of maps with these keys. */
inline std::vector<TextCase> ReadTextCases(const std::string& path) {
  std::vector<TextCase> cases;
  for (const YAML::Node& node : YAML::Load(ReadFile(path))) {
    cases.push_back({node["file"].as<std::string>(""), node["from"].as<std::string>(),
                     node["to"].as<std::string>(), node["expected"].as<std::string>()});
  }
  return cases;
}

}  // namespace graspbench
