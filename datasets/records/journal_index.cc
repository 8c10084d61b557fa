#include "datasets/records/journal_index.h"

#include <charconv>
#include <utility>
#include <vector>

#include "core/base/files/files.h"
#include "datasets/journal/checked_line.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

struct Index {
  std::string text;  // that the ids are parts of
  std::vector<std::string_view> ids;
  uintmax_t start = 0, end = 0;  // of the last record's line in the journal
};

fs::path FindIndexPath(const fs::path& journal) {
  return journal.parent_path().parent_path() / "progress" / journal.filename();
}

std::string FormatLine(std::string_view id, uintmax_t end) {
  return FormatCheckedLine({{"trial_id", id}, {"end", end}}) + "\n";
}

/** 0: none. */
uintmax_t FindEnd(std::string_view line) {
  constexpr std::string_view kKey = "\"end\":";
  const size_t key = line.find(kKey);
  uintmax_t end = 0;
  if (key != line.npos) {
    std::from_chars(line.data() + key + kKey.size(), line.data() + line.size(), end);
  }
  return end;
}

/** Whether nobody has written to the journal since, and the last record is where the index says. */
bool IsTrue(const Index& index, const fs::path& path, const fs::path& journal) {
  if (fs::last_write_time(path) < fs::last_write_time(journal)) return false;
  std::ifstream file(journal, std::ios::binary);
  std::string head(64, '\0');
  char last = '\0';
  file.seekg(static_cast<std::streamoff>(index.start));
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  file.seekg(static_cast<std::streamoff>(index.end) - 1);
  file.get(last);
  return file.good() && last == '\n' && FindTrialId(head) == index.ids.back();
}

/** Empty: there is none that is true. */
Index LoadIndex(const fs::path& journal) {
  Index index;
  std::error_code status;
  const fs::path path = FindIndexPath(journal);
  if (!fs::exists(path, status)) return index;
  index.text = ReadFile(path);
  bool is_good = true;
  ForEachLine(index.text, [&](std::string_view line, int, bool is_whole) {
    const std::string_view id = FindTrialId(line);
    const uintmax_t end = FindEnd(line);
    is_good = is_good && is_whole && !id.empty() && end > index.end && IsCheckedLine(line);
    if (!is_good) return;
    index.start = std::exchange(index.end, end);
    index.ids.push_back(id);
  });
  return index.ids.empty() || IsTrue(index, path, journal) ? std::move(index) : Index();
}

}  // namespace

std::string_view FindTrialId(std::string_view line) {
  constexpr std::string_view kHead = "{\"trial_id\":\"";
  constexpr size_t kIdLength = 16;
  if (line.substr(0, kHead.size()) != kHead) return {};
  line.remove_prefix(kHead.size());
  return line.substr(0, line.find('"')).size() == kIdLength ? line.substr(0, kIdLength)
                                                            : std::string_view();
}

int ForEachTrialOf(
    const fs::path& journal, IndexUse index_use, uintmax_t sealed,
    const std::function<void(std::string_view trial_id, std::string_view line)>& take) {
  const Index index = index_use == IndexUse::kBelieve ? LoadIndex(journal) : Index();
  for (const std::string_view id : index.ids) take(id, {});
  int num_bad = 0;
  ForEachLineOfFile(
      journal,
      [&](const FileLine& line) {
        if (line.text.empty() || !line.is_whole) return;
        const std::string_view id = FindTrialId(line.text);
        const bool is_sealed = line.start + line.text.size() < sealed;
        if (id.empty() || (!is_sealed && !IsCheckedLine(line.text))) {
          ++num_bad;
        } else {
          take(id, line.text);
        }
      },
      index.end);
  return num_bad;
}

JournalIndex::JournalIndex(const fs::path& journal) {
  const fs::path path = FindIndexPath(journal);
  const Index index = LoadIndex(journal);
  const bool is_torn = !index.text.empty() && index.text.back() != '\n';
  MakeFolder(path.parent_path());
  if (is_torn || index.end != fs::file_size(journal)) {
    std::string lines;
    ForEachLineOfFile(journal, [&](const FileLine& line) {
      const std::string_view id = FindTrialId(line.text);
      if (id.empty() || !line.is_whole || !IsCheckedLine(line.text)) return;
      lines += FormatLine(id, line.start + line.text.size() + 1);
    });
    WriteFileAtomically(path, lines);
  }
  file_.open(path, std::ios::binary | std::ios::app);
}

void JournalIndex::Append(const std::string& trial_id, uintmax_t end) {
  file_ << FormatLine(trial_id, end) << std::flush;
}

}  // namespace graspbench
