#include "workbench/experiments/machines/submit_script.h"

#include <cstdlib>
#include <regex>
#include <string_view>

#include "core/base/enum_table.h"
#include "core/base/error.h"
#include "core/base/files/files.h"
#include "core/base/text/yaml.h"
#include "workbench/experiments/machines/shell_quote.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

/** Values stand in a script as they are, so they are words of plain letters. */
bool IsPlainWord(const std::string& text) {
  constexpr std::string_view kPlain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_.,:=@+/-";
  return text.find_first_not_of(kPlain) == text.npos;
}

void FailWord(YamlMap& map, const char* key, const std::string& word) {
  map.Fail(key, "\"" + word + "\": expected letters, digits and _.,:=@+/- only");
}

void ReadWords(YamlMap& map, const char* key, std::vector<std::string>& words) {
  map.Read(key, words, Needed::kNo);
  for (const std::string& word : words) {
    if (word.empty() || !IsPlainWord(word)) FailWord(map, key, word);
  }
}

void ReadWord(YamlMap& map, const char* key, std::string& word) {
  map.Read(key, word, Needed::kNo);
  if (!IsPlainWord(word)) FailWord(map, key, word);
}

void Check(YamlMap& map, const char* key, const std::string& value, const char* pattern,
           const std::string& expected) {
  if (value.empty() || std::regex_match(value, std::regex(pattern))) return;
  map.Fail(key, "\"" + value + "\": expected " + expected);
}

/** "#SBATCH --partition=a --time=b" with a line feed, or nothing. */
std::string FormatSite(const ClusterConfig& cluster) {
  std::string text;
  const auto add = [&text](const char* option, const std::string& value) {
    if (!value.empty()) text += std::string(" --") + option + "=" + value;
  };
  add("partition", cluster.partition);
  add("account", cluster.account);
  add("time", cluster.time);
  add("mem", cluster.memory);
  for (const std::string& option : cluster.options) text += " " + option;
  return text.empty() ? "" : "#SBATCH" + text + "\n";
}

/** What every job has in front of the program. */
std::string FormatSetting(const ClusterConfig& cluster) {
  std::string text;
  for (const std::string& module : cluster.modules) text += " " + module;
  return (text.empty() ? "" : "module load" + text + "\n") +
         "export OPENBLAS_NUM_THREADS=1 LP_NUM_THREADS=0\n";
}

struct Words {
  std::string program, work, count, log;
};

Words MakeWords(const SubmitRequest& request) {
  const std::string program = QuoteForShell(fs::absolute(request.program).string());
  const std::string what = request.judge ? "judge" : request.explain ? "explain" : "work";
  const std::string round = what == "work" ? "" : " --" + what;
  return {program, program + " work ." + round + " --shard ", std::to_string(request.num_shards),
          "logs/" + what};
}

std::string MakeHead(const SubmitRequest& request, const Words& words, const std::string& by) {
  return "#!/bin/bash\n# " + words.count + " shards " + by +
         ", then their merge; once more works on what is left.\nset -u\ncd " +
         QuoteForShell(fs::absolute(request.folder).lexically_normal().string()) +
         " || exit 5\nmkdir -p logs\n";
}

std::string FormatBeginning(const SubmitRequest& request) {
  return request.num_rounds > 1
             ? "for round in $(seq " + std::to_string(request.num_rounds) + "); do\n"
             : "";
}

/** Behind the work of a round. */
std::string FormatEnd(const SubmitRequest& request, const Words& words) {
  return request.num_rounds > 1 ? words.program + " merge .\ndone\n"
                                : "exec " + words.program + " merge .\n";
}

constexpr char kLeaveWhenStopped[] =
    "[[ $stopped ]] && { echo 'stopped; repeat the command to continue' >&2; exit 75; }\n";

std::string MakeLocal(const SubmitRequest& request) {
  const Words words = MakeWords(request);
  const std::string log = words.log + "-\"$shard\".log";
  return MakeHead(request, words, "on this machine's processors") + FormatSetting({}) +
         FormatBeginning(request) +
         "stopped=\n"
         "trap 'stopped=1; kill $(jobs -pr) 2>/dev/null' TERM\n"
         "trap 'stopped=1' INT HUP  # a terminal tells the workers, too\n"
         "for shard in $(seq " +
         words.count +
         "); do\n"
         "  while [[ $(jobs -pr | wc -l) -ge $(nproc) ]]; do wait -n; done\n"
         "  [[ $stopped ]] && break\n"
         "  " +
         words.work + "\"$shard/" + words.count + "\" >>" + log +
         " 2>&1 &\n"
         "  [[ $stopped ]] && kill $!\n"
         "done\n"
         "while [[ $(jobs -pr) ]]; do wait; done\n" +
         kLeaveWhenStopped + FormatEnd(request, words);
}

