#include "core/trial/measures/contact_events.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/error.h"
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

TEST(ContactEvents, SurviveTheirRecord) {
  Script script;
  script.Play(Script::State::kSticks, 0.1);
  script.Play(Script::State::kFree, 0.1);
  for (const ContactEvent& event : script.events()) {
    const std::string text = RecordToJson(event).dump();
    ContactEvent back;
    ReadRecord(Json::parse(text), back);
    EXPECT_EQ(RecordToJson(back).dump(), text);
  }
  ContactEvent event;
  EXPECT_THROW(ReadRecord({{"time_s", 1.0}, {"kind", "kiss"}}, event), Error);
}

}  // namespace
}  // namespace graspbench
