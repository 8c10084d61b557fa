#pragma once
/** @file
Tactile measurements of a trial by the elements of the hand's tactile.yaml (core/hand/tactile.h).

A contact of the simulation is a point, while soft tissue distributes it. By Hertz's law the force F
of a contact presses on a disc of radius a around it,

    a = patch_radius (F / 5 N)^(1/3),   p(r) ~ sqrt(1 - r^2 / a^2),

clipped to the sensed surface; the pressure on the surface sums to F. A contact outside the sensed
surfaces is not felt. An element responds to the force f on its cell. Hysteresis delays a falling
force (x, the remembered force), and each sample has independent noise n:

    x        = clamp(x, f, f / (1 - hysteresis))
    reading  = x / saturation + n                                                    linear
    reading  = (1 - exp(-x / force_scale)) / (1 - exp(-saturation / force_scale)) + n  exponential

where x is at most `saturation`. The element feels contact if its reading is above the threshold.
The reading is converted back to a force by the same equations without hysteresis. The thesis says
that the Shadow Hand's response is exponential; all numbers are proposals of graspbench. Not
modelled: shear, temperature, drift, coupling between neighbouring cells. */

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/random.h"
#include "core/base/text/record_fields.h"
#include "core/base/units.h"
#include "core/hand/tactile.h"
#include "core/physics/hand_dynamics.h"
#include "core/physics/world.h"

namespace graspbench {

/** Signal by which the strategy ends closure and stabilisation. */
enum class TouchSense {
  kExact,  ///< the contacts themselves
  kSensed  ///< the readings of the tactile elements
};
inline constexpr NamedValue<TouchSense> kTouchSenses[] = {{TouchSense::kExact, "exact"},
                                                          {TouchSense::kSensed, "sensed"}};

struct SensorConfig {
  double patch_radius = 0.004;  ///< radius of the disc at 5 N [m]
  double force_scale = 2.0;     ///< of an exponential response [N]
  double saturation = 10.0;     ///< force above which a reading stays constant [N]
  double hysteresis = 0.05;     ///< share by which a falling force is remembered
  double noise = 0.001;         ///< standard deviation, share of the full reading
  double threshold = 0.006;     ///< detection threshold, share of the full reading
  double rate = 500.0;          ///< sampling rate of every element [Hz]: a bounce may last 2 ms

  template <class V>
  void Visit(V&& v) {
    v("patch_radius_m", patch_radius,
      {"radius of the disc on which a contact of 5 N presses a tactile element", 0.0001, 0.05});
    v("force_scale_n", force_scale,
      {"force scale of a tactile element's exponential response", 0.01, 1000});
    v("saturation_n", saturation,
      {"force above which the reading of a tactile element stays constant", 0.01, 1000});
    v("hysteresis", hysteresis,
      {"hysteresis of a tactile element: a falling force f reads as at most f / (1 - hysteresis)",
       0, 0.9});
    v("noise", noise,
      {"standard deviation of a tactile element's noise, share of the full reading", 0, 1});
    v("threshold", threshold,
      {"detection threshold of a tactile element, share of the full reading", 0, 1});
    v("rate_hz", rate, {"sampling rate of every tactile element", 1, 10000});
  }
};

/** Adds a contact's force to the forces on the cells of a surface, where it sums to `force`.
Returns false if the position is not on the surface. @param forces  of all elements of the skin
[N]. */
bool SpreadForce(const SensedSurface& surface, const Eigen::Vector3d& p_L, double force,
                 double patch_radius, std::vector<double>& forces);

/** Reading of an element without noise, for a remembered force. */
double CalcReading(TactileResponse response, const SensorConfig& config, double force);
/** Force of a reading [N]: the inverse of CalcReading, at most the saturation. */
double CalcForce(TactileResponse response, const SensorConfig& config, double reading);

/** Summary of the touches of a trial. A touch begins when the contacts of a link on its sensed
surface press with more than 0.1 N, and ends when no contact is left. */
struct TouchRecord {
  int num_touches = 0;
  int num_felt_in_time = 0;    ///< felt within 10 ms
  int num_felt_late = 0;       ///< felt later
  int num_elsewhere = 0;       ///< touches by contacts outside the sensed surface of their link
  double longest_delay = 0.0;  ///< of the touches that were felt [s]
  std::vector<double> peak;    ///< by element: largest force, rounded to 1 mN [N]

  template <class V>
  static void ListFields(V&& field) {
    field("num_touches", &TouchRecord::num_touches);
    field("num_felt_in_time", &TouchRecord::num_felt_in_time);
    field("num_felt_late", &TouchRecord::num_felt_late);
    field("num_elsewhere", &TouchRecord::num_elsewhere);
    field("longest_delay_s", &TouchRecord::longest_delay);
    field("peak_n", &TouchRecord::peak);
  }
};

/** The tactile sensors in a trial. A value type: saved and restored with the trial. */
class TouchSensors {
 public:
  /** @param hand  has a skin; must outlive this object.   @param id  seeds the noise. */
  TouchSensors(const Hand& hand, const SensorConfig& config, const std::string& id);

  /** Call after every step with its contacts and the hand's posture. */
  void Observe(double time, const std::vector<HandContact>& contacts, const HandDynamics& dynamics);

  double time() const { return time_; }  ///< of the last observed step [s]
  bool has_felt(int digit) const { return has_felt_[static_cast<size_t>(digit)]; }  ///< so far
  /** Sum of the felt forces over the elements in the last sample [N]. @param digit  -1: the rest of
  the hand; unset: all. */
  double CalcFeltForce(std::optional<int> digit = std::nullopt) const;
  /** The same for one link. */
  double CalcLinkForce(int link) const;
  /** Whether an element of the link reads its maximum, so that the force may be larger. */
  bool IsSaturated(int link) const;
  /** Whether a contact of the last step is on a sensed surface. @param contact  its index. */
  bool is_on_elements(size_t contact) const { return on_elements_[contact]; }
  /** Force on each cell, before any response [N]. */
  const std::vector<double>& forces() const { return forces_; }
  const TouchRecord& record() const { return record_; }

 private:
  struct LinkTouch {
    bool is_touching = false, is_elsewhere = false;
    double waits_since = kUnset;  // not felt yet since then [s]
  };
  bool Press(const HandContact& contact, const HandDynamics& dynamics);
  void Sample();
  void FollowTouches(double time);
  bool IsFelt(int link) const;
  double CalcElementForce(size_t element) const;

  const Hand* hand_;
  std::shared_ptr<const TactileSkin> skin_;
  SensorConfig config_;
  RandomStream noise_;
  double time_ = 0.0, next_sample_ = 0.0;      // [s]
  std::vector<double> forces_;                 // [N]
  std::vector<double> remembered_, readings_;  // by element
  std::vector<double> sensed_, elsewhere_;     // by link, of the last step [N]
  std::vector<bool> on_elements_;              // by contact, likewise
  std::vector<LinkTouch> touches_;             // by link
  std::vector<bool> has_felt_;                 // by digit
  TouchRecord record_;
};

}  // namespace graspbench
