#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>

#include "core/base/text/text.h"
#include "core/base/units.h"
#include "core/hand/import/checks/joint_limits.h"
#include "core/hand/import/shapes/load_shapes.h"

namespace graspbench {
namespace {

constexpr double kShortestLink = 0.01;  // least length that shows a scale [m]
constexpr double kMillimetreRatio =
    300.0;  // of a mesh to its link, from which it is in millimetres
/** Ratio of mesh to link below which a large mesh is in inches. */
constexpr double kInchRatio = 70.0;
/** Ratios of mesh to link in a hand, and the ratio from which a unit is inferred. */
constexpr double kLeastRatio = 0.55, kTypicalRatio = 1.2, kMostRatio = 2.2, kClearRatio = 5.0;
constexpr double kOutlier = 3.0;      // link's ratio over the typical one
constexpr double kPalmOutlier = 6.0;  // where digits branch: a palm may reach far beyond its joints
/** Ratio of a link that is too long if its mass agrees, and the largest difference of the two. */
constexpr double kOddScale = 1.5, kSameScale = 1.5;

double FindMedian(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

std::string FindEnding(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return ending;
}

}  // namespace

double ShapeLoader::FindTypicalUnit(const std::filesystem::path& path) const {
  for (const std::string& format : {FindEnding(path), std::string()}) {
    const auto found = typical_units_.find(format);
    if (found != typical_units_.end()) return found->second;
  }
  return 1.0;
}

void ShapeLoader::InferMeshUnit(const ForeignHand& hand) {
  if (source_.mesh_unit > 0.0) return;
  const std::vector<double> lengths = CalcLinkLengths(hand);
  std::vector<LinkRatio> all;
  std::map<std::string, std::vector<LinkRatio>> by_format;
  for (size_t i = 0; i < hand.links.size(); ++i) {
    std::map<std::string, double> largest;  // by format
    for (const auto* shapes : {&hand.links[i].visuals, &hand.links[i].collisions}) {
      for (const ForeignShape& shape : *shapes) {
        const double extent = CalcMeshExtent(shape);
        if (extent == 0.0) continue;
        double& of_format = largest[FindEnding(Find(shape).path)];
        of_format = std::max(of_format, extent);
      }
    }
    if (largest.empty() || lengths[i] < kShortestLink || hand.links[i].is_decoration) continue;
    const auto& inertia = hand.links[i].inertia;
    const double mass = inertia ? std::max(0.0, inertia->mass) : 0.0;
    const auto num_joints =
        std::count_if(hand.joints.begin(), hand.joints.end(), [&](const ForeignJoint& joint) {
          return joint.parent == static_cast<int>(i) && joint.kind != ForeignJoint::Kind::kFixed;
        });
    double most = 0.0;
    const auto make_row = [&](double extent) {
      return LinkRatio{&hand.links[i], extent, extent / lengths[i], mass / std::pow(extent, 3),
                       num_joints > 1 ? kPalmOutlier : kOutlier};
    };
    for (const auto& [format, extent] : largest) {
      by_format[format].push_back(make_row(extent));
      most = std::max(most, extent);
    }
    all.push_back(make_row(most));
  }
  // Exporters write one format in millimetres and another in metres.
  double least = std::numeric_limits<double>::infinity(), most = 0.0;
  for (const auto& [format, rows] : by_format) {
    std::vector<double> ratios;
    for (const LinkRatio& row : rows) ratios.push_back(row.ratio);
    least = std::min(least, FindMedian(ratios));
    most = std::max(most, FindMedian(ratios));
  }
  if (most <= kClearRatio * least) return InferUnitOf(all, "");
  for (const auto& [format, rows] : by_format) InferUnitOf(rows, format);
}

void ShapeLoader::InferUnitOf(const std::vector<LinkRatio>& rows, const std::string& format) {
  if (rows.empty()) return;
  const bool has_large = std::any_of(rows.begin(), rows.end(),
                                     [](const auto& row) { return row.extent > kLargestPart; });
  const auto calc_median = [&](const auto& value_of) {
    std::vector<double> values;
    for (const LinkRatio& row : rows) {
      if (const double value = value_of(row); value > 0.0) values.push_back(value);
    }
    return FindMedian(values);
  };
  // A few parts that are too large are reported one by one; if all are too long, it is the unit.
  const bool are_all_long =
      rows.size() >= 3 && std::all_of(rows.begin(), rows.end(),
                                      [](const auto& row) { return row.ratio > kClearRatio; });
  if (has_large && !are_all_long) {
    const double ratio = calc_median(
        [](const LinkRatio& row) { return row.extent > kLargestPart ? row.ratio : 0.0; });
    large_unit_ = ratio < kInchRatio ? 0.0254 : ratio < kMillimetreRatio ? 0.01 : 0.001;
    why_ = ": meshes are " + FormatSignificant(ratio, 2) +
           " times as long as their links; --mesh-unit says otherwise";
    return;
  }
  if (rows.size() < 3) return;
  const double ratio = calc_median([](const LinkRatio& row) { return row.ratio; });
  const LinkRatio& first = rows.front();
  const std::string told = (format.empty() ? "the meshes are" : "the " + format + " meshes are") +
                           std::string(" typically ") + FormatSignificant(ratio, 2) +
                           " times as long as the links between the joints (median of " +
                           FormatCount(static_cast<int64_t>(rows.size()), "link") + ")";
  for (const auto& [unit, name] : {std::pair{0.1, "decimetres"},
                                   {0.0254, "inches"},
                                   {0.01, "centimetres"},
                                   {0.001, "millimetres"}}) {
    if (ratio < kClearRatio || ratio * unit < kTypicalRatio / 1.6 ||
        ratio * unit > 1.6 * kTypicalRatio) {
      continue;
    }
    typical_units_[format] = unit;
    problems_.Warn(source_.file, first.link->line,
                   told + "; taken to be in " + name + ", a factor of " +
                       FormatSignificant(unit, 3) + "; --mesh-unit says otherwise");
    return;
  }
  if (has_large) {
    problems_.Fail(source_.file, first.link->line,
                   told + ", and no unit of length fits; say theirs with --mesh-unit");
    return;
  }
  if (ratio < kLeastRatio || ratio > kMostRatio) {
    problems_.Warn(source_.file, first.link->line,
                   told + ", in a hand 0.55 to 2.2 times; a factor of about " +
                       FormatSignificant(kTypicalRatio / ratio, 2) +
                       " would fit: is their unit or scale another?");
    return;
  }
  const double density = calc_median([](const LinkRatio& row) { return row.density; });
  for (const LinkRatio& row : rows) {
    // A mesh with another scale is too long for its link and too large for its mass.
    const double by_length = row.ratio / ratio;
    const double by_mass = row.density > 0.0 ? std::cbrt(density / row.density) : 1.0;
    const bool is_odd = by_length > row.outlier || by_length * row.outlier < 1.0 ||
                        (by_length > kOddScale && by_mass > by_length / kSameScale &&
                         by_mass < by_length * kSameScale);
    if (!is_odd) continue;
    problems_.Warn(source_.file, row.link->line,
                   "link \"" + row.link->name + "\": its mesh of " +
                       FormatSignificant(MmFromM(row.extent), 3) + " mm is " +
                       FormatSignificant(row.ratio, 2) +
                       " times as long as the link, typical of this hand are " +
                       FormatSignificant(ratio, 2) + "; a factor of about " +
                       FormatSignificant(ratio / row.ratio, 2) + " would fit: is its scale right?");
  }
}

}  // namespace graspbench
