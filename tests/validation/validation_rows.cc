#include "tests/validation/validation_rows.h"

#include <algorithm>
#include <ctime>
#include <fstream>
#include <map>
#include <regex>
#include <sstream>
#include <thread>

#include "core/base/files/files.h"
#include "core/base/text/text.h"
#include "core/base/text/yaml.h"
#include "core/base/version.h"
#include "core/physics/sim_config.h"

namespace graspbench {
namespace {

struct Field {
  const char* key;
  std::string ValidationRow::*member;
};
constexpr Field kFields[] = {{"claim", &ValidationRow::claim},
                             {"figure", &ValidationRow::figure},
                             {"interval", &ValidationRow::interval},
                             {"bar", &ValidationRow::bar},
                             {"met", &ValidationRow::met},
                             {"command", &ValidationRow::command},
                             {"physics_version", &ValidationRow::physics_version},
                             {"program_version", &ValidationRow::program_version},
                             {"date", &ValidationRow::date},
                             {"machine", &ValidationRow::machine}};

struct Form {
  const char* key;
  std::string ValidationRow::*member;
  const char* pattern;
  const char* expected;
};
constexpr Form kForms[] = {
    {"met", &ValidationRow::met, "yes|no|none", "yes, no, or none where there is no bar"},
    {"physics_version", &ValidationRow::physics_version, "[1-9][0-9]*|none|not recorded",
     "a number, none (the figure does not depend on the physics) or not recorded"},
    {"program_version", &ValidationRow::program_version, "[0-9]+\\.[0-9]+\\.[0-9]+|not recorded",
     "three numbers such as 0.1.0, or not recorded"},
    {"date", &ValidationRow::date,
     "20[0-9]{2}-(0[1-9]|1[0-2])-(0[1-9]|[12][0-9]|3[01])|not recorded",
     "a day such as 2026-11-22, or not recorded"}};

int CountWords(const ValidationRow& row) {
  int count = 0;
  for (const Field& field : kFields) {
    std::istringstream stream(row.*field.member);
    for (std::string word; stream >> word;) ++count;
  }
  return count;
}

ValidationRow ReadRow(const YAML::Node& node, const std::string& file, Diagnostics& problems) {
  ValidationRow row;
  const int num_errors = problems.num_errors();
  YamlMap map(node, file, "a row", problems);
  for (const Field& field : kFields) map.Read(field.key, row.*field.member);
  map.Read("row", row.row, Needed::kNo);
  map.FinishKnownKeys();
  if (problems.num_errors() > num_errors) return row;
  for (const Field& field : kFields) {
    if ((row.*field.member).find_first_not_of(" \t\r\n") == std::string::npos) {
      map.Fail(field.key, "is empty; expected words, none or not recorded");
    }
  }
  for (const Form& form : kForms) {
    if (!std::regex_match(row.*form.member, std::regex(form.pattern))) {
      map.Fail(form.key, "\"" + row.*form.member + "\"; expected " + form.expected);
    }
  }
  if ((row.bar == kNoneRecorded) != (row.met == kNoneRecorded)) {
    map.Fail("met", row.bar == kNoneRecorded
                        ? "\"" + row.met + "\" though there is no bar; expected none"
                        : "none though there is a bar; expected yes or no");
  }
  if (const int words = CountWords(row); words > kMostValidationWords) {
    map.Fail("claim", "the row has " + std::to_string(words) + " words in all, at most " +
                          std::to_string(kMostValidationWords) +
                          " are allowed; make it a row for each figure");
  }
  return row;
}

std::string FindProcessor() {
  std::ifstream stream("/proc/cpuinfo");
  for (std::string line; std::getline(stream, line);) {
    const size_t colon = line.find(": ");
    if (line.rfind("model name", 0) == 0 && colon != std::string::npos) {
      return line.substr(colon + 2);
    }
  }
  return "processor not recorded";
}

}  // namespace

std::vector<ValidationRow> ParseValidationRows(const std::string& text, const std::string& file,
                                               Diagnostics& problems) {
  std::vector<ValidationRow> rows;
  const int num_errors = problems.num_errors();
  const YAML::Node root = ParseYaml(text, file, problems);
  if (problems.num_errors() > num_errors) return rows;
  YamlMap map(root, file, "the file", problems);
  std::string topic;
  map.Read("topic", topic);
  const YAML::Node list = map.Child("rows");
  map.FinishKnownKeys();
  if (!list.IsSequence() || list.size() == 0) {
    if (problems.num_errors() == num_errors) map.Fail("rows", "rows has no row; expected a list");
    return rows;
  }
  for (const YAML::Node& node : list) {
    rows.push_back(ReadRow(node, file, problems));
    rows.back().topic = topic;
  }
  std::map<std::string, int> lines;
  for (size_t i = 0; i < rows.size(); ++i) {
    const auto [first, is_new] = lines.emplace(rows[i].claim, LineOf(list[i]));
    if (is_new || rows[i].claim.empty()) continue;
    problems.Fail(file, LineOf(list[i]),
                  "the claim \"" + rows[i].claim + "\" stands in line " +
                      std::to_string(first->second) + " already; keep one, or say how they differ");
  }
  return rows;
}

std::vector<ValidationRow> LoadValidationRows(const std::filesystem::path& folder,
                                              Diagnostics& problems) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() == ".yaml") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  std::vector<ValidationRow> rows;
  std::map<std::string, std::string> names;
  for (const std::filesystem::path& path : files) {
    const std::string name = path.filename().string();
    for (ValidationRow& row : ParseValidationRows(ReadFile(path), name, problems)) {
      const auto [first, is_new] = names.emplace(row.claim, name);
      if (!is_new && first->second != name) {
        problems.Fail(name, 0,
                      "the claim \"" + row.claim + "\" stands in " + first->second +
                          " already; keep one, or say how they differ");
      }
      rows.push_back(std::move(row));
    }
  }
  return rows;
}

