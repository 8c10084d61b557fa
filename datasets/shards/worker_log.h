#pragma once
/** @file
On which machines a session's shards were worked on, beside its results and never in them:

    workers/<shard>-0.jsonl   append-only, synced; a line when a worker begins on the shard: the
                              machine, the program, and what the sentinel trials gave there; and
                              one when it ends, unless it is killed
    workers/judge-<shard>-0.jsonl   the same of a worker that breaks what the trials held

The sentinels (shard.h) are trials of the plan that every machine runs before its own. Machines
whose processor or libraries round differently are found by them, before their trials are believed
to be one session. A worker that finds those of its own machine and build in another shard's file
does not run them again; it may miss them, as nothing waits for what others write. */

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "datasets/journal/append_file.h"
#include "datasets/records/trial_record.h"

namespace graspbench {

/** What may decide the last bit of a result, and how people call the machine. */
struct Machine {
  std::string host;
  std::string processor;        ///< "AMD EPYC 7763"
  std::string processor_flags;  ///< hash: functions of the C library are chosen by them
  std::string c_library;        ///< "glibc 2.36"
  std::string build;            ///< hash of the program's own bytes
  std::string program_version;

  template <class V>
  static void ListFields(V&& field) {
    field("host", &Machine::host);
    field("processor", &Machine::processor);
    field("processor_flags", &Machine::processor_flags);
    field("c_library", &Machine::c_library);
    field("build", &Machine::build);
    field("program_version", &Machine::program_version);
  }
};
bool operator==(const Machine& a, const Machine& b);

/** A worker's beginning on a machine. */
struct WorkerStart {
  std::string shard;  ///< "3of7"
  std::string started_utc;
  Machine machine;
  std::vector<TrialRecord> sentinels;  ///< none: another start on the machine has them
};

/** A worker's end that it has seen coming. */
struct WorkerEnd {
  std::string shard;
  std::string ended_utc;
  int num_left = 0;  ///< trials of the shard
};

std::string FormatWorkerLine(const WorkerStart& start);
std::string FormatWorkerLine(const WorkerEnd& end);
/** @throws Error(kFormat) saying what is wrong with the line. */
WorkerStart ParseWorkerLine(std::string_view line);

struct Workers {
  std::vector<WorkerStart> starts;  ///< by file and line
  std::set<std::string> at_rest;    ///< shards whose last worker has said that it ended
};
/** Lines that are none go into `findings`. @throws Error(kIo). */
Workers LoadWorkers(const std::filesystem::path& folder, Diagnostics& findings);

/** Whether the sentinels of `plan` have been run by this build on this machine. */
bool HasSentinels(const std::vector<WorkerStart>& starts, const Machine& machine,
                  const std::vector<PlannedTrial>& plan);

/** One sentence for each machine whose sentinels are not those of most machines: which trial, in how
many values, and where and how far they differ most. Independent of the order of `starts`. */
std::vector<std::string> DescribeDifferences(const std::vector<WorkerStart>& starts);

/** Labels of the shards, among those that have begun or have a journal in the folder, of which a
machine has no sentinels. */
std::set<std::string> FindUnchecked(const std::filesystem::path& folder,
                                    const std::vector<WorkerStart>& starts);
/** A sentence that names these shards; empty when there are none. */
std::string DescribeUnchecked(const std::set<std::string>& labels);

/** "node1 (AMD EPYC 7763, flags 0123456789abcdef, glibc 2.36, build fedcba9876543210)". */
std::string DescribeMachine(const Machine& machine);

/** What a merge adds to the files of workers of `folder`, and adding it; `known` grows. Where the
other folder says nothing of a shard's machine, that is kept. */
///@{
std::set<std::string> ListStartLines(const std::filesystem::path& folder);
std::string CollectStarts(const std::filesystem::path& other, std::set<std::string>& known);
void AppendStarts(const std::filesystem::path& folder, const std::string& lines);
///@}

/** What stands before a shard's label where its held grasps are broken, so that neither of run and
judge takes the other's worker for its own. */
inline constexpr char kJudgeLabel[] = "judge-";
inline constexpr char kExplainLabel[] = "explain-";

/** How the files begin that a merge writes, in the place of a shard's label. */
inline constexpr char kMergedLabel[] = "merged";

/** The shard's own file; while it lives no other process works on the shard. */
class WorkerLog {
 public:
  /** @throws Error(kIo) when it cannot be written or another process works on the shard. */
  WorkerLog(const std::filesystem::path& folder, const std::string& label);
  void Append(const WorkerStart& start) { file_.Append(FormatWorkerLine(start) + "\n"); }
  void Append(const WorkerEnd& end) { file_.Append(FormatWorkerLine(end) + "\n"); }

 private:
  AppendFile file_;
};

}  // namespace graspbench
