#pragma once
/** @file
The record of developing a hand's grasps (core/develop), in the folder development/ of the hand:

    development.json   frozen configuration: the hand, budget, seed, physics
    manifest.json      hashes of all of it (manifest.h)
    journal.jsonl      every request in order, with its trials' outcomes and scores
    result.json        the developed grasps: result of the geometry, scores and check

A journal line:

    {"request":57,"stage":"search","id":"0123456789abcdef","trials":[{"outcome":"success",
     "score":1.21},..],"search":"..","xxh64":".."}

`id` is a hash of the question, so that an answer to another question is never used. See
answer_journal.h. */

#include <filesystem>
#include <string>
#include <vector>

#include "core/develop/develop_grasp.h"
#include "datasets/plan/session_config.h"
#include "datasets/scene/answer_journal.h"

namespace graspbench {

/** Frozen in development.json. */
struct DevelopmentConfig : TrialConditions {
  std::string hand;          ///< its id
  std::string hand_content;  ///< hash of hand.urdf and hand.yaml
  DevelopConfig develop;

  template <class V>
  void Visit(V&& v) {
    v("hand", hand, "id of the hand");
    v("hand_content", hand_content, "hash of hand.urdf and hand.yaml");
    v("develop", develop);
    TrialConditions::Visit(v);
  }
};

bool HasDevelopment(const std::filesystem::path& folder);
/** Makes the folder the store of a new development. @pre the folder exists. @throws Error(kIo). */
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
  std::optional<std::string> search = {};  ///< older lines have none

  template <class V>
  static void ListFields(V&& field) {
    field("request", &DevelopmentRecord::request);
    field("stage", &DevelopmentRecord::stage);
    field("id", &DevelopmentRecord::id);
    field("trials", &DevelopmentRecord::trials);
    field("search", &DevelopmentRecord::search);
  }

  static std::string Format(const DevelopmentRecord& record);
  /** @throws Error(kFormat). */
  static DevelopmentRecord Parse(std::string_view line);
};

using DevelopmentJournal = AnswerJournal<DevelopmentRecord>;

}  // namespace graspbench
