#include "core/trial/measures/contact_events.h"

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/physics/world.h"

namespace graspbench {
namespace {

constexpr double kSettledTime = 0.01;  // [s]
constexpr double kSteadySlip = 0.005;  // [m/s]
constexpr double kLongestStep = 0.01;  // [s]

/** State of a link in one step. */
struct LinkNow {
  bool is_touching = false;
  bool is_sliding = true;  ///< all of its contacts slide
  double force = 0.0;
};

/** Updates the clock of a condition. Returns true if it has held for long enough. */
bool HasSettled(bool condition, double time, double& since) {
  if (!condition) {
    since = kUnset;
    return false;
  }
  if (std::isnan(since)) since = time;
  constexpr double kRounding = 1e-9;
  return time - since >= kSettledTime - kRounding;
}

}  // namespace

ContactEventRecorder::ContactEventRecorder(const Hand& hand)
    : hand_(&hand), links_(hand.links.size()) {}

void ContactEventRecorder::AddEvent(double time, ContactEventKind kind, size_t link,
                                    double impulse) {
  const int digit = hand_->FindDigitOfLink(static_cast<int>(link));
  events_.push_back(
      {time, kind, digit < 0 ? "palm" : hand_->digits[digit].id, hand_->links[link].name, impulse});
}

void ContactEventRecorder::Observe(double time, double duration,
                                   const std::vector<HandContact>& contacts) {
  std::vector<LinkNow> now(links_.size());
  for (const HandContact& contact : contacts) {
    LinkNow& link = now[static_cast<size_t>(contact.link)];
    link.is_touching = true;
    link.is_sliding = link.is_sliding && IsSliding(contact);
    link.force += contact.normal_force;
  }
  for (size_t i = 0; i < links_.size(); ++i) {
    LinkState& link = links_[i];
    link.impulse += now[i].force * duration;
    if (HasSettled(now[i].is_touching != link.is_touching, time, link.changed_since)) {
      link.is_touching = now[i].is_touching;
      if (link.is_touching) {
        AddEvent(link.changed_since,
                 link.has_touched ? ContactEventKind::kRegained : ContactEventKind::kTouch, i);
        link.has_touched = true;
      } else {
        AddEvent(link.changed_since, ContactEventKind::kLost, i, link.impulse);
        link.impulse = 0.0;
        link.is_sliding = false;
      }
      link.changed_since = kUnset;
    }
    const bool slides = link.is_touching && now[i].is_touching && now[i].is_sliding;
    const bool differs = slides != link.is_sliding && now[i].is_touching;
    if (HasSettled(differs, time, link.slides_since)) {
      link.is_sliding = slides;
      if (slides) AddEvent(link.slides_since, ContactEventKind::kSlip, i);
      link.slides_since = kUnset;
    }
  }
}

std::vector<ContactEvent> ContactEventRecorder::MakeEvents() const {
  std::vector<ContactEvent> events = events_;
  std::stable_sort(events.begin(), events.end(),
                   [](const ContactEvent& a, const ContactEvent& b) { return a.time < b.time; });
  return events;
}

void SteadyContacts::Observe(const std::vector<HandContact>& contacts, double table_force,
                             double slip_speed, double duration) {
  bool is_steady = !contacts.empty() && table_force == 0.0 && slip_speed <= kSteadySlip &&
                   contacts.size() == links_.size();
  for (size_t i = 0; i < contacts.size() && is_steady; ++i) {
    is_steady = contacts[i].link == links_[i] && !IsSliding(contacts[i]);
  }
  steady_time_ = is_steady ? steady_time_ + duration : 0.0;
  links_.clear();
  for (const HandContact& contact : contacts) links_.push_back(contact.link);
}

int CalcSteadySteps(const SimConfig& config) {
  const int longest = static_cast<int>(std::floor(kLongestStep / config.step + 1e-9));
  return std::max(1, std::min(config.steady_step_factor, longest));
}

}  // namespace graspbench
