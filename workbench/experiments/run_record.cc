#include "workbench/experiments/run_record.h"

#include <gnu/libc-version.h>
#include <unistd.h>

#include <algorithm>
#include <ctime>
#include <thread>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "core/base/hash.h"
#include "core/base/text/json.h"
#include "core/base/version.h"
#include "datasets/journal/checked_line.h"
#include "datasets/journal/manifest.h"

namespace graspbench {

namespace fs = std::filesystem;

namespace {

/** The value of a key of /proc/cpuinfo, of the first processor; empty: not there. */
std::string FindProcessorEntry(const std::string& text, std::string_view key) {
  std::string value;
  ForEachLine(text, [&](std::string_view line, int, bool) {
    const size_t colon = line.find(": ");
    if (!value.empty() || line.substr(0, key.size()) != key || colon == line.npos) return;
    value = line.substr(colon + 2);
  });
  return value;
}

}  // namespace

std::string FindHost() {
  char name[256] = "";
  ::gethostname(name, sizeof name - 1);
  return name;
}

const std::string& FindBuild() {
  static const std::string build = CalcHashHex(ReadFile("/proc/self/exe"));
  return build;
}

Machine FindMachine() {
  const std::string processors = ReadFile("/proc/cpuinfo");
  std::string model = FindProcessorEntry(processors, "model name");
  std::string flags = FindProcessorEntry(processors, "flags");
  if (model.empty()) model = FindProcessorEntry(processors, "CPU part");  // of ARM
  if (flags.empty()) flags = FindProcessorEntry(processors, "Features");
  return {FindHost(),         model.empty() ? "unknown processor" : model,
          CalcHashHex(flags), std::string("glibc ") + ::gnu_get_libc_version(),
          FindBuild(),        program_version()};
}

int CountProcessors() { return std::max(1, static_cast<int>(std::thread::hardware_concurrency())); }

namespace {

Json LoadRuns(const fs::path& folder) {
  try {
    const Json runs = Json::parse(ReadFile(folder / "run.json")).at("runs");
    if (runs.is_array()) return runs;
  } catch (const Error&) {
    RethrowUnlessDamage(folder / "run.json");  // else the runs before this one would be lost
  } catch (const Json::exception&) {
  }
  return Json::array();
}

}  // namespace

std::string FormatUtcNow() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  ::gmtime_r(&now, &parts);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text;
}

void AppendRunRecord(const fs::path& folder, const RunRecord& record) {
  Json runs = LoadRuns(folder);
  runs.push_back({{"started_utc", record.started_utc},
                  {"duration_s", record.duration},
                  {"host", FindHost()},
                  {"program_version", program_version()},
                  {"build", FindBuild()},
                  {"workers", record.num_workers},
                  {"trials", record.num_trials},
                  {"ending", RowOf(kRunEndings, record.ending).name}});
  WriteFileAtomically(folder / "run.json", FormatJson(Json{{"runs", runs}}, 2) + "\n");
}

RunRecorder::RunRecorder(fs::path folder, int num_workers, Observer& observer)
    : Observer(observer.stop()), folder_(std::move(folder)), observer_(observer) {
  record_.started_utc = FormatUtcNow();
  record_.num_workers = num_workers;
}

RunRecord RunRecorder::Keep(bool is_complete) {
  record_.duration =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  record_.ending = is_complete ? RunEnding::kFinished : RunEnding::kInterrupted;
  AppendRunRecord(folder_, record_);
  return record_;
}

void RecordPlanning(const fs::path& folder) {
  RunRecord record;
  record.started_utc = FormatUtcNow();
  record.ending = RunEnding::kPlanned;
  AppendRunRecord(folder, record);
}

std::vector<std::string> ListBuilds(const fs::path& folder) {
  std::vector<std::string> builds;
  for (const Json& run : LoadRuns(folder)) {
    if (!run.is_object() || !run.contains("build") || !run["build"].is_string()) continue;
    builds.push_back(run["build"].get<std::string>());
  }
  return builds;
}

bool HasRunOfAnotherBuild(const fs::path& folder) {
  const std::vector<std::string> builds = ListBuilds(folder);
  return std::any_of(builds.begin(), builds.end(),
                     [](const std::string& build) { return build != FindBuild(); });
}

}  // namespace graspbench
