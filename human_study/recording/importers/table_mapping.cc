#include "human_study/recording/importers/table_mapping.h"

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/base/text/text.h"
#include "core/base/text/yaml.h"
#include "core/base/units.h"
#include "core/hand/hand.h"
#include "core/hand/load_hand.h"
#include "human_study/recording/importers/text_rows.h"

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

void ReadGlove(YamlMap& map, const std::filesystem::path& path, TableMapping& mapping) {
  if (!map.Has("glove")) return;
  const YAML::Node glove = map.Child("glove");
  if (!glove.IsMap()) return map.Fail("glove", "must name a hand, its joints and its base");
  GloveMapping& own = mapping.glove;
  for (const auto& entry : glove) {
    const auto key = entry.first.as<std::string>("");
    if (key == "hand") {
      own.hand = entry.second.as<std::string>("");
      const std::filesystem::path beside = path.parent_path() / own.hand;
      if (std::filesystem::is_directory(beside)) own.hand = beside.string();
    } else if (key == "angle_unit") {
      const auto unit = entry.second.as<std::string>("");
      own.is_in_degrees = unit == "deg";
      if (unit != "deg" && unit != "rad") {
        map.Fail("glove", "angle_unit is \"" + unit + "\"; expected deg or rad");
      }
    } else if (key == "joints" && entry.second.IsMap()) {
      for (const auto& joint : entry.second) {
        own.joints.emplace_back(joint.first.as<std::string>(""), joint.second.as<std::string>(""));
      }
    } else if ((key == "base" || key == "base_quaternion") && entry.second.IsSequence()) {
      for (const YAML::Node& name : entry.second) {
        (key == "base" ? own.base : own.quaternion).push_back(name.as<std::string>(""));
      }
    } else {
      map.Fail("glove", "\"" + key +
                            "\" is not known or no list; known: hand, angle_unit, joints, "
                            "base, base_quaternion");
    }
  }
  if (own.hand.empty() || own.joints.empty()) {
    map.Fail("glove", "needs hand, a model, and joints, each with its column");
  }
  if (own.base.size() != 3 || own.quaternion.size() != 4) {
    map.Fail(
        "glove",
        "needs base [x, y, z] and base_quaternion [x, y, z, w]: joint angles alone do not tell "
        "where the hand is, so neither its reach nor its contacts");
  }
}

void ReadLayout(YamlMap& map, TableMapping& mapping) {
  map.Read("layout", mapping.layout, Needed::kNo);
  map.Read("scale", mapping.scale, Needed::kNo);
  if (mapping.layout.empty()) return;
  const TableLayout* layout = FindTableLayout(mapping.layout);
  if (layout == nullptr) {
    std::vector<std::string> known;
    for (const TableLayout& one : TableLayoutList()) known.emplace_back(one.id);
    map.Fail("layout",
             "\"" + mapping.layout + "\" is not known" + SuggestNames(mapping.layout, known));
    mapping.layout.clear();
  } else if (layout->needs_scale && !map.Has("scale")) {
    map.Fail("scale",
             "is missing: DeepLabCut counts lengths in squares of its checkerboard; say how long "
             "one is (scale: 25 and unit: mm), or scale: 1 when they were put into the unit since");
  }
}

