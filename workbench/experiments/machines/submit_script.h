#pragma once
/** @file
The script that works on all shards of a session and then merges them: with this machine's
processors, with GNU parallel, or as a job array of Slurm. It is meant to be read and kept: at most
30 lines, which a user could have typed. */

#include <filesystem>
#include <string>
#include <vector>

namespace graspbench {

/** Settings of a site for every job; empty: not set. */
struct ClusterConfig {
  std::string partition, account;
  std::string time;                  ///< time limit per job in Slurm's notation: "02:00:00"
  std::string memory;                ///< memory per job: "2G"
  std::vector<std::string> modules;  ///< loaded before the program starts
  std::vector<std::string> options;  ///< further options of sbatch: "--constraint=skylake"
};

/** Returns $XDG_CONFIG_HOME/graspbench/cluster.yaml, or the same below $HOME/.config. */
std::filesystem::path FindClusterFile();

/** Loads the file, or returns defaults without one.
@throws Error(kFormat) listing, with file and line, every unknown key and every value that does not
fit into one script line; Error(kIo). */
ClusterConfig LoadClusterConfig(const std::filesystem::path& file);
/** As LoadClusterConfig, for text in memory; `file` is its name in messages. */
ClusterConfig ParseClusterConfig(const std::string& text, const std::string& file);

struct SubmitRequest {
  std::filesystem::path folder;   ///< of the session
  std::filesystem::path program;  ///< path by which the jobs call it
  std::string engine;             ///< one of ListEngines()
  int num_shards = 1;
  bool judge = false;
  bool explain = false;
  int num_rounds = 1;     ///< rounds of work and merge: a campaign has two
  ClusterConfig cluster;  ///< for "slurm"
};

std::vector<std::string> ListEngines();

/** Makes the bash script. The folder and the program are named by absolute paths.
@throws Error(kUsage) for an unknown engine. */
std::string MakeSubmitScript(const SubmitRequest& request);

}  // namespace graspbench
