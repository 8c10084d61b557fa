#include "core/trial/measures/palm_contact.h"

#include <gtest/gtest.h>

namespace graspbench {
namespace {

ContactEvent MakeEvent(double time, ContactEventKind kind, const char* digit, const char* link) {
  ContactEvent event;
  event.time = time;
  event.kind = kind;
  event.digit = digit;
  event.link = link;
  return event;
}

TEST(PalmContactTest, CountsWhatTouchesInTheEnd) {
  TrialResult result;
  EXPECT_FALSE(TouchesPalmAtEnd(result));
  result.contact_events = {MakeEvent(0.1, ContactEventKind::kTouch, "TH", "thdistal")};
  EXPECT_FALSE(TouchesPalmAtEnd(result));
  result.contact_events.push_back(MakeEvent(0.2, ContactEventKind::kTouch, "palm", "palm"));
  EXPECT_TRUE(TouchesPalmAtEnd(result));
  result.contact_events.push_back(MakeEvent(0.3, ContactEventKind::kSlip, "palm", "palm"));
  EXPECT_TRUE(TouchesPalmAtEnd(result));
  result.contact_events.push_back(MakeEvent(0.4, ContactEventKind::kLost, "palm", "palm"));
  EXPECT_FALSE(TouchesPalmAtEnd(result));
  result.contact_events.push_back(MakeEvent(0.5, ContactEventKind::kRegained, "palm", "palm"));
  EXPECT_TRUE(TouchesPalmAtEnd(result));
}

// One of two links that stays is enough, whichever was lost last.
TEST(PalmContactTest, LinksOfNoDigitCountEach) {
  TrialResult result;
  result.contact_events = {MakeEvent(0.1, ContactEventKind::kTouch, "palm", "palm"),
                           MakeEvent(0.2, ContactEventKind::kTouch, "palm", "wrist"),
                           MakeEvent(0.3, ContactEventKind::kLost, "palm", "wrist")};
  EXPECT_TRUE(TouchesPalmAtEnd(result));
}

}  // namespace
}  // namespace graspbench
