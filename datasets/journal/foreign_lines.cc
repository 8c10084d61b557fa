#include "datasets/journal/foreign_lines.h"

#include <algorithm>
#include <map>
#include <optional>
#include <string_view>
#include <utility>

#include "core/base/files/files.h"
#include "core/base/hash.h"
#include "core/base/text/json_cursor.h"
#include "datasets/journal/checked_line.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

/** Whose value is FindJournalId's in the lines of a search; older ones lack it. */
constexpr char kJournalKey[] = "search";

/** Keys and values of an object, as they are written. */
using Members = std::vector<std::pair<std::string, std::string>>;

/** With the values of the keys that the kind asks for: the others are long. */
Members ListMembers(std::string_view line, const LineKind& kind) {
  Members members;
  const auto add = [&](std::string_view key, std::string_view value) {
    const bool is_kept = key == kind.question_key || key == kJournalKey;
    members.emplace_back(key, is_kept ? value : std::string_view());
  };
  JsonCursor text(line);
  text.Demand("{");
  do {
    const std::string_view key = text.ReadPlainText();
    text.Demand(":");
    const std::string_view value = text.ReadValue();
    if (!text.has_failed()) add(key, value);
  } while (text.Take(","));
  text.Demand("}");
  if (!text.has_failed() && text.rest().empty()) return members;
  members.clear();
  const Json json = Json::try_parse(line);
  if (!json.is_object()) return members;
  for (const auto& [key, value] : json.items()) add(key, FormatJson(value));
  return members;
}

const LineKind* FindLineKind(const StoreKind& kind, const std::string& journal) {
  const auto found = std::find_if(kind.lines.begin(), kind.lines.end(), [&](const LineKind& lines) {
    return IsMatch(journal, lines.journals);
  });
  return found == kind.lines.end() ? nullptr : &*found;
}

const std::string* FindMember(const Members& members, const std::string& key) {
  const auto found = std::find_if(members.begin(), members.end(),
                                  [&](const auto& member) { return member.first == key; });
  return found == members.end() ? nullptr : &found->second;
}

bool IsOfKind(const Members& members, const LineKind& kind) {
  return !FindMember(members, kind.other_key) &&
         std::all_of(kind.keys.begin(), kind.keys.end(),
                     [&](const std::string& key) { return FindMember(members, key) != nullptr; });
}

/** Of a journal to which nothing is added any more [bytes]. */
std::optional<uintmax_t> FindLastLength(const LineKind& kind, const std::string& journal,
                                        const Manifest& manifest) {
  std::optional<uintmax_t> length;
  bool has_result = false;
  for (const ManifestFile& file : manifest.files) {
    if (file.path == journal) length = file.bytes;
    if (file.path == kind.result) has_result = true;
  }
  return has_result ? length : std::nullopt;
}

/** Of the frozen configuration, whichever program has written it. */
std::string CalcJournalId(const StoreKind& kind, const fs::path& folder,
                          const std::string& journal) {
  Json frozen = Json::try_parse(ReadFile(folder / kind.file));
  if (frozen.is_object()) frozen.erase("program_version");
  return CalcHashHex(FormatJson(Json{frozen, journal}));
}

/** Whether the frozen configuration is what it was: of a damaged one no line is judged. */
bool IsSealed(const StoreKind& kind, const fs::path& folder, const Manifest& manifest) {
  return std::any_of(manifest.files.begin(), manifest.files.end(), [&](const ManifestFile& file) {
    return file.path == kind.file && file.sha256 == SealFile(folder, kind.file).sha256;
  });
}

struct Answer {
  int line = 0;
  uint64_t hash = 0;
  bool is_told = false;  ///< that another line differs from it
};

}  // namespace

std::vector<Damage> FindForeignLines(const StoreKind& kind, const fs::path& folder,
                                     const std::string& journal, const Manifest& manifest) {
  std::vector<Damage> foreign;
  const LineKind* lines = FindLineKind(kind, journal);
  if (!lines) return foreign;
  const std::optional<uintmax_t> last_length = FindLastLength(*lines, journal, manifest);
  std::map<std::string, Answer> answers;  // by question
  const std::string id = *lines->question_key && IsSealed(kind, folder, manifest)
                             ? FormatJson(CalcJournalId(kind, folder, journal))
                             : std::string();
  bool has_ids = false;  // the lines say where they belong from here on
  ForEachLineOfFile(folder / journal, [&](const FileLine& line) {
    if (!line.is_whole || !IsCheckedLine(line.text)) return;
    if (last_length && line.start >= *last_length) {
      foreign.push_back(
          {journal, line.number, std::string("it was added after ") + lines->result + " was made"});
      return;
    }
    const Members members = ListMembers(line.text, *lines);
    if (!IsOfKind(members, *lines)) {
      foreign.push_back({journal, line.number, "it is a line of another kind of journal"});
      return;
    }
    const std::string* said = FindMember(members, kJournalKey);
    if (!id.empty() && (said ? *said != id : has_ids)) {
      foreign.push_back({journal, line.number, "it is a line of another search"});
      return;
    }
    has_ids = said;
    const std::string* question = FindMember(members, lines->question_key);
    if (!question) return;
    const uint64_t hash = CalcHash64(line.text);
    const auto [first, is_new] = answers.try_emplace(*question, Answer{line.number, hash});
    if (is_new || first->second.hash == hash) return;
    const auto add = [&](int number, int other) {
      foreign.push_back(
          {journal, number,
           "it answers question " + *question + " differently than line " + std::to_string(other)});
    };
    if (!std::exchange(first->second.is_told, true)) add(first->second.line, line.number);
    add(line.number, first->second.line);
  });
  std::stable_sort(foreign.begin(), foreign.end(),
                   [](const Damage& a, const Damage& b) { return a.line < b.line; });
  return foreign;
}

std::optional<std::string> FindJournalId(const fs::path& journal) {
  const fs::path path = fs::absolute(journal);
  for (fs::path folder = path.parent_path(); folder.has_relative_path();
       folder = folder.parent_path()) {
    const std::string name = path.lexically_relative(folder).generic_string();
    const StoreKind* kind = FindStoreKind(folder);
    if (kind && IsMatch(name, kind->journals)) return CalcJournalId(*kind, folder, name);
  }
  return std::nullopt;
}

}  // namespace graspbench