std::string FormatValidationRows(const std::vector<ValidationRow>& rows) {
  YAML::Emitter out;
  out << YAML::BeginMap << YAML::Key << "topic" << YAML::Value << rows.front().topic;
  out << YAML::Key << "rows" << YAML::Value << YAML::BeginSeq;
  for (const ValidationRow& row : rows) {
    GRASPBENCH_DEMAND(row.topic == rows.front().topic, row.topic);
    out << YAML::BeginMap;
    for (const Field& field : kFields) {
      out << YAML::Key << field.key << YAML::Value << row.*field.member;
    }
    if (row.row > 0) out << YAML::Key << "row" << YAML::Value << row.row;
    out << YAML::EndMap;
  }
  out << YAML::EndSeq << YAML::EndMap;
  return std::string(out.c_str()) + "\n";
}

void UpdateValidationFile(const std::filesystem::path& path,
                          const std::vector<ValidationRow>& measured) {
  Diagnostics problems;
  std::vector<ValidationRow> rows;
  if (std::filesystem::exists(path)) {
    rows = ParseValidationRows(ReadFile(path), path.string(), problems);
    problems.ThrowIfErrors(ErrorKind::kFormat, "rows cannot be written into this file");
  }
  for (ValidationRow row : measured) {
    const auto old = std::find_if(rows.begin(), rows.end(), [&](const ValidationRow& other) {
      return other.claim == row.claim;
    });
    if (!rows.empty()) row.topic = rows.front().topic;
    if (old == rows.end()) {
      rows.push_back(row);
    } else {
      row.row = old->row;
      *old = row;
    }
  }
  const std::string text = FormatValidationRows(rows);
  ParseValidationRows(text, path.string(), problems);
  problems.ThrowIfErrors(ErrorKind::kFormat, "the benchmark's rows are not as they should be");
  WriteFileAtomically(path, text);
}

ValidationRow MakeValidationRow(const std::string& topic, bool physics) {
  ValidationRow row;
  row.topic = topic;
  row.interval = row.bar = row.met = kNoneRecorded;
  row.physics_version = physics ? std::to_string(kPhysicsVersion) : kNoneRecorded;
  row.program_version = program_version();
  const std::time_t now = std::time(nullptr);
  char day[16] = "";
  std::strftime(day, sizeof(day), "%Y-%m-%d", std::gmtime(&now));
  row.date = day;
  row.machine = FormatCount(static_cast<int64_t>(std::thread::hardware_concurrency()), "core") +
                ", " + FindProcessor();
  return row;
}

}  // namespace graspbench
