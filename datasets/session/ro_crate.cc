#include "datasets/session/ro_crate.h"

#include <utility>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "core/base/text/json.h"
#include "core/base/version.h"
#include "core/physics/sim_config.h"
#include "core/trial/judge/judgement.h"
#include "datasets/journal/checked_line.h"

namespace graspbench {

namespace fs = std::filesystem;

ManifestOrigin MakeOrigin(const std::string& command) {
  return {command,
          {{"program", program_version()},
           {"commit", program_commit()},
           {"physics", kPhysicsVersion},
           {"judge", kJudgeVersion}},
          {}};
}

ManifestOrigin MakeOutputOrigin(const std::filesystem::path& folder, const std::string& command,
                                const std::vector<std::string>& only) {
  ManifestOrigin origin = MakeOrigin(command);
  const StoreKind* kind = FindStoreKind(folder);
  if (!kind) return origin;
  for (const ManifestSource& source : ListSources(*kind, folder, only)) {
    origin.inputs.push_back({"../" + source.path, source.sha256});
  }
  return origin;
}

namespace {

constexpr char kProgram[] = "#graspbench";
constexpr char kProfile[] = "https://w3id.org/ro/wfrun/process/0.5";

Json Refer(const std::string& id) { return {{"@id", id}}; }

Json MakeFile(const std::string& id, const ManifestFile& file, const std::string& form) {
  return {{"@id", id},
          {"@type", "File"},
          {"name", fs::path(id).filename().string()},
          {"encodingFormat", form},
          {"contentSize", std::to_string(file.bytes)},
          {"sha256", file.sha256}};
}

std::string FindForm(const std::string& name) {
  const std::string ending = fs::path(name).extension().string();
  if (ending == ".csv") return "text/csv";
  if (ending == ".json") return "application/json";
  if (ending == ".jsonl") return "application/jsonl";
  return ending == ".sqlite" ? "application/vnd.sqlite3" : "application/octet-stream";
}

/** The runs of run.json, which everybody who wants them has. */
Json LoadRuns(const fs::path& folder) {
  const Json runs = Json::parse(ReadFile(folder / "run.json")).at("runs");
  if (runs.empty()) throw Error(ErrorKind::kFormat, "run.json holds no run");
  return runs;
}

/** Several journals are one collection, by their content. */
Json MakeRecords(const fs::path& folder) {
  return {
      {"@id", "journal/"},
      {"@type", "Dataset"},
      {"name", "records of the finished trials"},
      {"description", "one JSON line a trial; identifier: SHA-256 of the lines, see manifest.h"},
      {"identifier", CalcJournalSha256(folder, "journal/*.jsonl")}};
}

/** What runs a session with conditions, and one without. */
std::string FindCommand(const fs::path& folder) {
  const Json config = Json::parse(ReadFile(folder / "session.json")).at("config");
  return config.contains("conditions") ? "graspbench sweep" : "graspbench run";
}

Json MakeRun(const Json& run, const std::string& command, size_t number) {
  Json action = {{"@id", "#run-" + std::to_string(number)},
                 {"@type", "CreateAction"},
                 {"name", command},
                 {"instrument", Refer(kProgram)},
                 {"object", {Refer("session.json"), Refer("plan.jsonl")}},
                 {"result", Refer("journal/")},
                 {"startTime", run.at("started_utc")},
                 {"description", FormatJson(run.at("trials")) + " trials, " +
                                     run.at("ending").get<std::string>() + ", by build " +
                                     run.at("build").get<std::string>()}};
  return action;
}

Json MakeProgram(const ManifestOrigin& origin) {
  return {{"@id", kProgram},
          {"@type", "SoftwareApplication"},
          {"name", "graspbench"},
          {"softwareVersion", origin.versions.at("program")},
          {"description", "commit " + origin.versions.at("commit").get<std::string>() +
                              ", physics " + FormatJson(origin.versions.at("physics"))}};
}

Json MakeRoot(const Json& parts, const Json& actions, const Json& date) {
  return {{"@id", "./"},
          {"@type", "Dataset"},
          {"name", "Session of simulated grasps"},
          {"description", "Configuration, plan and records of simulated grasp trials"},
          {"datePublished", date},
          {"license", "not stated"},
          {"conformsTo", Refer(kProfile)},
          {"hasPart", parts},
          {"mentions", actions}};
}

Json MakeCrate(const fs::path& folder) {
  const Json runs = LoadRuns(folder);
  const Manifest exported = LoadManifest(folder / "export");
  const ManifestOrigin origin = exported.origin.value_or(MakeOrigin("graspbench export ."));
  Json graph = Json::array(), parts = Json::array(), actions = Json::array(),
       tables = Json::array();
  const auto add = [&graph](Json entity, Json& list) {
    list.push_back(Refer(entity.at("@id").str()));
    graph.push_back(std::move(entity));
  };
  graph.push_back({{"@id", "ro-crate-metadata.json"},
                   {"@type", "CreativeWork"},
                   {"conformsTo", Refer("https://w3id.org/ro/crate/1.1")},
                   {"about", Refer("./")}});
  for (const char* name : {"session.json", "plan.jsonl"}) {
    add(MakeFile(name, SealFile(folder, name), FindForm(name)), parts);
  }
  add(MakeRecords(folder), parts);
  for (const ManifestFile& file : exported.files) {
    const std::string id = (fs::path("export") / file.path).lexically_normal().generic_string();
    tables.push_back(Refer(id));
    add(MakeFile(id, file, FindForm(id)), parts);
  }
  const std::string command = FindCommand(folder);
  for (const Json& run : runs) add(MakeRun(run, command, actions.size()), actions);
  add({{"@id", "#export"},
       {"@type", "CreateAction"},
       {"name", origin.command},
       {"instrument", Refer(kProgram)},
       {"object", {Refer("session.json"), Refer("journal/")}},
       {"result", tables}},
      actions);
  graph.push_back(MakeProgram(origin));
  graph.push_back({{"@id", kProfile},
                   {"@type", "CreativeWork"},
                   {"name", "Process Run Crate"},
                   {"version", "0.5"}});
  graph.push_back(MakeRoot(parts, actions, runs.back().at("started_utc")));
  return {{"@context", "https://w3id.org/ro/crate/1.1/context"}, {"@graph", graph}};
}

}  // namespace

std::string FormatRoCrate(const fs::path& folder) {
  try {
    return FormatJson(MakeCrate(folder), 2) + "\n";
  } catch (const Json::exception& e) {
    throw Error(ErrorKind::kFormat, "run.json or export/manifest.json in \"" + folder.string() +
                                        "\" is damaged: " + DescribeJsonFault(e));
  }
}

}  // namespace graspbench