/** The list of jobs is a record only: a shard that has lost a line since is worked on again, and
one that is finished leaves at once. The command is one word, as parallel's shell reads it once
more. */
std::string MakeParallel(const SubmitRequest& request) {
  const Words words = MakeWords(request);
  return MakeHead(request, words, "with GNU parallel") + FormatSetting({}) +
         FormatBeginning(request) +
         "stopped=\n"
         "# Once: start no more; twice: terminate what runs.\n"
         "trap 'stopped=1; kill $!; sleep 1; kill $! 2>/dev/null' TERM INT HUP\n"
         "parallel --joblog " +
         words.log + "-" + words.count + ".joblog --termseq TERM,60000,KILL,25 \\\n  " +
         QuoteForShell(words.work + "{}/" + words.count + " >>" + words.log + "-{}.log 2>&1") +
         " ::: $(seq " + words.count +
         ") &\n"
         "while [[ $(jobs -pr) ]]; do wait; done\n" +
         kLeaveWhenStopped + FormatEnd(request, words);
}

/** The signal goes to the shell of a batch job, not to its children: so the program takes the
shell's place. */
std::string MakeSlurm(const SubmitRequest& request) {
  const Words words = MakeWords(request);
  const std::string site = FormatSite(request.cluster), setting = FormatSetting(request.cluster);
  const bool has_rounds = request.num_rounds > 1;
  return MakeHead(request, words, "as a job array of Slurm") + (has_rounds ? "after=\n" : "") +
         FormatBeginning(request) + "array=$(sbatch --parsable" + (has_rounds ? " $after" : "") +
         " <<'END'\n#!/bin/bash\n"
         "#SBATCH --job-name=graspbench-work --array=1-" +
         words.count +
         "\n"
         "#SBATCH --requeue --signal=B:TERM@60\n"
         "#SBATCH --open-mode=append --output=" +
         words.log + "-%a.log\n" + site + setting + "exec " + words.work +
         "\"$SLURM_ARRAY_TASK_ID\"/" + words.count + "\nEND\n) || exit 5\n" +
         (has_rounds ? "merge=$(" : "") + "sbatch" + (has_rounds ? " --parsable" : "") +
         " --dependency=afterany:\"$array\" <<'END'" + (has_rounds ? "" : " || exit 5") +
         "\n#!/bin/bash\n"
         "#SBATCH --job-name=graspbench-merge\n"
         "#SBATCH --open-mode=append --output=logs/merge.log\n" +
         site + setting + "exec " + words.program + " merge .\nEND\n" +
         (has_rounds ? ") || exit 5\nafter=--dependency=afterany:$merge\ndone\n" : "");
}

struct EngineRow {
  const char* name;
  std::string (*make)(const SubmitRequest& request);
};
constexpr EngineRow kEngines[] = {
    {"local", MakeLocal}, {"parallel", MakeParallel}, {"slurm", MakeSlurm}};

}  // namespace

fs::path FindClusterFile() {
  const char* config = std::getenv("XDG_CONFIG_HOME");
  const char* home = std::getenv("HOME");
  const fs::path folder =
      config && *config ? fs::path(config) : fs::path(home && *home ? home : "/") / ".config";
  return folder / "graspbench" / "cluster.yaml";
}

ClusterConfig LoadClusterConfig(const fs::path& file) {
  std::error_code status;
  if (!fs::exists(file, status)) return {};
  return ParseClusterConfig(ReadFile(file), file.string());
}

ClusterConfig ParseClusterConfig(const std::string& text, const std::string& file) {
  Diagnostics problems;
  ClusterConfig cluster;
  const YAML::Node root = ParseYaml(text, file, problems);
  if (root.IsDefined() && !root.IsNull()) {
    YamlMap map(root, file, "cluster", problems);
    ReadWord(map, "partition", cluster.partition);
    ReadWord(map, "account", cluster.account);
    ReadWord(map, "time", cluster.time);
    Check(map, "time", cluster.time, R"((\d+-)?\d+(:\d+){0,2})",
          "minutes or days-hours:minutes:seconds, for example 2:00:00");
    ReadWord(map, "memory", cluster.memory);
    Check(map, "memory", cluster.memory, R"(\d+[KMGT]?)",
          "megabytes or a number with K, M, G or T, for example 2G");
    ReadWords(map, "modules", cluster.modules);
    ReadWords(map, "options", cluster.options);
    for (const std::string& option : cluster.options) {
      if (option.compare(0, 1, "-") != 0) {
        map.Fail("options",
                 "\"" + option + "\": expected an option of sbatch, for example --qos=long");
      }
    }
    map.FinishKnownKeys();
  }
  problems.ThrowIfErrors(ErrorKind::kFormat, "the cluster's settings cannot be used");
  return cluster;
}

std::vector<std::string> ListEngines() { return ListNames(kEngines); }

std::string MakeSubmitScript(const SubmitRequest& request) {
  if (const EngineRow* engine = FindRow(kEngines, request.engine)) return engine->make(request);
  throw Error(ErrorKind::kUsage,
              "no engine \"" + request.engine + "\"" + SuggestNames(request.engine, ListEngines()));
}

}  // namespace graspbench
