#include "datasets/campaign/real_trials.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "core/base/files/files.h"
#include "core/base/text/delimited_text.h"
#include "core/base/text/text.h"
#include "datasets/journal/sealed_store.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

constexpr char kFolder[] = "real", kFile[] = "trials.csv";
constexpr double kLongestTime = 30.0;  ///< of a closure; what is longer has another unit [s]

/** The digit of a column "t_TH_s"; empty for any other. */
std::string DigitOfColumn(const std::string& column) {
  const size_t size = column.size();
  const bool is_one =
      size > 4 && column.compare(0, 2, "t_") == 0 && column.compare(size - 2, 2, "_s") == 0;
  return is_one ? column.substr(2, size - 4) : "";
}

class RealTable {
 public:
  RealTable(const std::string& text, const std::string& file, Diagnostics& problems)
      : table_(text, file, problems), problems_(problems) {
    for (const char* column : {"hand", "object", "variant", "trial", "success"}) {
      table_.Require(column);
    }
    static const std::set<std::string> kKnown = {"hand",  "object",  "variant",
                                                 "trial", "success", "note"};
    for (const std::string& column : table_.columns()) {
      const std::string digit = DigitOfColumn(column);
      if (!digit.empty()) digits_.push_back(digit);
      if (digit.empty() && kKnown.count(column) == 0) {
        Fail(1, "unknown column \"" + column +
                    "\"; expected hand, object, variant, trial, success, note and, per digit, a "
                    "column such as t_TH_s with its first contact in seconds");
      }
    }
  }

  std::vector<RealTrial> Read() {
    std::vector<RealTrial> trials;
    std::set<std::tuple<std::string, std::string, int, int>> seen;
    for (size_t row = 0; row < table_.num_rows(); ++row) {
      RealTrial trial = ReadRow(row);
      if (!seen.insert({trial.hand, trial.object, trial.variant, trial.trial}).second) {
        Fail(trial.line, "hand, object, variant and trial equal those of an earlier row");
      }
      if (!table_.Text(row, "success").empty()) trials.push_back(std::move(trial));
    }
    return trials;
  }

 private:
  void Fail(int line, const std::string& text) { problems_.Fail(table_.file(), line, text); }

  RealTrial ReadRow(size_t row) {
    RealTrial trial;
    trial.line = table_.LineOfRow(row);
    trial.hand = table_.Text(row, "hand");
    trial.object = table_.Text(row, "object");
    trial.variant = ReadVariant(row);
    const double number = table_.Number(row, "trial");
    trial.trial = number >= 0.0 && number <= 1e6 ? static_cast<int>(number) : -1;
    if (trial.trial < 0 || trial.trial != number) {
      Fail(trial.line, "trial \"" + table_.Text(row, "trial") + "\"; expected 0, 1, 2, ..");
    }
    trial.is_success = ReadSuccess(row);
    trial.is_made_up = ToLower(table_.Text(row, "note")).find("made up") != std::string::npos;
    for (const std::string& digit : digits_) {
      const double time = table_.Number(row, "t_" + digit + "_s");
      if (std::abs(time) > kLongestTime) {
        Fail(trial.line, "t_" + digit + "_s is " + table_.Text(row, "t_" + digit + "_s") +
                             "; expected seconds since the start of closure, at most " +
                             FormatFixed(kLongestTime, 0) + "; are these milliseconds?");
      }
      trial.contacts.push_back({digit, false, time});
    }
    return trial;
  }

  Variant ReadVariant(size_t row) {
    const std::string& text = table_.Text(row, "variant");
    std::vector<std::string> names;
    for (const VariantRow& variant : kVariants) {
      if (text == variant.name) return variant.value;
      names.push_back(variant.name);
    }
    Fail(table_.LineOfRow(row), "no variant \"" + text + "\"" + SuggestNames(text, names));
    return kStandardGrasp;
  }

  bool ReadSuccess(size_t row) {
    const std::string text = ToLower(table_.Text(row, "success"));
    if (text == "1" || text == "yes") return true;
    if (text != "0" && text != "no" && !text.empty()) {
      Fail(table_.LineOfRow(row), "success is \"" + table_.Text(row, "success") +
                                      "\"; expected 1 or yes, 0 or no, or nothing where the trial "
                                      "was not done");
    }
    return false;
  }

