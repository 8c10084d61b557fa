#include "core/trial/policy/hand_policy.h"

namespace graspbench {
namespace {

class RecordedPolicy : public HandPolicy {
 public:
  explicit RecordedPolicy(const PolicyRecord& record) : record_(record) {}

  void Begin(const PolicyView&) override {
    next_ = 0;
    if (record_.num_questions == 0 && record_.fault) throw PolicyFault(*record_.fault);
  }

  PolicyAction Answer(const PolicyView& view) override {
    const std::vector<PolicyRow>& rows = record_.rows;
    if (next_ == rows.size()) {
      throw PolicyFault(record_.fault.value_or("the record holds no further action"));
    }
    size_t end = next_ + 1;
    while (end < rows.size() && !rows[end].begins) ++end;
    PolicyAction action;
    action.rows.resize(static_cast<Eigen::Index>(end - next_), view.targets.size());
    for (size_t row = next_; row < end; ++row) {
      if (rows[row].targets.size() != view.targets.size()) {
        throw PolicyFault("the record holds actions of another hand");
      }
      action.rows.row(static_cast<Eigen::Index>(row - next_)) = rows[row].targets.transpose();
    }
    next_ = end;
    action.is_done = record_.said_done && end == rows.size();
    return action;
  }

 private:
  PolicyRecord record_;
  size_t next_ = 0;
};

}  // namespace

std::shared_ptr<HandPolicy> MakeRecordedPolicy(const PolicyRecord& record) {
  return std::make_shared<RecordedPolicy>(record);
}

}  // namespace graspbench
