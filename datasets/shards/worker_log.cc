#include "datasets/shards/worker_log.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "core/base/text/record_fields.h"
#include "core/base/text/text.h"
#include "datasets/journal/checked_line.h"
#include "datasets/journal/read_journal.h"
#include "datasets/shards/shard.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

constexpr char kWorkersFolder[] = "workers";

/** How far two results are apart. */
struct Distance {
  int num_values = 0;
  int num_different = 0;
  std::string worst;       ///< name of the value that differs most
  double relative = -1.0;  ///< of the worst; infinite where a number is none or a text differs
  std::string here, there;
};

std::string JoinKey(const std::string& key, const std::string& part) {
  return key.empty() ? part : key + "." + part;
}

void Compare(const Json& here, const Json& there, const std::string& key, Distance& distance) {
  const bool are_alike = here.type() == there.type() && here.size() == there.size();
  if (are_alike && here.is_object()) {
    for (const auto& [name, value] : here.items()) {
      const Json* const other = there.find(name);
      Compare(value, other == nullptr ? Json() : *other, JoinKey(key, name), distance);
    }
    return;
  }
  if (are_alike && here.is_array()) {
    for (size_t i = 0; i < here.size(); ++i) {
      Compare(here[i], there[i], JoinKey(key, std::to_string(i)), distance);
    }
    return;
  }
  ++distance.num_values;
  if (here == there) return;
  ++distance.num_different;
  double relative = std::numeric_limits<double>::infinity();
  if (here.is_number() && there.is_number()) {
    const double a = here.get<double>(), b = there.get<double>();
    relative = std::abs(a - b) / std::max(std::abs(a), std::abs(b));
  }
  if (relative <= distance.relative) return;
  distance.worst = key;
  distance.relative = relative;
  distance.here = FormatJson(here);
  distance.there = FormatJson(there);
}

/** One sentinel trial: the machines, and the shards they ran it for, by what it gave them. */
using Answers = std::map<std::string, std::map<std::string, std::set<std::string>>>;

/** That of most machines; among equals the one that the first machine by name gave. */
Answers::const_iterator FindCommonAnswer(const Answers& answers) {
  return std::max_element(answers.begin(), answers.end(), [](const auto& a, const auto& b) {
    if (a.second.size() != b.second.size()) return a.second.size() < b.second.size();
    return a.second.begin()->first > b.second.begin()->first;
  });
}

std::string DescribeDistance(const TrialRecord& trial, const Distance& distance) {
  const std::string by =
      std::isfinite(distance.relative)
          ? ", by a part of " + FormatSignificant(distance.relative, 2) + " of it"
          : "";
  return "in sentinel trial " + trial.plan.id + " (" + DescribeTrial(trial.plan) + ") " +
         std::to_string(distance.num_different) + " of " +
         FormatCount(distance.num_values, "value") + " differ, most " + distance.worst + ": " +
         distance.here + " and " + distance.there + by;
}

WorkerStart ReadStart(const Json& json) {
  WorkerStart start{
      json.at("shard").get<std::string>(), json.at("started_utc").get<std::string>(), {}, {}};
  ReadRecord(json.at("machine"), start.machine);
  for (const Json& record : json.at("sentinels")) {
    start.sentinels.push_back(
        {PlannedTrialFromJson(record), TrialResultFromJson(record.at("result"))});
  }
  return start;
}

}  // namespace

bool operator==(const Machine& a, const Machine& b) { return RecordToJson(a) == RecordToJson(b); }

std::string FormatWorkerLine(const WorkerStart& start) {
  Json json = {{"shard", start.shard},
               {"started_utc", start.started_utc},
               {"machine", RecordToJson(start.machine)},
               {"sentinels", Json::array()}};
  for (const TrialRecord& record : start.sentinels) json["sentinels"].push_back(ToJson(record));
  return FormatCheckedLine(json);
}

std::string FormatWorkerLine(const WorkerEnd& end) {
  return FormatCheckedLine(
      {{"shard", end.shard}, {"ended_utc", end.ended_utc}, {"left", end.num_left}});
}

WorkerStart ParseWorkerLine(std::string_view line) { return ReadCheckedLine(line, ReadStart); }

Workers LoadWorkers(const fs::path& folder, Diagnostics& findings) {
  Workers workers;
  std::map<std::string, std::pair<std::string, bool>> last;  // by shard: when; whether it ended
  const auto read = [&](const Json& json) {
    const bool is_end = json.contains("ended_utc");
    const auto shard = json.at("shard").get<std::string>();
    const auto when = json.at(is_end ? "ended_utc" : "started_utc").get<std::string>();
    if (!is_end) workers.starts.push_back(ReadStart(json));
    if (last[shard].first <= when) last[shard] = {when, is_end};
  };
  for (const fs::path& path : ListJournals(folder, kWorkersFolder)) {
    const std::string file = std::string(kWorkersFolder) + "/" + path.filename().string();
    ForEachLine(ReadFile(path), [&](std::string_view line, int number, bool is_whole) {
      if (!is_whole) return;  // the worker was killed, and its next start has a line
      try {
        ReadCheckedLine(line, read);
      } catch (const std::exception& e) {  // of the JSON library, or an Error
        findings.Warn(file, number, std::string("skipped: ") + e.what());
      }
    });
  }
  for (const auto& [shard, state] : last) {
    if (state.second) workers.at_rest.insert(shard);
  }
  return workers;
}

