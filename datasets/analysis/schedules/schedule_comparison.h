#pragma once
/** @file
People and robots side by side: when digits touch under each schedule with which a
grasp may close on the same draws of the same object, and what each schedule costs.

    natural       as the grasp closes by itself
    simultaneous  each digit delayed so that in a trial without variation all touch together
    people-like   each digit delayed so that there it touches when people do: the median share of
                  people's closing time, of the closing time that the natural grasp has there

A schedule is a grasp of its own, "g3-people-like", in a session below `schedules/` of the one whose
grasps they are (workbench/experiments/schedule_session.h); a grasp without such an ending is
natural. What people did, and why a schedule is missing, stands in that session's
inputs/grasps/people.json.

The cost in threshold is the ratio of the draw's grip threshold to that of the natural schedule, the
median over draws with the interval of order statistics (threshold_summary.h). Where under both the
least grip of the scale holds, or none does, it is not known: such draws are counted and left out,
and where they are half of the draws or more there is no ratio. Where no grip held under one
schedule the ratio is infinite, or 0.

A schedule is compared only where it came out as its label says over the trials that are compared.
With the digits' median shares of the closing time,

    simultaneous  GFT is at most kMostLabelError of the closing time
    people-like   each digit's share is within kMostLabelError of people's

A schedule that misses its label is named, with by how much, and has no ratio. */

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/base/text/json.h"
#include "core/grasp/contact_timing.h"
#include "core/statistics/answer.h"
#include "datasets/analysis/conditions/threshold_summary.h"
#include "datasets/analysis/session_summary.h"

namespace graspbench {

/* When each digit touches, in shares of the closing time, for people and robots alike: the one
measure that a robot which closes at a set speed shares with a person. Of a trial with first
contacts t_d of the digits that are compared and the start t0 of closure
(core/grasp/contact_timing.h),

    share_d = (t_d - min t) / (max t - t0),

min and max over the digits that touched; a digit that never touched has an infinite share, later
than every other. Median and quartiles are those of the trials, infinite shares in their place
(type 7; between a finite and an infinite value: infinite).

A trial is left out, and counted, where a digit's contact cannot be told, t0 is not known, or a
contact came before t0. */

/** What one trial says of its contacts. */
struct TrialTouches {
  std::string object;
  double start = kUnset;               ///< of closure, on the clock of the contacts [s]
  std::vector<DigitContact> contacts;  ///< NaN: never touched; a digit without an entry: not known
};

struct DigitShare {
  std::string digit;
  double low = kUnset, median = kUnset, high = kUnset;  ///< quartiles; infinite: never touched
  int num_never = 0;
};

struct TouchLags {
  int num_trials = 0;              ///< that take part
  int num_left_out = 0;            ///< as above
  double closing_time = kUnset;    ///< median of max t - t0 where a digit touched [s]
  double gft = kUnset;             ///< median; infinite: a digit never touched in half of them [s]
  std::vector<DigitShare> shares;  ///< in the order of the digits asked for

  const DigitShare& Of(const std::string& digit) const;
};

/** @param digits  that are compared.
@returns no answer, with the reason, without a trial that takes part or a touch in them, of digits
that no trial knows, and for closing times that cannot be seconds. */
Answer<TouchLags> SummariseTouches(const std::vector<TrialTouches>& trials,
                                   const std::vector<std::string>& digits);

/** Infinite is null. */
Json ToJson(const TouchLags& lags);
/** @throws Json::exception. */
TouchLags TouchLagsFromJson(const Json& json);

inline constexpr char kNatural[] = "natural";
inline constexpr char kSimultaneous[] = "simultaneous";
inline constexpr char kPeopleLike[] = "people-like";
/** In the order of tables and pictures. */
inline constexpr const char* kSchedules[] = {kNatural, kSimultaneous, kPeopleLike};

/** "g3" and "people-like" of "g3-people-like"; of an id without a schedule itself and "natural". */
struct ScheduledGrasp {
  std::string grasp, schedule;
};
ScheduledGrasp SplitSchedule(const std::string& id);

/** One hand on one object with one grasp, and what people did there. */
struct PeopleOnObject {
  std::string hand, object, grasp;
  std::vector<std::string> digits;  ///< of the grasp, with which people's are paired
  Answer<TouchLags> people;         ///< of these digits
  /** By schedule, why there is none: "a digit does not touch". */
  std::map<std::string, std::string> missing;
};

/** inputs/grasps/people.json. */
struct PeopleFile {
  std::string study;  ///< as a person gave it; empty: none
  std::vector<PeopleOnObject> cells;

  /** Null: none. */
  const PeopleOnObject* Find(const std::string& hand, const std::string& object,
                             const std::string& grasp) const;
};
Json ToJson(const PeopleFile& people);
/** @param file  its name in messages. @throws Error(kFormat). */
PeopleFile PeopleFileFromJson(const Json& json, const std::string& file);

/** People's touches of the object with the grasp's digits.
@returns no answer, with the reason, also for an object that the study does not have. */
Answer<TouchLags> SummarisePeople(const std::vector<TrialTouches>& people,
                                  const std::string& object,
                                  const std::vector<std::string>& digits);

/** Of the closing time, between what a schedule's label says and what came out. */
inline constexpr double kMostLabelError = 0.1;

struct ScheduleRow {
  std::string schedule;  ///< one of kSchedules
  Answer<TouchLags> lags;
  Tally tally;
  double threshold = kUnset;              ///< median; infinite: no grip held in half of the draws
  std::string threshold_text = {};        ///< as FormatMedian says it; empty: none was looked for
  int num_pairs = 0;                      ///< draws with a threshold here and under natural
  int num_not_known = 0;                  ///< of these, whose ratio is not known
  double ratio = kUnset;                  ///< to natural's
  std::optional<Interval> interval = {};  ///< of the ratio, 95 %; none: too few draws
  std::string missed = {};                ///< how it misses its label; empty: it does not
};

/** The schedules of one grasp of one hand on one object. */
struct ScheduleCell {
  PeopleOnObject of;  ///< without people where there is no PeopleFile
  std::vector<ScheduleRow> rows;
};

struct ScheduleComparison {
  std::string folder;  ///< of the session that they are from, in the session's folder
  std::string study;   ///< whose people are compared; empty: none
  const ThresholdScale* scale = nullptr;  ///< null: no thresholds are known
  std::vector<ScheduleCell> cells;        ///< in the order of the plan
};

/** Of a session of schedules, or of any other, whose grasps are natural. Grasps that the camera
chose take no part.
@param thresholds  of this session; the first scale counts. */
ScheduleComparison CompareSchedules(const Session& session, const PeopleFile& people,
                                    const std::vector<ThresholdSummary>& thresholds);

/** Which schedules miss their label, and why a ratio is not known: one sentence each, that begins
with the schedule's name. */
std::vector<std::string> DescribeUnknown(const ScheduleCell& cell);

/** inputs/grasps/people.json of a session of schedules. @throws Error(kFormat, kIo). */
PeopleFile LoadPeopleFile(const std::filesystem::path& folder);

/** Those below `schedules/` of the session, in the order of their names. @throws as LoadSession. */
std::vector<ScheduleComparison> LoadSchedules(const Session& session);

/** {folder, study, scale, cells: [..]}; infinite and NaN are null. */
Json ToJson(const ScheduleComparison& comparison);

}  // namespace graspbench
