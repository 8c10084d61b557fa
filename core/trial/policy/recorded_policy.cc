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
    if (rows[next_].stiffness.size() > 0) action.stiffness.resizeLike(action.rows);
    for (size_t row = next_; row < end; ++row) {
      const PolicyRow& one = rows[row];
      const auto at = static_cast<Eigen::Index>(row - next_);
      if (one.targets.size() != view.targets.size() ||
          (action.stiffness.rows() > 0 && one.stiffness.size() != view.targets.size())) {
        throw PolicyFault("the record holds actions of another hand");
      }
      action.rows.row(at) = one.targets.transpose();
      if (action.stiffness.rows() > 0) action.stiffness.row(at) = one.stiffness.transpose();
      if (one.hand) action.poses.push_back(*one.hand);
      if (one.hold) action.hold = RowFromName(kGripModes, *one.hold, "grip").value;
    }
    if (!action.poses.empty() && action.poses.size() != end - next_) {
      throw PolicyFault("the record lacks poses of the hand");
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
