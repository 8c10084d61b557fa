#include "workbench/text/glossary.h"

#include <algorithm>
#include <sstream>

#include "core/base/text/text.h"

namespace graspbench {
namespace {

std::string Trim(std::string_view text) {
  const size_t begin = text.find_first_not_of(" `");
  if (begin == text.npos) return {};
  return std::string(text.substr(begin, text.find_last_not_of(" `") - begin + 1));
}

/** "a, b (c)" has the words "a" and "b". */
std::vector<std::string> SplitWords(const std::string& text) {
  std::vector<std::string> words;
  std::istringstream parts(text);
  for (std::string part; std::getline(parts, part, ',');) {
    const std::string word = Trim(part.substr(0, part.find('(')));
    if (!word.empty() && word != "-") words.push_back(word);
  }
  return words;
}

/** The rows of its table: | measure | column | meaning |. */
std::vector<GlossaryEntry> ReadGlossary() {
  std::vector<GlossaryEntry> entries;
  std::istringstream lines{std::string(assets::kGlossaryMd)};
  bool is_table = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("| ---", 0) == 0) {
      is_table = true;
      continue;
    }
    if (line.rfind("| ", 0) != 0) is_table = false;
    if (!is_table) continue;
    const size_t second = line.find(" | ", 2), third = line.find(" | ", second + 3);
    GlossaryEntry entry = {Trim(line.substr(2, second - 2)),
                           line.substr(second + 3, third - second - 3),
                           Trim(line.substr(third + 3, line.rfind('|') - third - 3))};
    for (std::string* text : {&entry.columns, &entry.meaning}) {
      text->erase(std::remove(text->begin(), text->end(), '`'), text->end());
    }
    if (entry.columns == "-") entry.columns.clear();
    entries.push_back(entry);
  }
  return entries;
}

std::vector<std::string> ListWords(const GlossaryEntry& entry) {
  std::vector<std::string> words = SplitWords(entry.term);
  for (const std::string& column : SplitWords(entry.columns)) words.push_back(column);
  return words;
}

}  // namespace

std::vector<GlossaryEntry> FindInGlossary(std::string_view word) {
  const std::string wanted = ToLower(word);
  std::vector<GlossaryEntry> found;
  for (const GlossaryEntry& entry : ReadGlossary()) {
    const std::vector<std::string> words = ListWords(entry);
    if (ToLower(entry.term) == wanted ||
        std::any_of(words.begin(), words.end(),
                    [&](const std::string& each) { return ToLower(each) == wanted; })) {
      found.push_back(entry);
    }
  }
  return found;
}

std::vector<std::string> ListGlossaryWords() {
  std::vector<std::string> all;
  for (const GlossaryEntry& entry : ReadGlossary()) {
    for (const std::string& word : ListWords(entry)) all.push_back(word);
  }
  return all;
}

std::string FormatGlossary(const std::vector<GlossaryEntry>& entries) {
  std::string text;
  for (const GlossaryEntry& entry : entries) {
    text += (text.empty() ? "" : "\n") + entry.term + "\n  " + entry.meaning + "\n";
    if (!entry.columns.empty()) text += "  columns: " + entry.columns + "\n";
  }
  return text;
}

}  // namespace graspbench
