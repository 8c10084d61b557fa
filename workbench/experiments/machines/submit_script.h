#pragma once
/** @file
The script that works on all shards of a session and then merges them: with this machine's
processors, with GNU parallel, or as a job array of Slurm. It is made to be read and kept: at most
30 lines, nothing in it that a person would not type. */

#include <filesystem>
#include <string>
#include <vector>

namespace graspbench {

/** What a site wants to know of every job; empty: it is not asked for. */
struct ClusterConfig {
  std::string partition, account;
  std::string time;                  ///< of a job, as Slurm writes it: "02:00:00"
  std::string memory;                ///< of a job: "2G"
  std::vector<std::string> modules;  ///< loaded before the program starts
  std::vector<std::string> options;  ///< any other of sbatch: "--constraint=skylake"
};

/** $XDG_CONFIG_HOME/graspbench/cluster.yaml, else in $HOME/.config. */
std::filesystem::path FindClusterFile();

/** Defaults when there is no such file.
@throws Error(kFormat) listing every unknown key and every value that no line of a script can hold,
with file and line; Error(kIo). */
ClusterConfig LoadClusterConfig(const std::filesystem::path& file);
/** The same for text in memory; `file` is its name in messages. */
ClusterConfig ParseClusterConfig(const std::string& text, const std::string& file);

struct SubmitRequest {
  std::filesystem::path folder;   ///< of the session
  std::filesystem::path program;  ///< as the jobs are to call it
  std::string engine;             ///< one of ListEngines()
  int num_shards = 1;
  bool judge = false;
  bool explain = false;
  int num_rounds = 1;     ///< of work and merge: a campaign has two
  ClusterConfig cluster;  ///< for "slurm"
};

std::vector<std::string> ListEngines();

/** Text for bash. The folder and the program are named by absolute paths.
@throws Error(kUsage) for an unknown engine. */
std::string MakeSubmitScript(const SubmitRequest& request);

}  // namespace graspbench
