#pragma once
/** @file
An entry of a benchmark as one tar file (datasets/pipeline/pipeline_pack.h):

    manifest.json   SHA-256 of every other file; program version and commit
    entry.json      name, author, licence, method in the author's words; the benchmark
    session/..      the session's configuration, plan, grasps and journal, a separate store

A session gives the same bytes on every machine, no matter how often it was resumed. A session of a
controller is an entry by its recorded actions. The results stated in an entry are not used: a board
re-simulates its trials. */

#include <filesystem>
#include <string>

#include "core/base/text/record_fields.h"
#include "datasets/benchmark/benchmark_file.h"
#include "datasets/session/session_store.h"

namespace graspbench {

inline constexpr char kEntryPack[] = "entry";  ///< kind in the manifest
inline constexpr size_t kLongestName = 40;     ///< of an entry and its author [characters]
inline constexpr size_t kLongestNotes = 10000;

/** The author's statements. */
struct EntryFacts {
  std::string name, by, licence;
  std::string date;       ///< declared by the author: "2026-11-28"; empty: none
  std::string notes;      ///< the method
  std::string benchmark;  ///< its name
  std::string benchmark_sha256;

  template <class V>
  static void ListFields(V&& field) {
    using F = EntryFacts;
    field("name", &F::name);
    field("by", &F::by);
    field("licence", &F::licence);
    field("date", &F::date);
    field("notes", &F::notes);
    field("benchmark", &F::benchmark);
    field("benchmark_sha256", &F::benchmark_sha256);
  }
};
/** @throws Error(kUsage) for an empty, too long or unreadable text, or an invalid date. */
void CheckFacts(const EntryFacts& facts);
/** Returns the declared year, "2026", or "not declared". */
std::string DescribeYear(const EntryFacts& facts);

struct Entry {
  EntryFacts facts;
  Session session;  ///< brief
  SessionInputs inputs;
};

/** Checks that a session may be an entry: the benchmark's settings, hands and objects; the plan
that follows from them, with each draw once; every trial finished; recorded actions for a
controller.
@throws Error(kUsage, kVersion) with the reason. */
void CheckEntry(const Session& session, const SessionInputs& inputs, const Benchmark& benchmark);

/** Makes the folder that WritePack packs. @pre CheckEntry. @throws Error(kUsage, kIo). */
void GatherEntry(const Session& session, const EntryFacts& facts,
                 const std::filesystem::path& folder);

/** Unpacks into a new folder and checks everything that needs no simulation. Nothing is executed,
and only files in the folder and those of the program are read.
@throws Error with the reason: as Unpack, CheckFacts, LoadSession, CheckEntry. */
Entry LoadEntry(const std::filesystem::path& pack, const std::filesystem::path& folder,
                const Benchmark& benchmark);

/** Describe what an entry declares: "strategy" or "recorded actions", with the arm; "pose nominal,
touch exact". */
///@{
std::string DescribeController(const SessionConfig& config);
std::string DescribeSensing(const SessionConfig& config);
///@}

}  // namespace graspbench
