#pragma once
/** @file
What happens in a trial: its protocol. Every one moves a world step by step and gives a result of
the same form, so that runner, trace and judge serve them all. One more: a file with its course and
`const Protocol& Get<Name>()`, and a line in protocol_list.inc. */

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/grasp/strategy.h"
#include "core/physics/world.h"
#include "core/trial/judge/judgement.h"
#include "core/trial/trial_result.h"
#include "core/trial/trial_setup.h"

namespace graspbench {

class WristCamera;

/** One trial in progress. */
class TrialCourse {
 public:
  virtual ~TrialCourse() = default;
  TrialCourse(const TrialCourse&) = delete;
  TrialCourse& operator=(const TrialCourse&) = delete;

  /** Puts object and hand to where the trial starts. To be called once, before all that follows.
  @throws Error(kRange) when the start is not finite. */
  virtual void Begin() = 0;
  /** Goes on by one step; false when the trial is over and nothing is left to do. */
  virtual bool Advance() = 0;
  /** The result. @pre Advance gave false. */
  virtual TrialResult End() = 0;
  /** Once it is over: the object hangs in the hand, so that there is something to judge. */
  virtual bool is_held() const = 0;
  /** @pre is_held() */
  virtual Judgement Judge() const = 0;
  /** What the grasp stands before it breaks (TrialResult::strength) [N]. @pre it is over */
  virtual double FindStrength() const = 0;

  virtual double time() const = 0;  ///< since the start [s]
  virtual Phase phase() const = 0;
  virtual double closure_start() const = 0;              ///< NaN: not yet [s]
  virtual const StepReport& report() const = 0;          ///< of the last step
  virtual const WorldCommand& last_command() const = 0;  ///< what the hand was last asked for

  World& world() { return *world_; }
  /** Begin, Advance to the end, End. @param observe  called after Begin and after every step. */
  TrialResult Run(const std::function<void(TrialCourse&)>& observe = {});

 protected:
  explicit TrialCourse(std::unique_ptr<World> world) : world_(std::move(world)) {}

  std::unique_ptr<World> world_;
};

struct Protocol {
  const char* id;       ///< in files
  const char* purpose;  ///< for people
  TablePresence table;  ///< of the worlds that it runs in
  /** @param setup  outlives the course.   @param camera  may be null. */
  std::unique_ptr<TrialCourse> (*make_course)(std::unique_ptr<World> world, const TrialSetup& setup,
                                              WristCamera* camera);
};

/** In the order of protocol_list.inc. */
const std::vector<const Protocol*>& ListProtocols();
/** @throws Error(kUsage) for an id that no protocol has. */
const Protocol& FindProtocol(const std::string& id);

#define GRASPBENCH_PROTOCOL(Name) const Protocol& Get##Name();
#include "core/trial/protocols/protocol_list.inc"
#undef GRASPBENCH_PROTOCOL

}  // namespace graspbench
