#include "datasets/trajectory/trajectory_arrays.h"

#include <Eigen/Geometry>
#include <cmath>

namespace graspbench {
namespace {

void AddPose(const Pose& pose, std::vector<double>& values) {
  for (double part : pose.translation()) values.push_back(part);
  const Eigen::Quaterniond turn(pose.linear());
  for (double part : turn.coeffs()) values.push_back(part);
}

void NamePose(const std::string& of, std::vector<std::string>& columns) {
  for (const char* part : {"_x_m", "_y_m", "_z_m", "_qx", "_qy", "_qz", "_qw"}) {
    columns.push_back(of + part);
  }
}

std::string NameJoint(const HandJoint& joint) {
  return joint.name + (joint.is_prismatic ? "_m" : "_rad");
}

TrajectoryArray MakeStates(const TrialTrajectory& trajectory) {
  TrajectoryArray table = {"states", {}, {}};
  table.columns = {"time_s", "grip_force_n", "table_force_n"};
  NamePose("hand", table.columns);
  NamePose("object", table.columns);
  for (const HandJoint& joint : trajectory.hand->joints) {
    table.columns.push_back(NameJoint(joint));
  }
  const Arm* arm = FindTracedArm(trajectory.traced);
  for (int i = 0; arm && i < arm->num_joints(); ++i) {
    table.columns.push_back("arm/" + arm->joints[static_cast<size_t>(i)].name + "_rad");
  }
  for (const TraceInstant& instant : trajectory.traced.trace) {
    for (double v : {instant.time, instant.grip_force, instant.table_force}) {
      table.values.push_back(v);
    }
    AddPose(instant.X_WH, table.values);
    AddPose(instant.X_WO, table.values);
    table.values.insert(table.values.end(), instant.q.begin(), instant.q.end());
    if (arm) {
      table.values.insert(table.values.end(), instant.q_arm.begin(), instant.q_arm.end());
    }
  }
  return table;
}

/** What each drive was asked for; not a number before the first step. */
TrajectoryArray MakeActions(const TrialTrajectory& trajectory) {
  TrajectoryArray table = {"actions", {}, {}};
  const std::vector<HandJoint>& joints = trajectory.hand->joints;
  for (const HandJoint& joint : joints) {
    if (joint.coupled_to < 0) table.columns.push_back(NameJoint(joint));
  }
  for (const TraceInstant& instant : trajectory.traced.trace) {
    for (size_t j = 0; j < joints.size(); ++j) {
      if (joints[j].coupled_to >= 0) continue;
      const bool is_asked = instant.q_asked.size() > 0;
      table.values.push_back(is_asked ? instant.q_asked[static_cast<Eigen::Index>(j)] : kUnset);
    }
  }
  return table;
}

/** One row a contact; `instant` is the row of the states, `link` a number in the links' names. */
TrajectoryArray MakeContactTable(const TrialTrajectory& trajectory) {
  const auto numbers = ListContactNumbers();
  TrajectoryArray table = {"contacts", {}, {}};
  table.columns = {"instant", "link"};
  for (const auto& number : numbers) table.columns.push_back(number.name);
  double row = 0.0;
  for (const TraceInstant& instant : trajectory.traced.trace) {
    for (const HandContact& contact : instant.contacts) {
      table.values.insert(table.values.end(), {row, static_cast<double>(contact.link)});
      for (const auto& number : numbers) {
        table.values.push_back(number.value({&instant, &contact}).get<double>());
      }
    }
    row += 1.0;
  }
  return table;
}

/** The force on each tactile element's cell, a row an instant. */
TrajectoryArray MakeTaxelTable(const TrialTrajectory& trajectory) {
  TrajectoryArray table = {"taxels", {}, {}};
  for (const TrajectoryTaxel& taxel : ListTaxels(*trajectory.hand)) {
    table.columns.push_back("element_" + std::to_string(taxel.index) + "_n");
  }
  for (const TraceInstant& instant : trajectory.traced.trace) {
    const std::vector<double> forces = CalcTaxelForces(trajectory, instant);
    table.values.insert(table.values.end(), forces.begin(), forces.end());
  }
  return table;
}

/** A row an element; `link` is a number in the links' names, `digit` in the digits': -1 the palm. */
TrajectoryArray MakeTaxelPlaces(const Hand& hand) {
  TrajectoryArray table = {"taxel_elements", {}, {}};
  table.columns = {"link", "digit"};
  std::vector<CsvColumn<TrajectoryTaxel>> numbers;
  for (const auto& column : ListTaxelColumns()) {
    if (column.type == "number") numbers.push_back(column);
  }
  for (const auto& number : numbers) table.columns.push_back(number.name);
  for (const TrajectoryTaxel& taxel : ListTaxels(hand)) {
    const int link = taxel.element().link;
    table.values.insert(table.values.end(), {static_cast<double>(link),
                                             static_cast<double>(hand.FindDigitOfLink(link))});
    for (const auto& number : numbers) table.values.push_back(number.value(taxel).get<double>());
  }
  return table;
}

}  // namespace

std::vector<TrajectoryArray> MakeTrajectoryArrays(const TrialTrajectory& trajectory) {
  std::vector<TrajectoryArray> arrays = {MakeStates(trajectory), MakeActions(trajectory),
                                         MakeContactTable(trajectory)};
  if (trajectory.hand->skin) {
    arrays.push_back(MakeTaxelTable(trajectory));
    arrays.push_back(MakeTaxelPlaces(*trajectory.hand));
  }
  return arrays;
}

std::string FormatTrajectoryEvents(const TrialTrajectory& trajectory) {
  Json events = Json::array();
  for (const TrajectoryEvent& event : ListTrajectoryEvents(trajectory)) {
    Json json = {{"time_s", JsonNumber(event.time)}, {"kind", event.kind}};
    if (!event.phase.empty()) json["phase"] = event.phase;
    if (!event.link.empty()) json["digit"] = event.digit;
    if (!event.link.empty()) json["link"] = event.link;
    if (std::isfinite(event.impulse)) json["impulse_ns"] = event.impulse;
    events.push_back(std::move(json));
  }
  return FormatJson(events);
}

}  // namespace graspbench
