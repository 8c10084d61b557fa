#include "core/hand/contact_fit.h"

#include <algorithm>
#include <cmath>

#include "core/base/text/text.h"
#include "core/base/units.h"
#include "core/hand/contact_shape.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

constexpr double kNotMet = 0.01;  // [m]
constexpr double kPalmarCosine = 0.5;

struct PlacedBall {
  int link = -1;
  Vector3d c;  // in H
  double r = 0.0;
};

ContactError Summarise(std::vector<double>& values) {
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  return {values[(values.size() - 1) * 95 / 100], values.back()};
}

}  // namespace

std::vector<Vector3d> SpreadOnSphere(double radius) {
  constexpr double kApart = 0.0015;
  const double golden = kPi * (3.0 - std::sqrt(5.0));
  const int count =
      static_cast<int>(std::clamp(4.0 * kPi * radius * radius / (kApart * kApart), 60.0, 2000.0));
  std::vector<Vector3d> points;
  for (int i = 0; i < count; ++i) {
    const double z = (2.0 * i + 1.0) / count - 1.0, across = std::sqrt(1.0 - z * z);
    points.emplace_back(across * std::cos(golden * i), across * std::sin(golden * i), z);
  }
  return points;
}

double CalcSink(const Vector3d& p, const Vector3d& nhat, const Vector3d& c, double r) {
  const Vector3d v = p + kProbeRadius * nhat - c;
  const double along = v.dot(nhat);
  const double square = along * along - v.squaredNorm() + (kProbeRadius + r) * (kProbeRadius + r);
  const bool is_ahead = along <= 0.0 && v.norm() > kProbeRadius + r;  // the probe starts beyond the
                                                                      // ball
  return square < 0.0 || is_ahead ? kNotMet : std::min(kNotMet, along - std::sqrt(square));
}

std::vector<ContactFit> MeasureContact(const Hand& hand, const LinkSolids& solids, int num_points) {
  const std::vector<Pose> X_HL = CalcLinkPoses(hand, Eigen::VectorXd::Zero(hand.num_joints()));
  std::vector<PlacedBall> balls;
  for (const ContactSphere& ball : hand.contact_spheres) {
    balls.push_back({ball.link, X_HL[static_cast<size_t>(ball.link)] * ball.p_LS, ball.radius});
  }
  std::vector<ContactFit> fits;
  for (size_t link = 0; link < hand.links.size(); ++link) {
    ContactFit fit;
    fit.link = hand.links[link].name;
    std::vector<PlacedBall> own, near;  // own: of the link; near: of others, which can hide its
                                        // points
    for (const PlacedBall& ball : balls)
      (ball.link == static_cast<int>(link) ? own : near).push_back(ball);
    fit.num_balls = static_cast<int>(own.size());
    if (!solids[link] || own.empty()) continue;
    const LinkSolid& solid = *solids[link];
    Eigen::AlignedBox3d box;
    for (const auto& point : solid.boundary()) box.extend(X_HL[link] * point.p);
    near.erase(std::remove_if(near.begin(), near.end(),
                              [&](const PlacedBall& ball) {
                                return box.exteriorDistance(ball.c) > ball.r + 2.0 * kProbeRadius;
                              }),
               near.end());
    const auto is_held = [](const std::vector<PlacedBall>& by, const Vector3d& p, size_t but) {
      for (size_t k = 0; k < by.size(); ++k) {
        if (k != but && (p - by[k].c).squaredNorm() < by[k].r * by[k].r) return true;
      }
      return false;
    };
    std::vector<LinkCapsule> capsules;
    for (const LinkCapsule& capsule : hand.capsules) {
      if (capsule.link == static_cast<int>(link)) capsules.push_back(capsule);
    }
    fit.num_capsules = static_cast<int>(capsules.size());
    std::vector<double> out, palmar_out, sink, palmar_sink;
    int num_near = 0;
    const Pose X_LH = X_HL[link].inverse();
    for (size_t k = 0; k < own.size(); ++k) {
      for (const Vector3d& direction : SpreadOnSphere(own[k].r)) {
        const Vector3d p = own[k].c + own[k].r * direction;
        if (is_held(own, p, k) || is_held(near, p, near.size())) continue;
        out.push_back(solid.CalcOutside(X_LH * p));
        if (direction.dot(hand.palm_normal) > kPalmarCosine) palmar_out.push_back(out.back());
      }
    }
    for (const auto& point : solid.ListOpen(static_cast<size_t>(num_points))) {
      const Vector3d p = X_HL[link] * point.p, nhat = X_HL[link].linear() * point.nhat;
      if (is_held(near, p + 0.001 * nhat, near.size())) continue;
      double least = kNotMet;
      for (const PlacedBall& ball : own) least = std::min(least, CalcSink(p, nhat, ball.c, ball.r));
      for (const PlacedBall& ball : near)
        least = std::min(least, CalcSink(p, nhat, ball.c, ball.r));
      sink.push_back(std::max(0.0, least));
      num_near += std::any_of(capsules.begin(), capsules.end(), [&](const LinkCapsule& capsule) {
        return CalcDistanceToCapsule(capsule, point.p) < kNearSelfContact;
      });
      if (nhat.dot(hand.palm_normal) > kPalmarCosine) palmar_sink.push_back(sink.back());
    }
    if (!sink.empty()) fit.self_contact = num_near / static_cast<double>(sink.size());
    fit.out = Summarise(out);
    fit.palmar_out = Summarise(palmar_out);
    fit.sink = Summarise(sink);
    fit.palmar_sink = Summarise(palmar_sink);
    fits.push_back(fit);
  }
  return fits;
}

std::vector<ContactFit> MeasureContact(const Hand& hand) {
  std::vector<std::vector<TriMesh>> meshes(hand.links.size());
  for (const LinkVisual& visual : hand.visuals) {
    meshes[static_cast<size_t>(visual.link)].push_back(visual.mesh);
  }
  return MeasureContact(hand, MakeLinkSolids(meshes));
}

std::string DescribeContactError(const ContactFit& fit) {
  return "its " + FormatCount(fit.num_balls, "ball") + " stick out of its surface by up to " +
         FormatFixed(MmFromM(fit.out.most), 1) + " mm, a ball of 5 mm sinks in by " +
         FormatFixed(MmFromM(fit.sink.at_95), 1) + " mm at 95 of 100 points";
}

std::string DescribeSelfContact(const ContactFit& fit) {
  return "its " + FormatCount(fit.num_capsules, "capsule") + " for contact with the hand itself " +
         (fit.num_capsules == 1 ? "is" : "are") + " within " +
         FormatFixed(MmFromM(kNearSelfContact), 0) + " mm of " +
         FormatFixed(100.0 * fit.self_contact, 0) + " % of its surface; other links enter the rest";
}

}  // namespace graspbench
