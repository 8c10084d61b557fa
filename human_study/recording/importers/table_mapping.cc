#include "human_study/recording/importers/table_mapping.h"

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/base/text/text.h"
#include "core/base/units.h"
#include "core/hand/hand.h"
#include "core/hand/load_hand.h"

namespace graspbench {

namespace {

constexpr size_t kSuffix = 2;  // of "_x"

/** A heading row that begins with `name`. */
Cells RequireRow(LineReader& reader, char delimiter, const std::string& name, std::string& line) {
  line = std::string(reader.Require("the heading row \"" + name + "\""));
  Cells cells;
  SplitCells(line, delimiter, cells);
  if (cells[0] != name) {
    reader.Fail("the heading row begins with \"" + std::string(cells[0].substr(0, 30)) +
                "\"; DeepLabCut writes \"" + name + "\" here (layout: deeplabcut)");
  }
  return cells;
}

std::vector<std::string> ReadDeepLabCut(LineReader& reader, char delimiter) {
  std::string scorer_line, line, part_line, coord_line;
  RequireRow(reader, delimiter, "scorer", scorer_line);
  line = std::string(reader.Require("the heading row \"bodyparts\""));
  Cells individuals, parts;
  SplitCells(line, delimiter, parts);
  const bool has_individuals = parts[0] == "individuals";
  if (has_individuals) {
    individuals = parts;
    parts = RequireRow(reader, delimiter, "bodyparts", part_line);
  } else if (parts[0] != "bodyparts") {
    reader.Fail("the second row begins with \"" + std::string(parts[0].substr(0, 30)) +
                "\"; DeepLabCut writes \"bodyparts\" there, or \"individuals\"");
  }
  const Cells coords = RequireRow(reader, delimiter, "coords", coord_line);
  if (parts.size() != coords.size() || (has_individuals && individuals.size() != coords.size())) {
    reader.Fail("its heading rows have " + std::to_string(parts.size()) + " and " +
                std::to_string(coords.size()) + " cells; expected as many in each");
  }
  std::vector<std::string> names = {""};  // the frame's number
  for (size_t i = 1; i < coords.size(); ++i) {
    const std::string owner = has_individuals ? std::string(individuals[i]) + ":" : "";
    names.push_back(owner + std::string(parts[i]) + "_" + std::string(coords[i]));
  }
  return names;
}

std::vector<std::string> ReadFreeMoCap(LineReader& reader, char delimiter) {
  const std::string line(reader.Require("the names of its columns"));
  Cells cells;
  SplitCells(line, delimiter, cells);
  return {cells.begin(), cells.end()};
}

}  // namespace

const std::vector<TableLayout>& TableLayoutList() {
  static const std::vector<TableLayout> layouts = {
      {"deeplabcut", "DeepLabCut 3-D", true, ReadDeepLabCut},
      {"freemocap", "FreeMoCap", false, ReadFreeMoCap},
  };
  return layouts;
}

const TableLayout* FindTableLayout(const std::string& id) {
  for (const TableLayout& layout : TableLayoutList()) {
    if (id == layout.id) return &layout;
  }
  return nullptr;
}

std::vector<std::string> FindLayoutPoints(const std::vector<std::string>& names,
                                          const LineReader& reader) {
  const auto has = [&](const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  std::vector<std::string> points;
  bool is_flat = false;
  for (const std::string& name : names) {
    if (name.size() <= kSuffix || name.compare(name.size() - kSuffix, kSuffix, "_x") != 0) continue;
    const std::string point = name.substr(0, name.size() - kSuffix);
    if (!has(point + "_y")) continue;
    if (!has(point + "_z")) {
      is_flat = true;
      continue;
    }
    if (std::count(names.begin(), names.end(), name) > 1) {
      reader.Fail("the point \"" + point + "\" is there twice");
    }
    points.push_back(point);
  }
  if (points.empty()) {
    reader.Fail(is_flat ? "these are places in a picture (x and y, no z): triangulate them first, "
                          "and read the 3-D table"
                        : "no three columns NAME_x, NAME_y, NAME_z are there");
  }
  return points;
}

std::vector<std::string> GloveMapping::ListColumns() const {
  std::vector<std::string> columns;
  for (const auto& [joint, column] : joints) columns.push_back(column);
  columns.insert(columns.end(), base.begin(), base.end());
  columns.insert(columns.end(), quaternion.begin(), quaternion.end());
  return columns;
}

GloveModel::GloveModel(const GloveMapping& mapping)
    : hand_(std::make_shared<const Hand>(LoadHand(mapping.hand))) {
  std::vector<std::string> known;
  for (const HandJoint& joint : hand_->joints) {
    if (!joint.is_mimic && !joint.is_prismatic) known.push_back(joint.name);
  }
  for (const auto& [name, column] : mapping.joints) {
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      throw Error(ErrorKind::kFormat, "glove: the hand " + mapping.hand + " has no joint \"" +
                                          name + "\" of its own that turns" +
                                          SuggestNames(name, known));
    }
    joints_.push_back(hand_->FindJoint(name));
  }
  factor_ = mapping.is_in_degrees ? kPi / 180.0 : 1.0;
  for (const Digit& digit : hand_->digits) labels_.push_back(digit.name + "_tip");
  labels_.push_back("wrist");
}

std::string GloveModel::Describe() const {
  return std::to_string(joints_.size()) + " of " + std::to_string(hand_->num_joints()) +
         " joints are named, the others are straight or coupled; the bones are those of " +
         hand_->name + ", not the person's";
}

std::vector<Eigen::Vector3d> GloveModel::CalcPoints(const std::vector<double>& cells,
                                                    double metres_per_unit) const {
  const size_t n = joints_.size();
  if (!std::all_of(cells.begin(), cells.end(), [](double cell) { return std::isfinite(cell); })) {
    return {};
  }
  Eigen::VectorXd q = Eigen::VectorXd::Zero(hand_->num_joints());
  ApplyCoupling(*hand_, q);
  for (size_t i = 0; i < n; ++i) q(joints_[i]) = factor_ * cells[i];
  // A linkage follows what was measured; a distal joint that was measured stays.
  Eigen::VectorXd coupled = q;
  ApplyCoupling(*hand_, coupled);
  for (int i = 0; i < hand_->num_joints(); ++i) {
    if (std::find(joints_.begin(), joints_.end(), i) == joints_.end()) q(i) = coupled(i);
  }
  const Eigen::Vector3d p = metres_per_unit * Eigen::Vector3d(cells[n], cells[n + 1], cells[n + 2]);
  const Eigen::Quaterniond rotation(cells[n + 6], cells[n + 3], cells[n + 4], cells[n + 5]);
  constexpr double kMaxOff = 0.01;  // of its length from 1
  if (std::abs(rotation.norm() - 1.0) > kMaxOff) return {};
  const Eigen::Matrix3d r = rotation.normalized().toRotationMatrix();
  std::vector<Eigen::Vector3d> points;
  for (const Digit& digit : hand_->digits) {
    const Eigen::Vector3d p_H = CalcLinkPose(*hand_, q, digit.distal_link) * digit.p_LPad;
    points.push_back((p + r * p_H) / metres_per_unit);
  }
  points.push_back(p / metres_per_unit);
  return points;
}

}  // namespace graspbench
