#include "core/trial/measures/contact_events.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/physics/known_answers/small_scenes.h"
#include "core/physics/world.h"

namespace graspbench {
namespace {

constexpr double kStep = 0.002;

/** A hand of a palm and one finger; a script says what the finger does when. */
class Script {
 public:
  enum class State { kFree, kSticks, kSlides };
  void Play(State state, double duration) {
    const auto end = static_cast<int>(std::lround((time_ + duration) / kStep));
    for (auto i = static_cast<int>(std::lround(time_ / kStep)); i < end; ++i) {
      time_ = kStep * (i + 1);
      std::vector<HandContact> contacts;
      if (state != State::kFree) {
        HandContact contact;
        contact.link = 1;
        contact.normal_force = 2.0;
        contact.is_at_limit = state == State::kSlides;
        contact.slip_speed = contact.is_at_limit ? 0.01 : 0.0;
        contacts.push_back(contact);
      }
      recorder_.Observe(time_, kStep, contacts);
    }
  }
  std::vector<ContactEvent> events() const { return recorder_.MakeEvents(); }

 private:
  static Hand MakeHand() {
    Hand hand = MakeBareHand();
    AddRodLink(hand, 0, Pose::Identity(), Eigen::Vector3d::UnitX(), 0.01, 0.05);
    Digit digit;
    digit.id = "FF";
    digit.links = {1};
    hand.digits.push_back(digit);
    return hand;
  }

  Hand hand_ = MakeHand();
  ContactEventRecorder recorder_{hand_};
  double time_ = 0.0;
};

void ExpectEvent(const ContactEvent& event, ContactEventKind kind, double time) {
  EXPECT_STREQ(NameOf(event.kind), NameOf(kind));
  EXPECT_NEAR(event.time, time, 1.01 * kStep);
  EXPECT_EQ(event.digit, "FF");
  EXPECT_EQ(event.link, "link1");
}

TEST(ContactEvents, AScriptedTouch) {
  Script script;
  script.Play(Script::State::kFree, 0.1);
  script.Play(Script::State::kSticks, 0.2);
  script.Play(Script::State::kSlides, 0.1);
  script.Play(Script::State::kFree, 0.1);
  script.Play(Script::State::kSticks, 0.1);
  const std::vector<ContactEvent> events = script.events();
  ASSERT_EQ(events.size(), 4u);
  ExpectEvent(events[0], ContactEventKind::kTouch, 0.1);
  ExpectEvent(events[1], ContactEventKind::kSlip, 0.3);
  ExpectEvent(events[2], ContactEventKind::kLost, 0.4);
  EXPECT_NEAR(events[2].impulse, 2.0 * 0.3, 1e-9);
  ExpectEvent(events[3], ContactEventKind::kRegained, 0.5);
  EXPECT_TRUE(std::isnan(events[3].impulse));
}

TEST(ContactEvents, ChatterIsNoEvent) {
  Script script;
  script.Play(Script::State::kSticks, 0.1);
  for (int i = 0; i < 20; ++i) {
    script.Play(Script::State::kFree, 0.004);
    script.Play(Script::State::kSlides, 0.004);
    script.Play(Script::State::kSticks, 0.004);
  }
  EXPECT_EQ(script.events().size(), 1u);
}

std::vector<HandContact> MakeContacts(const std::vector<int>& links) {
  std::vector<HandContact> contacts(links.size());
  for (size_t i = 0; i < links.size(); ++i) contacts[i].link = links[i];
  return contacts;
}

/** Steady for long enough, and one step more. */
SteadyContacts MakeSteady(const std::vector<HandContact>& contacts) {
  SteadyContacts steady;
  for (int i = 0; i < 27; ++i) steady.Observe(contacts, 0.0, 0.0, kStep);
  return steady;
}

TEST(SteadyContacts, TakeTheirTime) {
  const std::vector<HandContact> contacts = MakeContacts({2, 2, 5});
  SteadyContacts steady;
  for (int i = 0; i < 25; ++i) {
    EXPECT_FALSE(steady.are_steady()) << i;
    steady.Observe(contacts, 0.0, 0.0, kStep);
  }
  steady.Observe(contacts, 0.0, 0.0, kStep);  // the first one had none before it
  EXPECT_TRUE(steady.are_steady());
}

TEST(SteadyContacts, EndAtAnyEvent) {
  const std::vector<HandContact> contacts = MakeContacts({2, 5});
  const auto is_steady_after = [&](const std::vector<HandContact>& next, double table_force,
                                   double slip_speed) {
    SteadyContacts steady = MakeSteady(contacts);
    steady.Observe(next, table_force, slip_speed, kStep);
    return steady.are_steady();
  };
  EXPECT_TRUE(is_steady_after(contacts, 0.0, 0.004));
  EXPECT_FALSE(is_steady_after(contacts, 0.0, 0.006));
  EXPECT_FALSE(is_steady_after(contacts, 0.1, 0.0));
  EXPECT_FALSE(is_steady_after(MakeContacts({2}), 0.0, 0.0));        // lost
  EXPECT_FALSE(is_steady_after(MakeContacts({2, 5, 5}), 0.0, 0.0));  // new
  EXPECT_FALSE(is_steady_after(MakeContacts({2, 4}), 0.0, 0.0));     // another
  EXPECT_FALSE(is_steady_after({}, 0.0, 0.0));
  std::vector<HandContact> slips = contacts;
  slips[1].is_at_limit = true;
  EXPECT_TRUE(is_steady_after(slips, 0.0, 0.0));  // it stands still
  slips[1].slip_speed = 0.002;
  EXPECT_FALSE(is_steady_after(slips, 0.0, 0.0));
}

TEST(SteadyContacts, NoStepIsLongerThanTheLongest) {
  SimConfig config;
  const auto steps_at = [&](double step, int factor) {
    config.step = step;
    config.steady_step_factor = factor;
    return CalcSteadySteps(config);
  };
  EXPECT_EQ(steps_at(0.002, 5), 5);
  EXPECT_EQ(steps_at(0.0005, 5), 5);
  EXPECT_EQ(steps_at(0.004, 5), 2);
  EXPECT_EQ(steps_at(0.01, 5), 1);
  EXPECT_EQ(steps_at(0.002, 1), 1);
}

}  // namespace
}  // namespace graspbench
