#pragma once
/** @file
What the hand feels of a trial by the elements of its tactile.yaml (core/hand/tactile.h).

A contact of the simulation is a point; flesh spreads it. After Hertz the force F of a contact
presses a disc of radius a around it,

    a = patch_radius (F / 5 N)^(1/3),   p(r) ~ sqrt(1 - r^2 / a^2),

clipped to the sensed surface: what it presses on there sums to F. A contact whose place on the hand
is no sensed surface is not felt. An element answers to the force f on its cell, which hysteresis
holds back while it falls (x, the force remembered), with noise n of its own in each sample:

    x        = clamp(x, f, f / (1 - hysteresis))
    reading  = x / saturation + n                                                    linear
    reading  = (1 - exp(-x / force_scale)) / (1 - exp(-saturation / force_scale)) + n  exponential

and x at most `saturation`. It is felt where the reading is above the threshold; what is felt is
turned back into a force by the same equations without hysteresis. The thesis says that the Shadow
Hand's response is exponential; all numbers are proposals of graspbench. Not modelled: shear, heat,
drift, cells that press on their neighbours. */

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

/** By what the strategy ends closure and stabilisation. */
enum class TouchSense {
  kExact,  ///< the contacts themselves
  kSensed  ///< what the elements feel
};
inline constexpr NamedValue<TouchSense> kTouchSenses[] = {{TouchSense::kExact, "exact"},
                                                          {TouchSense::kSensed, "sensed"}};

struct SensorConfig {
  double patch_radius = 0.004;  ///< at 5 N [m]
  double force_scale = 2.0;     ///< of an exponential response [N]
  double saturation = 10.0;     ///< of an element: more changes nothing [N]
  double hysteresis = 0.05;     ///< share by which a falling force is remembered
  double noise = 0.001;         ///< standard deviation, share of the full reading
  double threshold = 0.006;     ///< detection threshold, share of the full reading
  double rate = 500.0;          ///< samples of every element [Hz]: a bounce may last 2 ms

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

/** Adds a contact's force to the forces on the cells of a surface, which sum to it; false where the
place is not on the surface. @param forces  of all elements of the skin [N]. */
bool SpreadForce(const SensedSurface& surface, const Eigen::Vector3d& p_L, double force,
                 double patch_radius, std::vector<double>& forces);

/** Reading of an element without noise, from the force that it remembers. */
double CalcReading(TactileResponse response, const SensorConfig& config, double force);
/** The force of a reading [N]: its inverse, at most the saturation. */
double CalcForce(TactileResponse response, const SensorConfig& config, double reading);

/** What became of the touches of a trial. A touch begins when the contacts of a link on its sensed
surface press with more than 0.1 N, and ends when none is left. */
struct TouchRecord {
  int num_touches = 0;
  int num_felt_in_time = 0;    ///< within 10 ms
  int num_felt_late = 0;       ///< after that
  int num_elsewhere = 0;       ///< the same of contacts beside any sensed surface
  double longest_delay = 0.0;  ///< of those felt [s]
  std::vector<double> peak;    ///< of each element: largest force on it, to 1 mN [N]

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

/** Feels a trial. A value: it is saved and restored with the trial. */
class TouchSensors {
 public:
  /** @param hand  with a skin; must outlive it.   @param id  names the noise. */
  TouchSensors(const Hand& hand, const SensorConfig& config, const std::string& id);

  /** To be called after every step with its contacts and the hand's posture. */
  void Observe(double time, const std::vector<HandContact>& contacts, const HandDynamics& dynamics);

  double time() const { return time_; }  ///< of the last step that was observed [s]
  bool has_felt(int digit) const { return has_felt_[static_cast<size_t>(digit)]; }  ///< ever
  /** Sum over the elements, of the last sample [N]. @param digit  -1: the rest of the hand; unset:
  all. */
  double CalcFeltForce(std::optional<int> digit = std::nullopt) const;
  /** The same of one link. */
  double CalcLinkForce(int link) const;
  /** An element of the link reads as much as it can, so that the force may be larger. */
  bool IsSaturated(int link) const;
  /** Whether a contact of the last step lies on a sensed surface, by its place among them. */
  bool is_on_elements(size_t contact) const { return on_elements_[contact]; }
  /** On each cell, before any response [N]. */
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
