#include "datasets/records/judgement_line.h"

#include "datasets/journal/checked_line.h"

namespace graspbench {

std::string FormatJudgementLine(const std::string& trial_id, const Judgement& judgement) {
  return FormatCheckedLine({{"trial_id", trial_id},
                            {"judge_version", kJudgeVersion},
                            {"judgement", RecordToJson(judgement)}});
}

Judgement ParseJudgementLine(std::string_view line) {
  return ReadCheckedLine(line, [](const Json& json) {
    Judgement judgement;
    ReadRecord(json.at("judgement"), judgement);
    return judgement;
  });
}

}  // namespace graspbench
