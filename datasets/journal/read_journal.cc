#include "datasets/journal/read_journal.h"

#include <new>

#include "core/base/error.h"

namespace graspbench {

void ReadJournal(const std::filesystem::path& folder, const std::string& journal,
                 const std::function<void(const FileLine&)>& take, Diagnostics& findings,
                 std::vector<Damage>& damage) {
  ForEachLineOfFile(folder / journal, [&](const FileLine& line) {
    if (line.text.empty()) return;
    if (!line.is_whole) {
      findings.Warn(journal, line.number,
                    "the last line was not finished when the program stopped; it counts as not "
                    "there");
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
                      std::string("skipped: ") + e.what() + "; it counts as not there");
      }
    }
  });
}

void RefuseDamage(const std::string& store, const std::filesystem::path& folder,
                  const std::vector<Damage>& damage, OnDamage on_damage,
                  const std::string& remedy) {
  if (damage.empty() || on_damage == OnDamage::kAccept) return;
  throw Error(ErrorKind::kFormat, store + " in \"" + folder.string() +
                                      "\" holds what is not its own" + FormatDamage(damage) + "\n" +
                                      remedy);
}

}  // namespace graspbench
