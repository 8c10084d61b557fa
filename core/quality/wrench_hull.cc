#include "core/quality/wrench_hull.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "core/base/error.h"
#include "core/quality/wrench_space.h"

extern "C" {
#include <libqhull_r/qhull_ra.h>
}

namespace graspbench {
namespace {

/** Runs Qhull and holds its memory. Qhull writes to a FILE only; a stream into memory keeps its
words for our own message. */
class QhullRun {
 public:
  QhullRun(const Eigen::MatrixXd& points, std::string options) : points_(points) {
    FILE* log = open_memstream(&log_text_, &log_size_);
    GRASPBENCH_DEMAND(log != nullptr, "no memory for a log");
    qh_zero(&qh_, log);
    failed_ = qh_new_qhull(&qh_, points_.rows(), points_.cols(), points_.data(),
                           /* ismalloc */ False, options.data(), /* outfile */ nullptr, log) != 0;
    std::fclose(log);
  }
  ~QhullRun() {
    qh_freeqhull(&qh_, !qh_ALL);
    int num_long = 0, total_long = 0;
    qh_memfreeshort(&qh_, &num_long, &total_long);
    std::free(log_text_);
  }
  QhullRun(const QhullRun&) = delete;
  QhullRun& operator=(const QhullRun&) = delete;

  bool failed() const { return failed_; }
  /** The first line, e.g. "QH6271 qhull topology error (...): wide merge ...". */
  std::string FindMessage() const {
    const std::string text(log_text_, log_size_);
    return text.substr(0, text.find('\n'));
  }
  WrenchHull MakeHull() {
    qhT* const qh = &qh_;  // the name Qhull's loop macros expect
    WrenchHull hull;
    hull.normals.resize(points_.rows(), qh->num_facets);
    hull.offsets.resize(qh->num_facets);
    const facetT* facet = nullptr;
    int num_facets = 0;
    FORALLfacets {
      hull.normals.col(num_facets) =
          Eigen::Map<const Eigen::VectorXd>(facet->normal, points_.rows());
      hull.offsets[num_facets++] = -facet->offset;
    }
    hull.centre = Eigen::VectorXd::Zero(points_.rows());
    const vertexT* vertex = nullptr;
    FORALLvertices {
      hull.centre +=
          Eigen::Map<const Eigen::VectorXd>(vertex->point, points_.rows()) / qh->num_vertices;
    }
    qh_getarea(qh, qh->facet_list);
    hull.volume = qh->totvol;
    hull.joggle = qh->JOGGLEmax < REALmax / 2 ? qh->JOGGLEmax : 0.0;
    return hull;
  }

 private:
  Eigen::MatrixXd points_;  // Qhull keeps pointing into its input
  qhT qh_;
  char* log_text_ = nullptr;
  size_t log_size_ = 0;
  bool failed_ = false;
};

}  // namespace

WrenchHull CalcWrenchHull(const Eigen::MatrixXd& points) {
  GRASPBENCH_DEMAND(points.rows() >= 2 && points.rows() <= 6,
                    "dimensions: " + std::to_string(points.rows()));
  if (static_cast<Eigen::Index>(FindAffineBasis(points).size()) <= points.rows()) {
    WrenchHull flat;
    flat.is_flat = true;
    return flat;
  }
  QhullRun exact(points, "qhull");
  if (!exact.failed()) return exact.MakeHull();
  // Many wrenches on one facet (all contacts of a cube's face have the same force component) can
  // defeat Qhull's merging. A joggle cannot invent volume here: the set is known not to be flat.
  QhullRun joggled(points, "qhull QJ");
  if (!joggled.failed()) return joggled.MakeHull();
  throw Error(ErrorKind::kUnsupported,
              "the convex hull of " + std::to_string(points.cols()) +
                  " wrenches cannot be computed: " + joggled.FindMessage());
}

double CalcEpsilon(const WrenchHull& hull) {
  if (hull.is_flat) return 0.0;
  const double epsilon = hull.offsets.minCoeff();
  return epsilon > kNegligibleShare * hull.offsets.maxCoeff() ? epsilon : 0.0;
}

}  // namespace graspbench
