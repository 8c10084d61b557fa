#pragma once
/** @file
On which machines a session's shards were worked on, beside its results and never in them:

    workers/<shard>-0.jsonl   append-only; a line for each machine on which the shard was begun: the
                              machine, the program, and what the sentinel trials gave there; synced

The sentinels (shard.h) are trials of the plan that every machine runs before its own. Machines
whose processor or libraries round differently are found by them, before their trials are believed
to be one session. */

#include <filesystem>
#include <string>
#include <vector>

#include "core/base/diagnostics.h"
#include "datasets/journal/append_file.h"
#include "datasets/session/trial_record.h"

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
  std::vector<TrialRecord> sentinels;
};

std::string FormatWorkerLine(const WorkerStart& start);
/** @throws Error(kFormat) saying what is wrong with the line. */
WorkerStart ParseWorkerLine(std::string_view line);

/** By file and line; lines that are none go into `findings`.
@param label  of the shard whose files are read; empty: of all. @throws Error(kIo). */
std::vector<WorkerStart> LoadWorkers(const std::filesystem::path& folder, Diagnostics& findings,
                                     const std::string& label = "");

/** One sentence for each machine whose sentinels are not those of most machines: which trial, in how
many values, and where and how far they differ most. Independent of the order of `starts`. */
std::vector<std::string> DescribeDifferences(const std::vector<WorkerStart>& starts);

/** "node1 (AMD EPYC 7763, flags 0123456789abcdef, glibc 2.36, build fedcba9876543210)". */
std::string DescribeMachine(const Machine& machine);

/** The shard's own file; while it lives no other process works on the shard. */
class WorkerLog {
 public:
  /** @throws Error(kIo) when it cannot be written or another process works on the shard. */
  WorkerLog(const std::filesystem::path& folder, const std::string& label);
  void Append(const WorkerStart& start) { file_.Append(FormatWorkerLine(start) + "\n"); }

 private:
  AppendFile file_;
};

}  // namespace graspbench
