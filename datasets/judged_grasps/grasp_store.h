#pragma once
/** @file
Foreign grasps judged under profiles: the folder of `graspbench grasps judge`.

    grasps.json     frozen: files with their hashes, hand, objects, profiles in full, jitter
    manifest.json   hashes of all of it (manifest.h)
    journal.jsonl   one line per task, in order
    grasps.csv      the results as a table, when all are judged; grasps.schema.json: its dictionary
    report/         the page

A task is one grasp, with one disturbance of its root, under one profile. The journal is written in
the order of tasks for any number of workers, so that an interrupted and resumed run gives the same
bytes. */

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/text/json.h"
#include "core/statistics/proportion.h"
#include "core/trial/protocols/free_space.h"
#include "datasets/scene/answer_journal.h"

namespace graspbench {

struct JudgedGrasp {
  int request = 0;      ///< number of the task, from 0
  std::string source;   ///< file of the grasp
  int index = 0;        ///< in its file
  std::string object;   ///< name in the grasp's file
  std::string profile;  ///< its name
  int jitter = 0;       ///< 0: undisturbed; else number of the disturbance
  std::string label;    ///< the file's own verdict: "success", "failure", empty: none
  FreeSpaceResult result;
  std::optional<std::string> search = {};  ///< see answer_journal.h

  template <class V>
  static void ListFields(V&& field) {
    using J = JudgedGrasp;
    field("request", &J::request);
    field("source", &J::source, FieldColumn{"", "file of the grasp"});
    field("index", &J::index, FieldColumn{"", "of the grasp in its file"});
    field("object", &J::object, FieldColumn{"", "as the file names it"});
    field("profile", &J::profile, FieldColumn{"", "whose rules"});
    field("jitter", &J::jitter, FieldColumn{"", "0: as it is; else the number of the disturbance"});
    field("label", &J::label, FieldColumn{"", "the file's own verdict"});
    field("result", &J::result);
    field("search", &J::search);
  }

  static std::string Format(const JudgedGrasp& record);
  /** @throws Error(kFormat). */
  static JudgedGrasp Parse(std::string_view line);

  std::vector<int> trials;  ///< always empty; required by AnswerJournal
};

using GraspJournal = AnswerJournal<JudgedGrasp>;

bool HasJudgedGrasps(const std::filesystem::path& folder);
/** Makes the folder a store. @pre the folder exists. @throws Error(kIo). */
void CreateJudgedGrasps(const std::filesystem::path& folder, const Json& config);
/** @throws Error(kUsage) when it was made from other files, hands, objects or profiles, naming the
keys that differ; kVersion; kFormat; kIo. */
void CheckSameGrasps(const std::filesystem::path& folder, const Json& config);

/** Verifies and loads the frozen configuration. @throws as LoadFrozen. */
Json LoadGraspConfig(const std::filesystem::path& folder);

/** Verifies and loads all judged grasps. @throws as LoadFrozen. */
std::vector<JudgedGrasp> LoadJudgedGrasps(const std::filesystem::path& folder);

inline constexpr char kGraspTable[] = "grasps.csv";
/** The data dictionary of grasps.csv. */
Json MakeGraspTableSchema();
/** Writes grasps.csv and seals the store. @throws Error(kIo). */
void FinishJudgedGrasps(const std::filesystem::path& folder,
                        const std::vector<JudgedGrasp>& judged);

/** Summary: how many grasps pass under each profile, how well the files' own verdicts agree, how
verdicts change between profiles, and which grasps nearly passed or failed.

Agreement beyond chance is Cohen's kappa = (p_o - p_e) / (1 - p_e), with p_o the share of equal
verdicts and p_e that of two independent judges with the same pass rates (J. Cohen, Educ. Psychol.
Meas. 20, 1960). Grasps whose simulation failed count as failed and are also counted separately. */

/** Returns Cohen's kappa; NaN if p_e is 1. */
double CalcKappa(const PairedCounts& counts);

struct ProfileSummary {
  std::string profile;
  int num_judged = 0, num_passed = 0, num_numerical = 0;
  PairedCounts labels;  ///< of labelled grasps: first the label, second the verdict
  std::vector<std::pair<std::string, int>> stages;  ///< where grasps failed, most frequent first
  /** Share of disturbed grasps that pass, among grasps that pass undisturbed; NaN without
  disturbances. */
  double jitter_share = kUnset;
};

/** The same grasps under two profiles. */
struct ProfileTransition {
  std::string from, to;
  PairedCounts counts;
};

struct JudgedSummary {
  int num_grasps = 0;  ///< without disturbances
  std::vector<ProfileSummary> profiles;
  std::vector<ProfileTransition> transitions;  ///< of each profile to the next
  /** Undisturbed grasps, nearest to the limits first. */
  std::vector<const JudgedGrasp*> nearest;
};

/** @param judged  must outlive the summary. @param limits  of each profile: shift [m], turn
[deg]. */
JudgedSummary SummariseJudged(const std::vector<JudgedGrasp>& judged,
                              const std::map<std::string, std::pair<double, double>>& limits);

/** Returns the limits of the profiles in a frozen configuration. @throws Error(kFormat). */
std::map<std::string, std::pair<double, double>> FindLimits(const Json& config);

}  // namespace graspbench
