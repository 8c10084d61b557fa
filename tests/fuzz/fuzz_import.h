#pragma once
/** @file
One input for an importer, as a fuzzer or a replayed case gives it. */

#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "human_study/recording/importers/importer.h"
#include "human_study/recording/recording.h"

namespace graspbench {

/** Imports `bytes`; an Error is a fine answer, anything else (crash, other exception, endless loop,
unbounded memory) is a fault. A line "----" divides the file from what lies beside it: the channels,
the JSON and the events of Motion-BIDS. */
inline void FuzzImport(const std::string& id, const std::string& bytes) {
  std::vector<std::string> parts = {bytes};
  if (id == "motion_bids") {
    const std::string divider = "\n----\n";
    for (size_t at; (at = parts.back().find(divider)) != std::string::npos;) {
      std::string rest = parts.back().substr(at + divider.size());
      parts.back().resize(at);
      parts.push_back(std::move(rest));
    }
  }
  const auto sibling = [&](const std::string& name) -> std::optional<std::string> {
    const std::vector<std::string> ends = {"_motion.tsv", "_channels.tsv", "_motion.json",
                                           "_events.tsv"};
    for (size_t i = 1; i < ends.size() && i < parts.size(); ++i) {
      if (name.find(ends[i]) != std::string::npos) return parts[i];
    }
    return std::nullopt;
  };
  const Importer& importer = FindImporter(id, "", "");
  struct Pass {
    bool lenient;
    const char* mapping;  // of a table
  };
  std::vector<Pass> passes = {{false, "tests/fuzz/table_mapping.yaml"},
                              {true, "tests/fuzz/table_mapping_bare.yaml"}};
  if (id == "table") {
    passes.push_back({true, "human_study/examples/deeplabcut/columns.yaml"});
    passes.push_back({false, "human_study/examples/freemocap/columns.yaml"});
  }
  for (const Pass& pass : passes) {
    ImportOptions options;
    options.accept_truncated = pass.lenient;
    options.trust_residuals = pass.lenient;
    if (id == "table") options.mapping = FindDataRoot() / pass.mapping;
    std::istringstream stream(parts[0]);
    try {
      const Recording recording = ImportRecording(
          importer, {stream, "sub-1_task-g_tracksys-q_motion.tsv", sibling}, options);
      DescribeRecording(recording).dump();  // throws when a text is not UTF-8
      FormatRecording(recording);
    } catch (const Error&) {
    }
  }
  if (importer.redact == nullptr) return;
  std::string redacted = parts[0];
  try {
    importer.redact(redacted, "file");
  } catch (const Error&) {
  }
}

}  // namespace graspbench
