#include "tests/validation/validation_page.h"

#include <algorithm>
#include <map>

#include "core/base/text/text.h"

namespace graspbench {
namespace {

/** Text in a cell of a table: one line, no column of its own. */
std::string FormatCell(const std::string& text) {
  std::string cell;
  for (const char c : text) {
    if (c == '|') cell += '\\';
    cell += c == '\n' ? ' ' : c;
  }
  return cell;
}

bool IsStale(const ValidationRow& row, int physics_version) {
  return row.physics_version != kNoneRecorded && row.physics_version != kNotRecorded &&
         row.physics_version != std::to_string(physics_version);
}

std::string FormatMeasured(const ValidationRow& row, int physics_version) {
  std::string text = row.date == kNotRecorded ? "day not recorded" : row.date;
  if (row.physics_version == kNotRecorded) {
    text += ", physics not recorded";
  } else if (IsStale(row, physics_version)) {
    text += ", **stale: physics " + row.physics_version + "**";
  } else if (row.physics_version != kNoneRecorded) {
    text += ", physics " + row.physics_version;
  }
  text += row.program_version == kNotRecorded ? ", program not recorded"
                                              : ", program " + row.program_version;
  return text + "; " + FormatCell(row.machine);
}

std::string FormatTable(const std::vector<const ValidationRow*>& rows, int physics_version) {
  std::string text =
      "| claim | figure | interval | bar | met | command | measured |\n"
      "| --- | --- | --- | --- | --- | --- | --- |\n";
  for (const ValidationRow* row : rows) {
    const auto or_dash = [](const std::string& value) {
      return value == kNoneRecorded ? std::string("-") : FormatCell(value);
    };
    text += "| " + FormatCell(row->claim) + " | " + FormatCell(row->figure) + " | " +
            or_dash(row->interval) + " | " + or_dash(row->bar) + " | " +
            (row->met == "no" ? "**no**" : or_dash(row->met)) + " | `" + FormatCell(row->command) +
            "` | " + FormatMeasured(*row, physics_version) + " |\n";
  }
  return text;
}

}  // namespace

std::string FormatValidationPage(const std::vector<ValidationRow>& rows, int physics_version) {
  std::map<std::string, std::vector<const ValidationRow*>> topics;
  std::vector<const ValidationRow*> missed;
  int num_met = 0;
  int num_stale = 0;
  for (const ValidationRow& row : rows) {
    topics[row.topic].push_back(&row);
    if (row.met == "no") missed.push_back(&row);
    if (row.met == "yes") ++num_met;
    if (IsStale(row, physics_version)) ++num_stale;
  }
  std::string text =
      "# Validation\n\n"
      "What is measured of graspbench. Made from the rows of `validation/` by\n"
      "`cmake --build build/release --target validation`: change the rows, not this page.\n"
      "`validation/README.md` says how to add one.\n\n";
  text +=
      FormatCount(static_cast<int64_t>(rows.size()), "figure") + ", " +
      FormatCount(static_cast<int64_t>(missed.size()) + num_met, "bar") + ": " +
      std::to_string(num_met) + " met, " + std::to_string(missed.size()) +
      " not met. Physics version " + std::to_string(physics_version) + "; " +
      FormatCount(num_stale, "figure is", "figures are") +
      " stale: measured with another version. Until 2026-11-26 `tum` and `shadow` were the hands\n"
      "that are `tum-evolved` and `shadow-evolved` now, unless a row says \"developed\".\n\n";
  text += "## Bars that are not met\n\n";
  text += missed.empty() ? "None.\n" : FormatTable(missed, physics_version);
  for (const auto& [topic, of_topic] : topics) {
    text += "\n## " + topic + "\n\n" + FormatTable(of_topic, physics_version);
  }
  return text;
}

}  // namespace graspbench