void ReadChannels(YamlMap& map, TableMapping& mapping) {
  if (!map.Has("channels")) return;
  const YAML::Node channels = map.Child("channels");
  if (!channels.IsMap()) return map.Fail("channels", "must name channels, each with its column");
  for (const auto& entry : channels) {
    const auto column = entry.second.IsScalar() ? entry.second.as<std::string>("") : "";
    if (column.empty()) map.Fail("channels", "each needs the name of one column");
    mapping.channels.emplace_back(entry.first.as<std::string>(""), column);
  }
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

TableMapping LoadTableMapping(const std::filesystem::path& path) {
  Diagnostics problems;
  const YAML::Node root = LoadYaml(path, problems);
  TableMapping mapping;
  if (problems.num_errors() == 0) {
    YamlMap map(root, path.string(), "mapping", problems, &ListMappingKeys());
    std::string time_unit = "s";
    map.Read("unit", mapping.unit, Needed::kNo);
    map.Read("time", mapping.time, Needed::kNo);
    map.Read("time_unit", time_unit, Needed::kNo);
    map.Read("rate_hz", mapping.rate, Needed::kNo);
    map.Read("trial", mapping.trial, Needed::kNo);
    map.Read("occluded", mapping.occluded, Needed::kNo);
    map.Read("heading", mapping.has_heading, Needed::kNo);
    ReadLayout(map, mapping);
    ReadChannels(map, mapping);
    if (time_unit == "ms") {
      mapping.seconds_per_time_unit = 1e-3;
    } else if (time_unit == "us") {
      mapping.seconds_per_time_unit = 1e-6;
    } else if (time_unit != "s") {
      map.Fail("time_unit", "is \"" + time_unit + "\"; expected s, ms or us");
    }
    if (mapping.time.empty() && !(mapping.rate > 0)) {
      map.Fail("rate_hz", "is needed when no column of times is named");
    }
    ReadGlove(map, path, mapping);
    // Angles of a glove and the columns of a layout are points enough.
    const bool needs_no_points = mapping.glove.IsNamed() || !mapping.layout.empty();
    const YAML::Node points = map.Child("points", Needed::kNo);
    const bool is_absent = !points || points.IsNull();
    if (is_absent ? !needs_no_points : !points.IsMap() || points.size() == 0) {
      map.Fail("points", "must name points, each with its three columns");
    } else if (!is_absent) {
      for (const auto& entry : points) {
        TableMapping::Point point;
        point.label = entry.first.as<std::string>("");
        if (entry.second.IsSequence()) {
          for (const YAML::Node& name : entry.second) {
            point.columns.push_back(name.as<std::string>(""));
          }
        }
        if (point.columns.size() != 3) {
          map.Fail("points", "\"" + point.label + "\" needs the three columns of x, y, z in []");
        }
        mapping.points.push_back(std::move(point));
      }
    }
    map.FinishKnownKeys();
  }
  problems.ThrowIfErrors(ErrorKind::kFormat, "the mapping cannot be used");
  return mapping;
}

const FileKeys& ListMappingKeys() {
  static const FileKeys keys = {
      {"unit", "", "of length: mm, cm, m, in; without it as --unit or recording.unit say"},
      {"time", "", "column of the times; without it rate_hz is needed"},
      {"time_unit", "s", "of the times: s, ms or us"},
      {"rate_hz", "0", KeyType::kNumber, "of the rows; 0: as the times say", 0.0},
      {"trial", "", "column that says which trial a row belongs to, where a file holds several"},
      {"occluded", "", "column of a flag: a value other than 0 makes all points invalid"},
      {"heading", "true", KeyType::kBoolean,
       "the first row names the columns; false: they are called 1, 2, .."},
      {"layout", "", "columns as a tool writes them: deeplabcut, freemocap"},
      {"scale", "1", KeyType::kNumber,
       "so many of the unit is a coordinate of 1; deeplabcut needs it", kAboveZero},
      {"channels", "", "of forces or touch switches: each with its column"},
      {"glove", "",
       "joint angles instead of points: hand (a model's id or folder), angle_unit, joints (each "
       "with its column), base [x, y, z], base_quaternion [x, y, z, w]"},
      {"points", "", KeyType::kMap,
       "each with its three columns, index: [index_x, index_y, index_z]; not needed with layout or "
       "glove"}};
  return keys;
}

bool IsHeadingOf(const TableMapping& mapping, std::string_view heading) {
  if (!mapping.layout.empty() || !mapping.has_heading) return false;
  while (!heading.empty() && heading.back() == '\r') heading.remove_suffix(1);
  if (StartsWith(heading, "\xef\xbb\xbf")) heading.remove_prefix(3);
  Cells cells;
  SplitRow(heading, FindDelimiter(heading), 0, cells);
  const auto has = [&](const std::string& name) {
    return name.empty() || std::find(cells.begin(), cells.end(), name) != cells.end();
  };
  const auto has_all = [&](const std::vector<std::string>& names) {
    return std::all_of(names.begin(), names.end(), has);
  };
  return has(mapping.time) && has(mapping.trial) && has(mapping.occluded) &&
         has_all(mapping.glove.ListColumns()) &&
         std::all_of(mapping.points.begin(), mapping.points.end(),
                     [&](const auto& point) { return has_all(point.columns); }) &&
         std::all_of(mapping.channels.begin(), mapping.channels.end(),
                     [&](const auto& channel) { return has(channel.second); });
}

}  // namespace graspbench
