#pragma once
/** @file
Points sorted into cells, to find those near a position without visiting all. */

#include <Eigen/Geometry>
#include <algorithm>
#include <vector>

namespace graspbench {

class PointGrid {
 public:
  /** @param points  finite [m]. Cells are 4 mm wide, or a 100th of the longest side if larger. */
  explicit PointGrid(const std::vector<Eigen::Vector3d>& points) {
    for (const Eigen::Vector3d& p : points) box_.extend(p);
    if (points.empty()) box_.extend(Eigen::Vector3d::Zero().eval());
    size_ = std::max(0.004, box_.sizes().maxCoeff() / 100.0);
    num_ = FindCell(box_.max()) + Eigen::Vector3i::Ones();
    first_.assign(static_cast<size_t>(num_.prod()) + 1, 0);
    for (const Eigen::Vector3d& p : points) ++first_[IndexOf(FindCell(p)) + 1];
    for (size_t k = 1; k < first_.size(); ++k) first_[k] += first_[k - 1];
    order_.resize(points.size());
    std::vector<int> next(first_.begin(), first_.end() - 1);
    for (size_t k = 0; k < points.size(); ++k) {
      order_[static_cast<size_t>(next[IndexOf(FindCell(points[k]))]++)] = static_cast<int>(k);
    }
  }

  /** Calls `visit` with the index of every point within `reach`, and of some farther away. */
  template <class F>
  void Visit(const Eigen::Vector3d& p, double reach, F&& visit) const {
    const Eigen::Vector3d lower = (p.array() - reach).matrix(),
                          upper = (p.array() + reach).matrix();
    if (!box_.intersects(Eigen::AlignedBox3d(lower, upper))) return;
    const Eigen::Vector3i low = FindCell(lower), high = FindCell(upper);
    for (int z = low.z(); z <= high.z(); ++z) {
      for (int y = low.y(); y <= high.y(); ++y) {
        const size_t row = IndexOf({0, y, z});
        const int end = first_[row + static_cast<size_t>(high.x()) + 1];
        for (int k = first_[row + static_cast<size_t>(low.x())]; k < end; ++k) {
          visit(static_cast<size_t>(order_[static_cast<size_t>(k)]));
        }
      }
    }
  }

 private:
  Eigen::Vector3i FindCell(const Eigen::Vector3d& p) const {
    const Eigen::Vector3d inside = p.cwiseMax(box_.min()).cwiseMin(box_.max());
    return ((inside - box_.min()) / size_).array().floor().cast<int>();
  }
  size_t IndexOf(const Eigen::Vector3i& cell) const {
    return static_cast<size_t>(cell.x() + num_.x() * (cell.y() + num_.y() * cell.z()));
  }

  Eigen::AlignedBox3d box_;
  double size_ = 0.0;
  Eigen::Vector3i num_ = Eigen::Vector3i::Zero();
  std::vector<int> first_;  // by cell: its start in order_; and one past the last
  std::vector<int> order_;  // indices of points, cell by cell
};

}  // namespace graspbench
