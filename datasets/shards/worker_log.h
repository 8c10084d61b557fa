#pragma once
/** @file
The machines that worked on a session's shards, recorded separately from the results:

    workers/<shard>-0.jsonl   append-only, synced; one line when a worker begins on the shard, with
                              machine, program and results of the sentinel trials there; one
                              when it ends, unless it is killed
    workers/judge-<shard>-0.jsonl   likewise for a worker that judges held trials

The sentinels (shard.h) are trials of the plan that every machine runs before its own trials. They
reveal machines whose processor or libraries round differently, before their trials are accepted as
one session. A worker that finds the sentinels of its own machine and build in another shard's file
does not repeat them. It may miss them, since it does not wait for other workers. */

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "datasets/journal/append_file.h"
#include "datasets/records/trial_record.h"

namespace graspbench {

/** The properties of a machine that may affect the last bit of a result, and its name. */
struct Machine {
  std::string host;
  std::string processor;        ///< "AMD EPYC 7763"
  std::string processor_flags;  ///< hash; they select functions of the C library
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

/** Start of a worker on a machine. */
struct WorkerStart {
  std::string shard;  ///< "3of7"
  std::string started_utc;
  Machine machine;
  std::vector<TrialRecord> sentinels;  ///< empty: another start on this machine has them
};

/** Regular end of a worker. */
struct WorkerEnd {
  std::string shard;
  std::string ended_utc;
  int num_left = 0;  ///< unfinished trials of the shard
};

std::string FormatWorkerLine(const WorkerStart& start);
std::string FormatWorkerLine(const WorkerEnd& end);
/** @throws Error(kFormat) saying what is wrong with the line. */
WorkerStart ParseWorkerLine(std::string_view line);

struct Workers {
  std::vector<WorkerStart> starts;  ///< by file and line
  std::set<std::string> at_rest;    ///< shards whose last worker recorded its end
};
/** Loads the workers' files. Invalid lines are added to `findings`. @throws Error(kIo). */
Workers LoadWorkers(const std::filesystem::path& folder, Diagnostics& findings);

/** Whether the sentinels of `plan` have been run by this build on this machine. */
bool HasSentinels(const std::vector<WorkerStart>& starts, const Machine& machine,
                  const std::vector<PlannedTrial>& plan);

/** Returns one sentence for each machine whose sentinels differ from those of most machines: the
trial, the number of different values, and the largest difference. Independent of the order of
`starts`. */
std::vector<std::string> DescribeDifferences(const std::vector<WorkerStart>& starts);

/** Returns labels of shards that have begun, or have a journal in the folder, without sentinels of
their machine. */
std::set<std::string> FindUnchecked(const std::filesystem::path& folder,
                                    const std::vector<WorkerStart>& starts);
/** Returns a sentence that names these shards; empty if there are none. */
std::string DescribeUnchecked(const std::set<std::string>& labels);

/** Returns "node1 (AMD EPYC 7763, flags 0123456789abcdef, glibc 2.36, build fedcba9876543210)". */
std::string DescribeMachine(const Machine& machine);

/** Merge the workers' lines: ListStartLines returns the lines known in `folder`, CollectStarts the
new lines of another folder (extending `known`), and AppendStarts writes them. A shard whose machine
the other folder does not record keeps its gap. */
///@{
std::set<std::string> ListStartLines(const std::filesystem::path& folder);
std::string CollectStarts(const std::filesystem::path& other, std::set<std::string>& known);
void AppendStarts(const std::filesystem::path& folder, const std::string& lines);
///@}

/** Prefixes of a shard's label for workers that judge or explain, so that no command mistakes
another's worker for its own. */
inline constexpr char kJudgeLabel[] = "judge-";
inline constexpr char kExplainLabel[] = "explain-";

/** Prefix of the files that a merge writes, in place of a shard's label. */
inline constexpr char kMergedLabel[] = "merged";

/** The shard's own file. While the object exists, no other process can work on the shard. */
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
