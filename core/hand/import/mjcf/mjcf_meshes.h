#pragma once
/** @file
The meshes of a MuJoCo model's assets: files, or vertices that stand in the model. */

#include <map>
#include <memory>
#include <string>

#include "core/hand/import/foreign_hand.h"
#include "core/hand/import/mjcf/mjcf_document.h"

namespace graspbench {

class MjcfMeshes {
 public:
  /** @param document  outlives this. */
  explicit MjcfMeshes(MjcfDocument& document) : document_(document) {}

  /** Of an asset <mesh>; what cannot be read is warned of and left out. */
  void Read(tinyxml2::XMLElement& element);
  /** The mesh that a geom names, put into its shape. False: it names none. An unknown name is
  warned of and becomes a mesh without a file, an error if the hand touches with it. */
  bool Place(const MjcfNode& geom, const std::string& where, ForeignShape& shape) const;

 private:
  struct Mesh {
    std::string address;
    std::shared_ptr<const TriMesh> solid;  // of a mesh without file
    Eigen::Vector3d scale = Eigen::Vector3d::Ones();
    Pose X_GM = Pose::Identity();  // of the scaled vertices in the geom's frame
  };
  std::shared_ptr<const TriMesh> ReadInline(const MjcfNode& node, const std::string& where);

  MjcfDocument& document_;
  std::map<std::string, Mesh> meshes_;
};

}  // namespace graspbench
