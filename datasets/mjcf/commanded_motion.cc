#include "datasets/mjcf/commanded_motion.h"

#include <memory>
#include <optional>

#include "core/base/text/csv.h"
#include "core/physics/implicit_world.h"
#include "core/trial/protocols/table_lift.h"

namespace graspbench {

CommandedMotion RecordMotion(const TrialSetup& recorded) {
  TrialSetup setup = recorded;
  setup.sim.steady_step_factor = 1;  // a row for every step
  TableLift course(std::make_unique<ImplicitWorld>(*setup.hand, *setup.object, setup.sim), setup);
  CommandedMotion motion;
  motion.step = setup.sim.step;
  course.Begin();
  motion.start = course.world().state();
  while (course.Advance()) motion.steps.push_back({course.phase(), course.last_command()});
  while (const std::optional<WorldCommand> command = course.ComputeOpenLoopCommand()) {
    motion.steps.push_back({course.phase(), *command});
  }
  return motion;
}

std::string FormatMotionCsv(const Hand& hand, const CommandedMotion& motion) {
  struct Row {
    double time;
    MotionStep step;
  };
  std::vector<Row> rows = {{0.0, {Phase::kPlacing, {motion.start.q, motion.start.X_WH}}}};
  for (size_t i = 0; i < motion.steps.size(); ++i) {
    rows.push_back({motion.step * static_cast<double>(i + 1), motion.steps[i]});
  }
  std::vector<CsvColumn<Row>> columns = {
      {"time_s", "s", "since the start", &Row::time},
      {"phase", "", "of the strategy", [](const Row& row) { return NameOf(row.step.phase); }}};
  const Eigen::Vector3d p_WStart = motion.start.X_WH.translation();
  for (int axis = 0; axis < 3; ++axis) {
    const std::string name = std::string("arm_") + "xyz"[axis];
    columns.push_back(
        {name + "_m", "m", "displacement of the hand's root", [axis, p_WStart](const Row& row) {
           return row.step.command.X_WH.translation()[axis] - p_WStart[axis];
         }});
  }
  for (int axis = 0; axis < 3; ++axis) {
    const std::string name = std::string("arm_") + "xyz"[axis];
    columns.push_back({name + "_m_per_s", "m/s", "its rate",
                       [axis](const Row& row) { return row.step.command.v_WH[axis]; }});
  }
  for (int joint = 0; joint < hand.num_joints(); ++joint) {
    if (hand.joints[joint].coupled_to >= 0) continue;
    columns.push_back({hand.joints[joint].name + "_rad", "rad", "command of the drive",
                       [joint](const Row& row) { return row.step.command.q[joint]; }});
  }
  return FormatCsv(columns, rows);
}

}  // namespace graspbench
