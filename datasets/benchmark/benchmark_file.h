#pragma once
/** @file
A named benchmark: the settings that all entries of a board share. A released version never changes;
a change is a new version in a new file.

    name: graspbench-21/1
    about: 21 everyday objects, two hands
    physics: 14                     # kPhysicsVersion
    session: {trials: 10, seed: 1}  # as in session.yaml: protocol, draws, rules of success
    open: [grasps, strategy.grip]   # settings that an entry may choose, in addition to its hands
    hands: {tum: 0123456789abcdef}  # hands that an entry may choose, with the hash of their content
    objects: {can: ..}              # objects that every entry grasps, with their hashes
    commitment: ..                  # to held-out draws; may be left out

Held-out draws are those of another seed; synthetic objects (objects/catalogue.h) are then also the
unseen ones of that seed. The organiser publishes CalcCommitment of seed and nonce before entries
are made, and reveals both after submission. */

#include <string>
#include <utility>
#include <vector>

#include "core/base/file_keys.h"
#include "datasets/plan/session_config.h"
#include "datasets/plan/session_inputs.h"

namespace graspbench {

inline constexpr char kDefaultBenchmark[] = "graspbench-21/1";

/** A hand or an object with the hash of all that its simulation depends on. */
using BenchmarkPins = std::vector<std::pair<std::string, std::string>>;

struct Benchmark {
  std::string name;   ///< with its version: "graspbench-21/1"
  std::string about;  ///< description in one sentence
  int physics = 0;
  SessionConfig session;          ///< with default hands and all objects
  std::vector<std::string> open;  ///< keys; the key of a map opens all keys below it
  BenchmarkPins hands, objects;
  std::string commitment;  ///< 64 hexadecimal digits; empty: not published here
  std::string sha256;      ///< of everything except `about`, independent of the file's layout
};

/** The keys that the reader checks. */
const FileKeys& ListBenchmarkKeys();

/** @param file  its name in messages. @throws Error(kFormat) with all faults and their lines. */
Benchmark ParseBenchmark(const std::string& text, const std::string& file);
/** @param name  of a shipped benchmark, with a slash or a hyphen, or the path of a file.
@throws Error(kNotFound) with the known names; as ParseBenchmark. */
Benchmark LoadBenchmark(const std::string& name);
/** Lists the names of the shipped benchmarks, sorted, without reading files. */
std::vector<std::string> ListBenchmarks();

/** Returns the benchmark's name as a file name: "graspbench-21-1". */
std::string NameBenchmarkFile(std::string name);

/** Checks that the program has the benchmark's physics, hands and objects.
@param inputs  of a session of the benchmark.
@throws Error(kVersion) naming what differs. */
void CheckPins(const Benchmark& benchmark, const SessionInputs& inputs);
/** Loads and checks all hands and objects of the benchmark. @throws as CheckPins,
LoadSessionInputs. */
SessionInputs LoadPinned(const Benchmark& benchmark);

/** Returns the configuration with held-out draws of `seed`. */
SessionConfig MakeHeldOut(SessionConfig config, int seed);
/** Loads hands and objects of the held-out draws. @throws as LoadSessionInputs. */
SessionInputs LoadHeldOut(const Benchmark& benchmark, int seed);

/** Lists, in words, the settings of a configuration that differ although the benchmark does not
leave them open. */
std::vector<std::string> FindOtherSettings(const Benchmark& benchmark, const SessionConfig& config);
/** @throws Error(kUsage) naming all of them. */
void CheckSettings(const Benchmark& benchmark, const SessionConfig& config);

/** Minimum length of a nonce. Without one, the seed could be found by brute force. */
inline constexpr size_t kShortestNonce = 16;
/** Returns the commitment in lower case. @throws Error(kUsage) when it is not 64 hexadecimal
digits. */
std::string ReadCommitment(const std::string& text);
/** Returns the SHA-256 of "NAME SEED NONCE". */
std::string CalcCommitment(const std::string& benchmark, int seed, const std::string& nonce);

}  // namespace graspbench
