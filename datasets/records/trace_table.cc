#include "datasets/records/trace_table.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace graspbench {
namespace {

using Column = CsvColumn<TraceInstant>;

void AddPoseColumns(const std::string& name, const std::string& of, Pose TraceInstant::*pose,
                    std::vector<Column>& columns) {
  const char* axes[] = {"x", "y", "z"};
  for (int axis = 0; axis < 3; ++axis) {
    columns.push_back({name + "_" + axes[axis] + "_m", "m",
                       std::string(axes[axis]) + " of " + of + " in the world",
                       [pose, axis](const TraceInstant& instant) {
                         return (instant.*pose).translation()[axis];
                       }});
  }
  const char* parts[] = {"qx", "qy", "qz", "qw"};
  for (int part = 0; part < 4; ++part) {
    columns.push_back(
        {name + "_" + parts[part], "number", "",
         std::string(parts[part]) + " of the unit quaternion of " + of + " in the world",
         [pose, part](const TraceInstant& instant) {
           const Eigen::Quaterniond q((instant.*pose).linear());
           return JsonNumber(q.coeffs()[part]);
         }});
  }
}

void AddJointColumns(const Hand& hand, std::vector<Column>& columns) {
  for (int joint = 0; joint < hand.num_joints(); ++joint) {
    const HandJoint& moved = hand.joints[static_cast<size_t>(joint)];
    const std::string unit = moved.is_prismatic ? "m" : "rad";
    columns.push_back({moved.name + "_" + unit, unit, "position of joint " + moved.name,
                       [joint](const TraceInstant& i) { return i.q[joint]; }});
    if (moved.coupled_to >= 0) continue;
    columns.push_back({moved.name + "_asked_" + unit, "number", unit,
                       "command of the drive of joint " + moved.name + " was asked for",
                       [joint](const TraceInstant& i) {
                         return i.q_asked.size() ? JsonNumber(i.q_asked[joint]) : Json();
                       }});
  }
}

bool IsOf(const Hand& hand, const HandContact& contact, int digit) {
  return hand.FindDigitOfLink(contact.link) == digit;
}

void AddContactColumns(const Hand& hand, int digit, const std::string& name,
                       std::vector<Column>& columns) {
  columns.push_back({"normal_" + name + "_n", "N",
                     "sum of the normal forces of " + name + " on the object",
                     [&hand, digit](const TraceInstant& instant) {
                       return CalcDigitForce(hand, instant, digit);
                     }});
  columns.push_back({"cone_" + name, "number", "",
                     "largest share of the friction cone that a contact of " + name +
                         " uses, 1: all of it; missing: it does not touch",
                     [&hand, digit](const TraceInstant& instant) {
                       double share = -1.0;
                       for (const HandContact& contact : instant.contacts) {
                         if (!IsOf(hand, contact, digit)) continue;
                         share = std::fmax(share, CalcConeShare(contact));
                       }
                       return share < 0.0 ? Json() : JsonNumber(share);
                     }});
  columns.push_back(
      {"slip_" + name + "_m_per_s", "number", "m/s",
       "largest tangential speed at a contact of " + name + "; missing: it does not touch",
       [&hand, digit](const TraceInstant& instant) {
         double speed = -1.0;
         for (const HandContact& contact : instant.contacts) {
           if (IsOf(hand, contact, digit)) speed = std::max(speed, contact.slip_speed);
         }
         return speed < 0.0 ? Json() : JsonNumber(speed);
       }});
}

}  // namespace

double CalcDigitForce(const Hand& hand, const TraceInstant& instant, int digit) {
  double force = 0.0;
  for (const HandContact& contact : instant.contacts) {
    if (IsOf(hand, contact, digit)) force += contact.normal_force;
  }
  return force;
}

std::vector<Column> ListTraceColumns(const Hand& hand) {
  std::vector<Column> columns = {
      {"time_s", "s", "since the start of placing", &TraceInstant::time},
      {"phase", "", "phase of the strategy at this time",
       [](const TraceInstant& instant) { return NameOf(instant.next_phase); }},
      {"grip_force_n", "N", "sum of the hand's normal forces on the object",
       &TraceInstant::grip_force},
      {"table_force_n", "N", "normal force of the table on the object",
       &TraceInstant::table_force}};
  AddPoseColumns("hand", "the hand's frame H", &TraceInstant::X_WH, columns);
  AddPoseColumns("object", "the object's frame O", &TraceInstant::X_WO, columns);
  for (size_t digit = 0; digit < hand.digits.size(); ++digit) {
    AddContactColumns(hand, static_cast<int>(digit), hand.digits[digit].id, columns);
  }
  AddContactColumns(hand, -1, "palm", columns);
  AddJointColumns(hand, columns);
  return columns;
}

}  // namespace graspbench
