#pragma once
/** @file
Rehearsals of hands on objects (core/rehearse): the folder of `graspbench rehearse`.

    rehearsal.json   frozen: candidates, draws, conditions, each pair with the hash of its rehearsal
    manifest.json    hashes of all of it (manifest.h)
    journal.jsonl    one line per pair of hand and object, in their order
    candidates.csv   one row per evaluated candidate; written when all pairs are rehearsed
    grasps/HAND/OBJECT.yaml   the chosen grasps, as grasp files
    isaac/HAND/OBJECT.yaml, dexgraspbench/HAND/OBJECT.npy   the same for other programs
    report/          the page

A journal line:

    {"request":3,"hand":"tum","object":"can","hash":"0123456789abcdef","result":{..},"search":"..",
     "xxh64":".."}

`hash` covers everything that determines the rehearsal (datasets/plan/rehearsed_grasps.h). The
journal is written in the order of the pairs for any number of workers. See answer_journal.h. */

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/rehearse/rehearse_grasp.h"
#include "datasets/scene/answer_journal.h"

namespace graspbench {

struct RehearsedPair {
  int request = 0;  ///< number of the pair, from 0
  std::string hand, object;
  std::string hash;
  Rehearsal result;
  std::optional<std::string> search = {};

  template <class V>
  static void ListFields(V&& field) {
    using R = RehearsedPair;
    field("request", &R::request);
    field("hand", &R::hand);
    field("object", &R::object);
    field("hash", &R::hash);
    field("result", &R::result);
    field("search", &R::search);
  }

  static std::string Format(const RehearsedPair& record);
  /** @throws Error(kFormat). */
  static RehearsedPair Parse(std::string_view line);
};

using RehearsalJournal = AnswerJournal<RehearsedPair>;

inline constexpr char kCandidateTable[] = "candidates.csv";

/** Verifies and loads all rehearsals. @throws as LoadFrozen. */
std::vector<RehearsedPair> LoadRehearsals(const std::filesystem::path& folder);

/** The data dictionary of candidates.csv. */
Json MakeCandidateTableSchema();
/** Writes candidates.csv and the chosen grasps, and seals the store.
@param grasps  texts of grasp files, by path relative to the folder. @throws Error(kIo). */
void FinishRehearsals(const std::filesystem::path& folder, const std::vector<RehearsedPair>& pairs,
                      std::map<std::string, std::string> grasps);

}  // namespace graspbench
