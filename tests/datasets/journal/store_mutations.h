#pragma once
/** @file
Stores of every kind, small and made up, and random damage to them. */

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "core/base/random.h"

namespace graspbench {

/** A session that is judged, another one, a scene, a campaign with two scenes, a benchmark and a
comparison, and a study; all sealed. @returns the folders. */
std::vector<std::filesystem::path> MakeStores(const std::filesystem::path& folder);

using Files =
    std::map<std::string, std::string>;  ///< content by name from the folder of all stores

Files ReadFiles(const std::filesystem::path& folder);
/** Other files go; those that have their content already are not touched. */
void WriteFiles(const std::filesystem::path& folder, const Files& files);

/** The whole lines of all journals, each as often as it occurs, and of what was set aside. */
std::multiset<std::string> ListRecords(const Files& files);

/** Flips, cuts, deletes, swaps and moves: what hashes alone must find. */
inline constexpr int kNumHashedMutations = 8;
/** Also changed digits, inserted bytes, begun lines, and whole lines of any journal at the end of
another. */
inline constexpr int kNumMutations = 13;

/** One random change at a time. */
class Mutator {
 public:
  Mutator(const Files& files, const std::string& seed, int num_kinds);

  /** What was done, in words, and the files after it; empty: nothing could be done. */
  std::string Mutate(Files& files);

 private:
  int ChooseIndex(size_t count);
  const std::string& Choose(const std::vector<std::string>& names);
  std::string MutateLine(Files& files, const std::string& name, const std::string& other,
                         const std::string& what);
  std::string AddLine(Files& files);

  const Files whole_;
  const int num_kinds_;
  std::vector<std::string> names_, journals_;
  RandomStream random_;
};

struct MutationCount {
  int mutations = 0;
  int undetected = 0;
  int records_lost = 0;  ///< whole lines that were still there and that repairing threw away
  std::string examples;  ///< of what went wrong, one line each
};
/** Makes `count` changes, one at a time, in stores made in `folder`: flips bits, cuts, deletes and
swaps files and lines. Each must be found by CheckStore, and repairing must keep every whole
line. */
MutationCount MutateStores(const std::filesystem::path& folder, const std::string& seed, int count);

}  // namespace graspbench
