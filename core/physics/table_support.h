#pragma once
/** @file
Contact points of an object on the table z = 0: corners are vertices of its mesh. A round part
touches at the lowest point of its ball, or of the circle that a rim represents (mesh_outline.h).

A mesh that represents a smooth surface must not roll on its vertices, because each would cause an
impact. If a vertex and all its neighbours lie on a sphere, and no edge there is sharper than in a
smooth mesh of 16 segments, that ball is the support instead of the vertices. All neighbours must
lie on it, because at the edge of a flat the surface bends in some directions only. A shape that is
round about one axis (a can on its side, a coin, a cone) rolls on the circles of its rims. The
circles pass through the mesh's vertices, so the object rests on them rather than on a side between
vertices. Other round shapes (an egg on its side, a rounded edge) remain polyhedra and roll as such;
smooth rolling is not modelled for them.

A face has uniform pressure. About eight points on its outline support the object against tipping,
each for its sector of the face, but the friction of a sector acts closer to the centre than its
outline. The points of friction are therefore moved towards the centre of pressure by the factor

    f = mean distance of the face's area from its centroid / mean distance of the points

so that they resist rotation about the normal as uniform pressure does (a disc: f = 2/3; on an edge:
1/2). If only a rim touches, f is 1. */

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "core/base/pose.h"
#include "core/shape/grasp_object.h"
#include "core/shape/tri_mesh.h"

namespace graspbench {

class TableSupport {
 public:
  static constexpr int kNumDirections = 8;  ///< outermost points in these directions carry

  struct Contact {
    int id = 0;                                     ///< constant for a corner, circle or ball
    Eigen::Vector3d p_W = Eigen::Vector3d::Zero();  ///< lowest point [m]
    bool is_round = false;                          ///< a ball
    bool rolls = false;                             ///< a ball or a circle
  };

  explicit TableSupport(const TriMesh& mesh);
  /** Returns the support of the object's mesh. It is created once per distance field, which belongs
  to one mesh. */
  static std::shared_ptr<const TableSupport> Of(const GraspObject& object);

  int num_ids() const { return static_cast<int>(points_.size() + balls_.size() + circles_.size()); }
  double radius() const { return radius_; }  ///< of a ball about O that encloses the object [m]

  /** Finds the contacts of the object at X_WO in a fixed order; none if nothing is lower than
  `reach`. `face_factor` is f for the contacts that are not balls. */
  void FindContacts(const Pose& X_WO, double reach, std::vector<Contact>& contacts,
                    double& face_factor) const;

  /** Returns the height of the object's lowest point [m]. */
  double CalcLowestPoint(const Pose& X_WO) const;

 private:
  struct Point {
    Eigen::Vector3d p_O;
    int ball = -1;               // index into balls_; -1: none
    int circle = -1;             // index into circles_; -1: none
    double neighbourhood = 0.0;  // distance to the farthest neighbour in the mesh [m]
  };
  struct Circle {
    Eigen::Vector3d p_OCentre, axis_O;
    double radius;
  };
  /** A vertex or circle that is low enough to touch. */
  struct Candidate {
    int id;
    Eigen::Vector3d p_O;
    double height;  // [m]
    bool rolls;
  };
  struct Ball {
    Eigen::Vector3d p_OCentre;
    double radius;
  };
  /** A flat face on which the object can stand. */
  struct Face {
    Eigen::Vector3d normal_O;
    double offset;  // offset of the plane from O [m]
    double area;
    Eigen::Vector3d p_OCentroid;
    double mean_distance;  // mean distance of its area from its centroid [m]
  };

  void FindBalls(const TriMesh& mesh, const std::vector<size_t>& vertices);
  void FindCircles(const TriMesh& mesh, const std::vector<size_t>& vertices);
  void FindFaces(const TriMesh& mesh);
  /** Returns the lowest point of a circle in O; nullopt for a horizontal circle. */
  static std::optional<Eigen::Vector3d> FindLowestOf(const Circle& circle,
                                                     const Eigen::Vector3d& up_O);
  /** Returns whether the ball of `point` is a support: its lowest point lies among the point's
  neighbours. */
  bool IsOnBall(const Point& point, const Pose& X_WO) const;
  /** Adds the indices of the outermost candidates that are not higher than `most`. */
  static void AddOutermost(const Eigen::Vector3d& up_O, double most,
                           const std::vector<Candidate>& candidates, std::vector<int>& chosen);
  double CalcFaceFactor(const Eigen::Vector3d& up_O, const std::vector<Candidate>& candidates,
                        const std::vector<int>& chosen) const;

  std::vector<Point> points_;
  std::vector<Ball> balls_;
  std::vector<Circle> circles_;
  std::vector<Face> faces_;
  double radius_ = 0.0;
};

}  // namespace graspbench
