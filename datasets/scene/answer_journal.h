#pragma once
/** @file
The journal of a search. The search is deterministic: the same answers lead to the same questions.
It is therefore resumed by repeating it from the start with the answers that the journal has. A
resumed journal has the same bytes as one that was never interrupted. A line is valid if its
checksum is correct, whatever lines precede it: `request` gives the question that it answers, and
`search` the journal in which it was written (read_journal.h). An incomplete last line, left by a
crash, is cut off when the journal is opened for writing. */

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/error.h"
#include "core/optimise/grasp_optimiser.h"
#include "datasets/journal/append_file.h"
#include "datasets/journal/read_journal.h"

namespace graspbench {

/** Loads the valid lines, sorted by `request` and, among equal ones, by position; empty without a
file.
@tparam Record  as for AnswerJournal. @throws Error(kIo). */
template <class Record>
std::vector<Record> LoadAnswers(const std::filesystem::path& path, Diagnostics& findings,
                                std::vector<Damage>& damage) {
  std::vector<Record> records;
  if (!std::filesystem::exists(path)) return records;
  const auto take = [&](const FileLine& line) { records.push_back(Record::Parse(line.text)); };
  ReadJournal(path.parent_path(), path.filename().string(), take, findings, damage);
  std::stable_sort(records.begin(), records.end(),
                   [](const Record& a, const Record& b) { return a.request < b.request; });
  return records;
}

/** Returns the answer to a question; null: none. @param records  result of LoadAnswers. */
template <class Record>
const Record* FindAnswer(const std::vector<Record>& records, int request) {
  const auto found =
      std::lower_bound(records.begin(), records.end(), request,
                       [](const Record& record, int number) { return record.request < number; });
  return found != records.end() && found->request == request ? &*found : nullptr;
}

/** @throws Error(kFormat) as RefuseDamage. */
inline void RefuseAnswers(const std::filesystem::path& folder, const std::vector<Damage>& damage,
                          OnDamage on_damage) {
  RefuseDamage("the search", folder, damage, on_damage,
               "move these lines elsewhere; what they answer is asked again");
}

/** Answers the questions of a search from its journal, and appends new answers.
@tparam Record  with `request`, `search`, `trials`, and static functions Parse and Format for a
line. */
template <class Record>
class AnswerJournal {
 public:
  /** @throws Error(kIo), also when another process writes to it; Error(kFormat) for damage. */
  explicit AnswerJournal(const std::filesystem::path& path)
      : file_(path), search_(FindJournalId(path)) {
    Diagnostics findings;  // verified by whoever reads the store
    std::vector<Damage> damage;
    stored_ = LoadAnswers<Record>(path, findings, damage);
    RefuseAnswers(path.parent_path(), damage, OnDamage::kRefuse);
    uintmax_t end = 0;
    ForEachLineOfFile(path, [&](const FileLine& line) {
      if (line.is_whole) end = line.start + line.text.size() + 1;
    });
    file_.Truncate(end);
  }

  /** Returns the stored answer to a question; null: none. */
  const Record* Find(int request) const { return FindAnswer(stored_, request); }
  /** Appends records after the stored ones; they are on disk when it returns. */
  void Append(std::vector<Record> records) {
    std::string lines;
    for (Record& record : records) {
      record.search = search_;
      lines += Record::Format(record) + "\n";
    }
    file_.Append(lines);
  }

  /** Answers the next questions in order, from the journal, or else by simulation; stores new
  answers.
  @param questions  records without number and trials.
  @param recall  (i, stored): receives the stored answer to question i; throws if it answers another
  question.
  @param simulate  (records, left): fills the trials of the records with the indices `left`.
  @returns the trials of each question. */
  template <class Recall, class Simulate>
  auto Answer(std::vector<Record> questions, Recall&& recall, Simulate&& simulate) {
    std::vector<size_t> left;
    for (size_t i = 0; i < questions.size(); ++i) {
      questions[i].request = num_asked_++;
      if (const Record* stored = Find(questions[i].request)) {
        recall(i, *stored);
        questions[i].trials = stored->trials;
      } else {
        left.push_back(i);
      }
    }
    std::vector<Record> added;
    if (!left.empty()) simulate(questions, left);
    for (const size_t i : left) added.push_back(questions[i]);
    if (!added.empty()) Append(std::move(added));
    std::vector<decltype(Record::trials)> trials;
    for (Record& record : questions) trials.push_back(std::move(record.trials));
    return trials;
  }

 private:
  AppendFile file_;
  std::optional<std::string> search_;
  std::vector<Record> stored_;
  int num_asked_ = 0;
};

/** A request of an optimisation to the simulation, with its answer. The journal has one line per
request, in order.

    {"request":57,"stage":"search","number":41,"generation":3,"parents":[12,8],"genome_rad":[..],
     "steps_rad":[..],"fitness":3.2,"trials":[{"trial_id":"..","draw":0,"sigma":3.2,..}],
     "search":"..","xxh64":".."} */
struct EvaluationRecord {
  int request = 0;  ///< index of the question, from 0
  LearningStage stage = LearningStage::kStandard;
  Individual individual;  ///< for stages that have one; `fitness` is computed from the trials
  std::vector<std::string> trial_ids;
  std::vector<LearningTrial> trials;
  std::optional<std::string> search = {};

  static std::string Format(const EvaluationRecord& record);
  /** @throws Error(kFormat). */
  static EvaluationRecord Parse(std::string_view line);
};

using EvaluationJournal = AnswerJournal<EvaluationRecord>;

}  // namespace graspbench