bool HasSentinels(const std::vector<WorkerStart>& starts, const Machine& machine,
                  const std::vector<PlannedTrial>& plan) {
  const std::vector<PlannedTrial> sentinels = ListSentinels(plan);
  const auto has_them = [&](const WorkerStart& start) {
    return start.machine == machine &&
           std::equal(sentinels.begin(), sentinels.end(), start.sentinels.begin(),
                      start.sentinels.end(),
                      [](const PlannedTrial& a, const TrialRecord& b) { return a == b.plan; });
  };
  return std::any_of(starts.begin(), starts.end(), has_them);
}

std::set<std::string> FindUnchecked(const fs::path& folder,
                                    const std::vector<WorkerStart>& starts) {
  std::set<std::string> checked, begun, unchecked;
  for (const WorkerStart& start : starts) {
    begun.insert(start.shard);
    if (!start.sentinels.empty()) checked.insert(DescribeMachine(start.machine));
  }
  for (const WorkerStart& start : starts) {
    if (checked.count(DescribeMachine(start.machine)) == 0) unchecked.insert(start.shard);
  }
  for (const fs::path& path : ListJournals(folder)) {
    const Shard shard = FindShardOfFile(path.filename().string());
    if (shard.count > 0 && begun.count(FormatLabel(shard)) == 0) {
      unchecked.insert(FormatLabel(shard));
    }
  }
  return unchecked;
}

std::string DescribeUnchecked(const std::set<std::string>& labels) {
  if (labels.empty()) return "";
  constexpr size_t kMaxNamed = 5;
  std::string names;
  size_t num_named = 0;
  for (const std::string& label : labels) {
    if (num_named++ < kMaxNamed) names += (names.empty() ? "" : ", ") + label;
  }
  if (labels.size() > kMaxNamed)
    names += " and " + std::to_string(labels.size() - kMaxNamed) + " more";
  return "no sentinel trials are stored for the machines of " +
         FormatCount(static_cast<int64_t>(labels.size()), "shard") + " (" + names +
         "): their agreement with the other machines is unknown";
}

std::string DescribeMachine(const Machine& machine) {
  return machine.host + " (" + machine.processor + ", flags " + machine.processor_flags + ", " +
         machine.c_library + ", build " + machine.build + ")";
}

std::vector<std::string> DescribeDifferences(const std::vector<WorkerStart>& starts) {
  std::map<std::string, Answers> answers;             // by trial
  std::map<std::string, const TrialRecord*> records;  // by what they say
  for (const WorkerStart& start : starts) {
    for (const TrialRecord& record : start.sentinels) {
      const std::string text = FormatJson(ToJson(record));
      answers[record.plan.id][text][DescribeMachine(start.machine)].insert(start.shard);
      records[text] = &record;
    }
  }
  std::map<std::string, std::pair<double, std::string>> worst;  // by machine
  for (const auto& [trial, of_trial] : answers) {
    const auto common = FindCommonAnswer(of_trial);
    for (auto answer = of_trial.begin(); answer != of_trial.end(); ++answer) {
      if (answer == common) continue;
      const TrialRecord& record = *records.at(answer->first);
      Distance distance;
      Compare(ToJson(record), ToJson(*records.at(common->first)), "", distance);
      for (const auto& [machine, shards] : answer->second) {
        auto& [relative, text] = worst.try_emplace(machine, -1.0, "").first->second;
        if (distance.relative <= relative) continue;
        relative = distance.relative;
        text = machine + ", shard " + *shards.begin() + ", disagrees with " +
               common->second.begin()->first +
               (common->second.size() > 1
                    ? " and " + FormatCount(static_cast<int64_t>(common->second.size()) - 1,
                                            "other machine")
                    : "") +
               ": " + DescribeDistance(record, distance);
      }
    }
  }
  std::vector<std::string> sentences;
  for (const auto& [machine, difference] : worst) sentences.push_back(difference.second);
  return sentences;
}

std::set<std::string> ListStartLines(const fs::path& folder) {
  Diagnostics ignored;
  std::set<std::string> lines;
  for (const WorkerStart& start : LoadWorkers(folder, ignored).starts) {
    lines.insert(FormatWorkerLine(start));
  }
  return lines;
}

std::string CollectStarts(const fs::path& other, std::set<std::string>& known) {
  Diagnostics ignored;
  std::string added;
  const auto add = [&](const WorkerStart& start) {
    const std::string line = FormatWorkerLine(start);
    if (known.insert(line).second) added += line + "\n";
  };
  const std::vector<WorkerStart> starts = LoadWorkers(other, ignored).starts;
  std::set<std::string> begun;
  for (const WorkerStart& start : starts) {
    add(start);
    begun.insert(start.shard);
  }
  for (const std::string& label : FindUnchecked(other, starts)) {
    if (begun.count(label) == 0) add({label, "", {}, {}});
  }
  return added;
}

void AppendStarts(const fs::path& folder, const std::string& lines) {
  if (lines.empty()) return;
  MakeFolder(folder / kWorkersFolder);
  AppendFile(FindJournal(folder / kWorkersFolder, 0, kMergedLabel)).Append(lines);
}

WorkerLog::WorkerLog(const fs::path& folder, const std::string& label)
    : file_([&] {
        MakeFolder(folder / kWorkersFolder);
        return AppendFile(FindJournal(folder / kWorkersFolder, 0, label),
                          "another process works on shard " + label + " of \"" + folder.string() +
                              "\"; this process is not needed");
      }()) {}

}  // namespace graspbench