  DataTable table_;
  Diagnostics& problems_;
  std::vector<std::string> digits_;
};

fs::path FindPublished(const char* file) { return FindDataRoot() / "datasets" / kFolder / file; }

}  // namespace

std::vector<RealTrial> ReadRealTrials(const std::string& text, const std::string& file,
                                      Diagnostics& problems) {
  return RealTable(text, file, problems).Read();
}

void CheckRealTrials(const std::vector<RealTrial>& trials, const std::string& file,
                     const SessionInputs& inputs, Diagnostics& problems) {
  std::map<std::string, std::vector<std::string>> digits;
  std::vector<std::string> hands, objects;
  for (const SessionHand& hand : inputs.hands) {
    hands.push_back(hand.hand->id);
    for (const Digit& digit : hand.hand->digits) digits[hand.hand->id].push_back(digit.id);
  }
  for (const auto& object : inputs.objects) objects.push_back(object->id);
  std::set<std::string> told;  // each fault once, at its first line
  const auto check = [&](const RealTrial& trial, const std::string& what, const std::string& name,
                         const std::vector<std::string>& known) {
    if (std::find(known.begin(), known.end(), name) != known.end()) return;
    const std::string text = what + " \"" + name + "\"" + SuggestNames(name, known);
    if (told.insert(text).second) problems.Fail(file, trial.line, text);
  };
  for (const RealTrial& trial : trials) {
    check(trial, "this campaign has no hand", trial.hand, hands);
    check(trial, "this campaign has no object", trial.object, objects);
    if (digits.count(trial.hand) == 0) continue;
    for (const DigitContact& contact : trial.contacts) {
      if (std::isnan(contact.time)) continue;  // the column is another hand's
      check(trial, "the hand \"" + trial.hand + "\" has no digit", contact.digit,
            digits[trial.hand]);
    }
  }
}

void KeepRealTrials(const fs::path& campaign, const std::string& text) {
  const fs::path folder = campaign / kFolder;
  MakeFolder(folder);
  UnsealOutput(folder);
  WriteFile(folder / kFile, text);
  SealOutput(folder, {kFile}, {});  // made from nothing that is here
}

std::vector<RealTrial> LoadRealTrials(const fs::path& campaign) {
  const fs::path path = campaign / kFolder / kFile;
  if (!fs::exists(path)) return {};
  Diagnostics problems;
  std::vector<RealTrial> trials = ReadRealTrials(ReadFile(path), path.string(), problems);
  problems.ThrowIfErrors(ErrorKind::kFormat, "the laboratory's trials cannot be read");
  return trials;
}

std::vector<RealTrial> LoadPublishedTrials(const std::vector<RealScene>& scenes) {
  const fs::path path = FindPublished(kFile);
  Diagnostics problems;
  std::vector<RealTrial> trials;
  for (RealTrial& trial : ReadRealTrials(ReadFile(path), path.string(), problems)) {
    const RealScene scene = {trial.hand, trial.object};
    if (std::find(scenes.begin(), scenes.end(), scene) == scenes.end()) continue;
    trial.is_published = true;
    trials.push_back(std::move(trial));
  }
  problems.ThrowIfErrors(ErrorKind::kFormat, "the published trials cannot be read");
  return trials;
}

std::vector<PublishedFigure> LoadPublishedFigures() {
  const fs::path path = FindPublished("figures.csv");
  Diagnostics problems;
  DataTable table(ReadFile(path), path.string(), problems);
  for (const char* column : {"hand", "figure", "value", "unit", "source"}) table.Require(column);
  std::vector<PublishedFigure> figures;
  for (size_t row = 0; row < table.num_rows(); ++row) {
    figures.push_back({table.Text(row, "hand"), table.Text(row, "figure"),
                       table.Number(row, "value"), table.Text(row, "unit"),
                       table.Text(row, "source")});
  }
  problems.ThrowIfErrors(ErrorKind::kFormat, "the published figures cannot be read");
  return figures;
}

}  // namespace graspbench
