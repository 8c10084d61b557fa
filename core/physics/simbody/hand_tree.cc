#include "core/physics/simbody/hand_tree.h"

#include "core/physics/simbody/simtk_conversions.h"

namespace graspbench {
namespace {

/** Makes a rotation that takes `own` (the axis of Simbody's joint: z of a pin, x of a slider) to
`axis`. */
SimTK::Transform MakeJointFrame(const Eigen::Vector3d& axis, SimTK::CoordinateAxis own) {
  return SimTK::Transform(SimTK::Rotation(SimTK::UnitVec3(ToSimTK(axis)), own));
}

}  // namespace

struct HandTree::Tree {
  SimTK::MultibodySystem system;
  SimTK::SimbodyMatterSubsystem matter{system};
  std::vector<SimTK::MobilizedBody> links;
  Pose X_HR = Pose::Identity();       ///< root link in H
  int root_q = 0, root_u = 0;         ///< Simbody's first indices of the root
  std::vector<int> q_index, u_index;  ///< by joint
  SimTK::State state;                 ///< realised to Stage::Instance
};

struct HandTree::Scratch {
  SimTK::State state;
  Eigen::Vector3d p_HR_W = Eigen::Vector3d::Zero();  ///< root's origin relative to H's
  SimTK::Array_<SimTK::SpatialInertia, SimTK::MobilizedBodyIndex> composite;
  SimTK::Vector accelerations, residual;
  SimTK::Vector no_forces;
  SimTK::Vector_<SimTK::SpatialVec> no_body_forces;
};

HandTree::HandTree(const Hand& hand) {
  const auto tree = std::make_shared<Tree>();
  for (const HandLink& link : hand.links) {
    const SimTK::Body::Rigid body(MakeMassProperties(link.mass, link.p_LLcm, link.I_LLcm));
    const SimTK::Transform here, X_PJ = ToSimTK(link.X_PJ);
    if (link.parent < 0) {
      tree->X_HR = link.X_PJ;
      tree->links.push_back(SimTK::MobilizedBody::Free(tree->matter.updGround(), here, body, here));
    } else if (link.joint < 0) {
      tree->links.push_back(SimTK::MobilizedBody::Weld(tree->links[link.parent], X_PJ, body, here));
    } else if (hand.joints[link.joint].is_prismatic) {
      const SimTK::Transform X_LM = MakeJointFrame(link.axis, SimTK::XAxis);
      tree->links.push_back(
          SimTK::MobilizedBody::Slider(tree->links[link.parent], X_PJ * X_LM, body, X_LM));
    } else {
      const SimTK::Transform X_LM = MakeJointFrame(link.axis, SimTK::ZAxis);
      tree->links.push_back(
          SimTK::MobilizedBody::Pin(tree->links[link.parent], X_PJ * X_LM, body, X_LM));
    }
  }
  tree->state = tree->system.realizeTopology();
  tree->system.realizeModel(tree->state);
  tree->system.realize(tree->state, SimTK::Stage::Time);
  tree->root_q = tree->links[0].getFirstQIndex(tree->state);
  tree->root_u = tree->links[0].getFirstUIndex(tree->state);
  for (const HandJoint& joint : hand.joints) {
    tree->q_index.push_back(tree->links[joint.link].getFirstQIndex(tree->state));
    tree->u_index.push_back(tree->links[joint.link].getFirstUIndex(tree->state));
  }
  tree_ = tree;
}

HandTree::HandTree(const HandTree& other) : tree_(other.tree_) {}

HandTree& HandTree::operator=(const HandTree& other) {
  tree_ = other.tree_;
  scratch_.reset();
  return *this;
}

HandTree::~HandTree() = default;

HandTree::Scratch& HandTree::scratch() {
  if (!scratch_) {
    scratch_ = std::make_unique<Scratch>();
    scratch_->state = tree_->state;
    scratch_->accelerations = SimTK::Vector(tree_->state.getNU(), 0.0);
  }
  return *scratch_;
}

void HandTree::SetPositions(const Pose& X_WH, const Eigen::VectorXd& q, std::vector<Pose>& X_WL) {
  Scratch& own = scratch();
  const Pose X_WR = X_WH * tree_->X_HR;
  own.p_HR_W = X_WR.translation() - X_WH.translation();
  double* all = &own.state.updQ()[0];
  const Eigen::Quaterniond turn(X_WR.linear());
  double* root = all + tree_->root_q;
  root[0] = turn.w();
  for (int k = 0; k < 3; ++k) {
    root[1 + k] = turn.vec()[k];
    root[4 + k] = X_WR.translation()[k];
  }
  for (size_t j = 0; j < tree_->q_index.size(); ++j) {
    all[tree_->q_index[j]] = q[static_cast<Eigen::Index>(j)];
  }
  tree_->matter.realizePositionKinematics(own.state);
  X_WL.resize(tree_->links.size());
  for (size_t i = 0; i < X_WL.size(); ++i) {
    const SimTK::Transform& X = tree_->links[i].getBodyTransform(own.state);
    const SimTK::Mat33& R = X.R().asMat33();
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 3; ++column) X_WL[i].matrix()(row, column) = R(row, column);
      X_WL[i].matrix()(row, 3) = X.p()[row];
    }
  }
}

