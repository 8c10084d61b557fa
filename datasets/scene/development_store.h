#pragma once
/** @file
How a hand's grasps were developed (core/develop), the folder development/ of a developed hand:

    development.json   frozen configuration: the hand, budget, seed, physics
    manifest.json      hashes of all of it (manifest.h)
    journal.jsonl      every request in order, its trials' outcomes and scores
    result.json        the developed grasps: what geometry gave, scores, the check

A journal line:

    {"request":57,"stage":"search","id":"0123456789abcdef","trials":[{"outcome":"success",
     "score":1.21},..],"xxh64":".."}

The development is deterministic: the same answers lead to the same questions. So it is resumed by
asking again from the start, and answering from the journal what is there. `id` is a hash of the
question: an answer to another one is never taken. */

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/base/diagnostics.h"
#include "core/develop/develop_grasp.h"
#include "datasets/journal/append_file.h"
#include "datasets/plan/session_config.h"

namespace graspbench {

/** Frozen in development.json. */
struct DevelopmentConfig : TrialConditions {
  std::string hand;          ///< its id
  std::string hand_content;  ///< hash of hand.urdf and hand.yaml
  DevelopConfig develop;

  template <class V>
  void Visit(V&& v) {
    v("hand", hand);
    v("hand_content", hand_content);
    v("develop", develop);
    TrialConditions::Visit(v);
  }
};

bool HasDevelopment(const std::filesystem::path& folder);
/** Makes the folder the store of a new development; it exists. @throws Error(kIo). */
void CreateDevelopment(const std::filesystem::path& folder, const DevelopmentConfig& config);
/** @throws Error(kUsage) listing the settings that differ; kVersion; kFormat; kIo. */
void CheckSameDevelopment(const std::filesystem::path& folder, const DevelopmentConfig& config);

/** Writes result.json and seals the store. @throws Error(kIo). */
void WriteDevelopmentResult(const std::filesystem::path& folder, const Hand& hand,
                            const std::vector<DevelopedGrasp>& developed);

struct DevelopmentRecord {
  int request = 0;
  std::string stage;
  std::string id;
  std::vector<DevelopTrial> trials;

  template <class V>
  static void ListFields(V&& field) {
    field("request", &DevelopmentRecord::request);
    field("stage", &DevelopmentRecord::stage);
    field("id", &DevelopmentRecord::id);
    field("trials", &DevelopmentRecord::trials);
  }
};

std::string FormatDevelopmentLine(const DevelopmentRecord& record);
/** @throws Error(kFormat). */
DevelopmentRecord ParseDevelopmentLine(std::string_view line);

class DevelopmentJournal {
 public:
  /** A line is good when its checksum is right, whatever the lines before it are; what a crash has
  left of a line at the end is cut off. @throws Error(kIo), also when another process writes it. */
  explicit DevelopmentJournal(const std::filesystem::path& path);

  /** The stored answer to a question; null: not there. */
  const DevelopmentRecord* Find(int request) const;
  /** Behind the stored ones, on the disk when it returns. */
  void Append(const std::vector<DevelopmentRecord>& records);

 private:
  AppendFile file_;
  std::map<int, DevelopmentRecord> stored_;  // by request
};

}  // namespace graspbench
