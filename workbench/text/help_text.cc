#include "workbench/text/help_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "core/base/config.h"
#include "core/base/text/text.h"
#include "core/grasp/standard_grasp.h"
#include "datasets/plan/session_config.h"
#include "human_study/study/run/trial_removal.h"

namespace graspbench {
namespace {

/** What several files say of a key, or several tables of a column. */
template <class Row>
struct Explained {
  Row row;
  std::vector<std::string> files;
};

template <class Row>
void Add(const Row& row, const std::string& file, std::vector<Explained<Row>>& found,
         bool (*are_equal)(const Row&, const Row&)) {
  for (Explained<Row>& each : found) {
    if (are_equal(each.row, row)) return each.files.push_back(file);
  }
  found.push_back({row, {file}});
}

/** In files that people write; where none of these has it, in those that stores freeze. */
std::vector<Explained<FileKey>> FindKeys(const std::string& key, bool is_frozen = false) {
  std::vector<Explained<FileKey>> found;
  for (const FileFormat& format : ListFileFormats()) {
    const FileKey* row = FindFileKey(format.keys, key);
    if (row == nullptr || format.is_frozen != is_frozen) continue;
    Add<FileKey>(*row, format.name, found, [](const FileKey& a, const FileKey& b) {
      return a.fallback == b.fallback && a.meaning == b.meaning && FormatRange(a) == FormatRange(b);
    });
  }
  return found.empty() && !is_frozen ? FindKeys(key, true) : found;
}

/** Those of this very name, else those whose word in capitals the name fits. */
std::vector<Explained<TableColumn>> FindColumns(const std::string& name) {
  std::vector<Explained<TableColumn>> exact, fitting;
  for (const TableFormat& table : ListTableFormats()) {
    for (const TableColumn& column : table.columns) {
      if (!IsNameOf(column, name)) continue;
      Add<TableColumn>(column, table.name, column.name == name ? exact : fitting,
                       [](const TableColumn& a, const TableColumn& b) {
                         return a.unit == b.unit && a.type == b.type && a.meaning == b.meaning;
                       });
    }
  }
  return exact.empty() ? fitting : exact;
}

/** A heading, its meaning, and lines below them, without those that have no value. */
std::string FormatWord(const std::string& word, const std::string& meaning,
                       const std::vector<std::pair<const char*, std::string>>& lines) {
  std::string text = word + "\n  " + meaning + "\n";
  for (const auto& [heading, value] : lines) {
    if (!value.empty()) text += fmt::format("  {:<8} {}\n", heading, value);
  }
  return text;
}

std::string FormatKey(const Explained<FileKey>& key) {
  const FileKey& row = key.row;
  const std::string unit = FindUnit(row.key), range = FormatRange(row);
  const std::vector<std::string> settings = ListConfigKeys(SessionConfig());
  const auto has = [](const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  const bool is_setting = has(key.files, "session.yaml") && has(settings, row.key);
  return FormatWord(row.key, row.meaning,
                    {{"unit", unit.empty() && !range.empty() ? "none" : unit},
                     {"range", range},
                     {"default", row.fallback == kRequired ? "none, required"
                                 : row.fallback.empty()    ? "none; optional"
                                                           : row.fallback},
                     {key.files.front().find(".json") == std::string::npos ? "set in" : "kept in",
                      fmt::format("{}", fmt::join(key.files, ", "))},
                     {"or by", is_setting ? "graspbench run --set " + row.key + "=VALUE" : ""}});
}

std::string Trim(std::string_view text) {
  const size_t begin = text.find_first_not_of(" `");
  if (begin == text.npos) return {};
  return std::string(text.substr(begin, text.find_last_not_of(" `") - begin + 1));
}

/** "a, b (c)" has the words "a" and "b". */
std::vector<std::string> SplitAlternatives(const std::string& text) {
  std::vector<std::string> words;
  std::istringstream parts(text);
  for (std::string part; std::getline(parts, part, ',');) {
    const std::string word = Trim(part.substr(0, part.find('(')));
    if (!word.empty() && word != "-") words.push_back(word);
  }
  return words;
}

bool Has(const GlossaryEntry& entry, const std::string& word) {
  std::vector<std::string> names = SplitAlternatives(entry.term);
  names.push_back(entry.term);
  names.insert(names.end(), entry.columns.begin(), entry.columns.end());
  return std::any_of(names.begin(), names.end(),
                     [&](const std::string& name) { return ToLower(name) == ToLower(word); });
}

}  // namespace

const std::vector<GlossaryEntry>& ListGlossary() {
  static const std::vector<GlossaryEntry> glossary = [] {
    std::vector<GlossaryEntry> entries;
    std::istringstream lines{std::string(assets::kGlossaryMd)};
    bool is_table = false;  // | measure | column | meaning |
    for (std::string line; std::getline(lines, line);) {
      const bool is_row = line.rfind("| ", 0) == 0;
      if (is_table && is_row) {
        const size_t second = line.find(" | ", 2), third = line.find(" | ", second + 3);
        std::string meaning = Trim(line.substr(third + 3, line.rfind('|') - third - 3));
        meaning.erase(std::remove(meaning.begin(), meaning.end(), '`'), meaning.end());
        entries.push_back({Trim(line.substr(2, second - 2)),
                           SplitAlternatives(line.substr(second + 3, third - second - 3)),
                           meaning});
      }
      is_table = line.rfind("| ---", 0) == 0 || (is_table && is_row);
    }
    return entries;
  }();
  return glossary;
}

const GlossaryEntry* FindGlossaryEntry(const std::string& term) {
  for (const GlossaryEntry& entry : ListGlossary()) {
    if (entry.term == term) return &entry;
  }
  return nullptr;
}

std::string ExplainFileKey(const std::string& key) {
  std::string text;
  for (const auto& each : FindKeys(key)) text += FormatKey(each);
  return text;
}

std::string ExplainWord(const std::string& word) {
  std::string text;
  for (const GlossaryEntry& entry : ListGlossary()) {
    if (!Has(entry, word)) continue;
    text += FormatWord(entry.term, entry.meaning,
                       {{"columns", fmt::format("{}", fmt::join(entry.columns, ", "))}});
  }
  for (const auto& [column, files] : FindColumns(word)) {
    text += FormatWord(column.name, column.meaning,
                       {{"unit", column.unit},
                        {"type", column.type},
                        {"in", fmt::format("{}", fmt::join(files, ", "))}});
  }
  for (const GraspTaxon& taxon : ListGraspTaxa()) {
    if (taxon.id == word) {
      text +=
          FormatWord(word, "standard grasp: " + taxon.name,
                     {{"more", "graspbench help grasp-types; graspbench hand show HAND --grasps"}});
    }
  }
  for (const Preset& preset : ListPresets()) {
    if (preset.name == word) {
      text += FormatWord(word, preset.about, {{"set by", "graspbench run --preset " + word}});
    }
  }
  for (const TrialFlag& flag : TrialFlagList()) {
    if (flag.name == word) text += FormatWord(word, flag.text, {{"in", "warnings of a study"}});
  }
  const RemovalAdvice& removal = FindRemovalAdvice(word);
  if (!word.empty() && removal.code == word) {
    text += FormatWord(word, "reason to remove a trial of a study",
                       {{"keys", removal.keys}, {"in", "removed_code of trials.csv"}});
  }
  return text + ExplainFileKey(word);
}

std::string SuggestWords(const std::string& misspelt, std::vector<std::string> names) {
  for (const GlossaryEntry& entry : ListGlossary()) {
    for (const std::string& term : SplitAlternatives(entry.term)) names.push_back(term);
  }
  for (const TableFormat& table : ListTableFormats()) {
    for (const TableColumn& column : table.columns) names.push_back(column.name);
  }
  for (const TrialFlag& flag : TrialFlagList()) names.push_back(flag.name);
  for (const FileFormat& format : ListFileFormats()) {
    for (const FileKey& row : format.keys) {
      if (row.key.substr(row.key.rfind('.') + 1) == misspelt) {
        return "; did you mean \"" + row.key + "\"?";
      }
      names.push_back(row.key);
    }
  }
  constexpr size_t kShortest = 4, kMostNamed = 3;
  const std::string near = SuggestNames(misspelt, names);
  if (misspelt.size() < kShortest || near.find("did you mean") != std::string::npos) return near;
  std::vector<std::string> longer;
  for (const std::string& name : names) {
    const bool is_known = std::find(longer.begin(), longer.end(), name) != longer.end();
    if (name.find(misspelt) != std::string::npos && !is_known) longer.push_back(name);
  }
  if (longer.empty()) return near;
  longer.resize(std::min(longer.size(), kMostNamed));
  return fmt::format("; did you mean {}?", fmt::join(longer, ", "));
}

std::string FormatTableColumns(const TableFormat& table) {
  std::string text;
  for (const TableColumn& column : table.columns) {
    const std::string unit = column.unit.empty() ? "" : " [" + column.unit + "]";
    text +=
        fmt::format("  {:<38} {}{}\n      {}\n", column.name, column.type, unit, column.meaning);
  }
  return text;
}

Json MakeFormatJson(const FileFormat& format) {
  Json keys = Json::array();
  for (const FileKey& key : format.keys) {
    keys.push_back({{"key", key.key},
                    {"unit", FindUnit(key.key)},
                    {"range", FormatRange(key)},
                    {"required", key.fallback == kRequired},
                    {"default", key.fallback == kRequired ? "" : key.fallback},
                    {"meaning", key.meaning}});
  }
  return {{"file", format.name}, {"about", format.about}, {"keys", keys}};
}

Json MakeTableJson(const TableFormat& table) {
  Json columns = Json::array();
  for (const TableColumn& column : table.columns) {
    columns.push_back({{"column", column.name},
                       {"type", column.type},
                       {"unit", column.unit},
                       {"meaning", column.meaning}});
  }
  return {{"file", table.name}, {"about", table.about}, {"columns", columns}};
}

}  // namespace graspbench
