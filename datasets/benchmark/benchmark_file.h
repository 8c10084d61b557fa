#pragma once
/** @file
A named benchmark: what every entry of a board has in common. A released version stays as it is; a
change is a new version with a file of its own.

    name: graspbench-21/1
    about: 21 everyday objects, two hands
    physics: 14                     # kPhysicsVersion
    session: {trials: 10, seed: 1}  # as in session.yaml: protocol, draws, rules of success
    open: [grasps, strategy.grip]   # settings that an entry may choose, beside its hands
    hands: {tum: 0123456789abcdef}  # that an entry may choose, with the hash of their content
    objects: {can: ..}              # all of which an entry grasps, with their hashes
    commitment: ..                  # of held-out draws; may be left out

Held-out draws are those of another seed, and synthetic objects (objects/catalogue.h) are those of
that seed, too, which nobody has seen. Their organiser publishes CalcCommitment of seed and nonce
before entries are made, and reveals both when the entries are there. */

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
  std::string about;  ///< in a sentence
  int physics = 0;
  SessionConfig session;          ///< with hands to start with, and all objects
  std::vector<std::string> open;  ///< keys; one of a map opens all that is below it
  BenchmarkPins hands, objects;
  std::string commitment;  ///< 64 hexadecimal digits; empty: none was published here
  std::string sha256;      ///< of all of it but `about`, whatever the file's layout
};

/** The rows that the reader checks. */
const FileKeys& ListBenchmarkKeys();

/** @param file  its name in messages. @throws Error(kFormat) with all faults and their lines. */
Benchmark ParseBenchmark(const std::string& text, const std::string& file);
/** @param name  of one that comes with the program, also with a hyphen for the slash, or a file.
@throws Error(kNotFound) with the known names; as ParseBenchmark. */
Benchmark LoadBenchmark(const std::string& name);
/** Names of those that come with the program, sorted; no file is read. */
std::vector<std::string> ListBenchmarks();

/** "graspbench-21-1": the benchmark's name as one of files. */
std::string NameBenchmarkFile(std::string name);

/** The program simulates with the benchmark's physics, and has its hands and objects.
@param inputs  of a session of it.
@throws Error(kVersion) naming what is another. */
void CheckPins(const Benchmark& benchmark, const SessionInputs& inputs);
/** All hands and objects of the benchmark, checked. @throws as CheckPins, LoadSessionInputs. */
SessionInputs LoadPinned(const Benchmark& benchmark);

/** A configuration on held-out draws. */
SessionConfig MakeHeldOut(SessionConfig config, int seed);
/** Hands and objects of the held-out draws. @throws as LoadSessionInputs. */
SessionInputs LoadHeldOut(const Benchmark& benchmark, int seed);

/** What a configuration has that the benchmark does not leave open, in words. */
std::vector<std::string> FindOtherSettings(const Benchmark& benchmark, const SessionConfig& config);
/** @throws Error(kUsage) naming all of them. */
void CheckSettings(const Benchmark& benchmark, const SessionConfig& config);

/** A nonce has at least so many characters: a seed alone could be found by trying all. */
inline constexpr size_t kShortestNonce = 16;
/** In lower case. @throws Error(kUsage) when it is not 64 hexadecimal digits. */
std::string ReadCommitment(const std::string& text);
/** SHA-256 of "NAME SEED NONCE". */
std::string CalcCommitment(const std::string& benchmark, int seed, const std::string& nonce);

}  // namespace graspbench
