#include "core/trial/measures/steady_contacts.h"

#include <gtest/gtest.h>

namespace graspbench {
namespace {

constexpr double kStep = 0.002;

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