void HandTree::CalcCarriedMasses(std::vector<CarriedMass>& carried) {
  Scratch& own = scratch();
  tree_->matter.calcCompositeBodyInertias(own.state, own.composite);
  carried.resize(tree_->links.size());
  for (size_t i = 0; i < carried.size(); ++i) {
    const SimTK::SpatialInertia& body = own.composite[tree_->links[i].getMobilizedBodyIndex()];
    const SimTK::SymMat33& G = body.getUnitInertia().asSymMat33();
    const double mass = body.getMass();
    carried[i].mass = mass;
    carried[i].moment = mass * FromSimTK(body.getMassCenter());
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column <= row; ++column) {
        carried[i].inertia(row, column) = carried[i].inertia(column, row) = mass * G(row, column);
      }
    }
  }
}

Eigen::VectorXd HandTree::CalcVelocityForces(const Eigen::VectorXd& rates) {
  Scratch& own = scratch();
  const auto num_joints = static_cast<Eigen::Index>(tree_->u_index.size());
  const Eigen::Vector3d w_WH = rates.segment<3>(num_joints);
  const Eigen::Vector3d v_WR = rates.segment<3>(num_joints + 3) + w_WH.cross(own.p_HR_W);
  // When H has constant velocity, the root's origin moves on a circle.
  const Eigen::Vector3d a_WR = w_WH.cross(w_WH.cross(own.p_HR_W));
  double* u = &own.state.updU()[0];
  for (Eigen::Index j = 0; j < num_joints; ++j)
    u[tree_->u_index[static_cast<size_t>(j)]] = rates[j];
  for (int k = 0; k < 3; ++k) {
    u[tree_->root_u + k] = w_WH[k];
    u[tree_->root_u + 3 + k] = v_WR[k];
    own.accelerations[tree_->root_u + 3 + k] = a_WR[k];
  }
  tree_->matter.realizeVelocityKinematics(own.state);
  tree_->matter.calcResidualForceIgnoringConstraints(own.state, own.no_forces, own.no_body_forces,
                                                     own.accelerations, own.residual);
  const double* force = &own.residual[0];
  Eigen::VectorXd result(num_joints + 6);
  for (Eigen::Index j = 0; j < num_joints; ++j) {
    result[j] = force[tree_->u_index[static_cast<size_t>(j)]];
  }
  const Eigen::Map<const Eigen::Vector3d> moment_W(force + tree_->root_u);
  const Eigen::Map<const Eigen::Vector3d> force_W(force + tree_->root_u + 3);
  result.segment<3>(num_joints) = moment_W + own.p_HR_W.cross(force_W);
  result.segment<3>(num_joints + 3) = force_W;
  return result;
}

}  // namespace graspbench
