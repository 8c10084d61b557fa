#include "datasets/journal/read_journal.h"

#include <algorithm>
#include <map>
#include <new>
#include <string_view>
#include <utility>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "core/base/hash.h"
#include "core/base/text/json_cursor.h"
#include "datasets/journal/append_file.h"

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

/** Of the frozen configuration, whichever program has written it. */
std::string CalcJournalId(const StoreKind& kind, const fs::path& folder,
                          const std::string& journal) {
  Json frozen = Json::try_parse(ReadFile(folder / kind.file));
  if (frozen.is_object()) frozen.erase("program_version");
  return CalcHashHex(FormatJson(Json{frozen, journal}));
}

/** Whether the frozen configuration is what it was: of a damaged one no line is judged. */
bool IsSealed(const StoreKind& kind, const fs::path& folder, const Manifest& manifest) {
  const ManifestFile* sealed = manifest.Find(kind.file);
  return sealed && sealed->sha256 == SealFile(folder, kind.file).sha256;
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
  // Of a search that has its result, to whose journal nothing is added any more.
  const ManifestFile* const sealed =
      manifest.Find(lines->result) ? manifest.Find(journal) : nullptr;
  std::map<std::string, Answer> answers;  // by question
  const std::string id = *lines->question_key && IsSealed(kind, folder, manifest)
                             ? FormatJson(CalcJournalId(kind, folder, journal))
                             : std::string();
  bool has_ids = false;  // the lines say where they belong from here on
  ForEachLineOfFile(folder / journal, [&](const FileLine& line) {
    if (!line.is_whole || !IsCheckedLine(line.text)) return;
    if (sealed && line.start >= sealed->bytes) {
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

std::vector<fs::path> ListJournals(const fs::path& folder, const std::string& subfolder) {
  std::vector<fs::path> paths;
  std::error_code status;
  for (const auto& entry : fs::directory_iterator(folder / subfolder, status)) {
    if (entry.path().extension() == ".jsonl") paths.push_back(entry.path());
  }
  if (status && status != std::errc::no_such_file_or_directory) {
    throw Error(ErrorKind::kIo, "cannot read folder \"" + (folder / subfolder).string() +
                                    "\": " + status.message());
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

fs::path FindJournal(const fs::path& subfolder, int worker, const std::string& label) {
  const std::string name = (label.empty() ? "" : label + "-") + std::to_string(worker);
  fs::path path = subfolder / (name + ".jsonl");
  for (int number = 2; !label.empty() && EndsInTornLine(path); ++number) {
    path = subfolder / (name + "-" + std::to_string(number) + ".jsonl");
  }
  return path;
}

void ReadJournal(const std::filesystem::path& folder, const std::string& journal,
                 const std::function<void(const FileLine&)>& take, Diagnostics& findings,
                 std::vector<Damage>& damage) {
  ForEachLineOfFile(folder / journal, [&](const FileLine& line) {
    if (line.text.empty()) return;
    if (!line.is_whole) {
      findings.Warn(journal, line.number,
                    "the last line is incomplete because the program was stopped; it is ignored");
      return;
    }
    try {
      take(line);
    } catch (const std::bad_alloc&) {  // of the machine, not of the line
      throw;
    } catch (const std::exception& e) {  // of the JSON library, or an Error of a value
      if (IsCheckedLine(line.text)) {
        damage.push_back({journal, line.number, e.what()});
      } else {
        findings.Warn(journal, line.number,
                      std::string("skipped: ") + e.what() + "; it is ignored");
      }
    }
  });
}

void RefuseDamage(const std::string& store, const std::filesystem::path& folder,
                  const std::vector<Damage>& damage, OnDamage on_damage,
                  const std::string& remedy) {
  if (damage.empty() || on_damage == OnDamage::kAccept) return;
  throw Error(ErrorKind::kFormat, store + " in \"" + folder.string() + "\" contains foreign lines" +
                                      FormatDamage(damage) + "\n" + remedy);
}

}  // namespace graspbench
