#pragma once
/** @file
Compares people and robots: when digits touch under each closing schedule of a grasp, on the same
draws of the same object, and what each schedule costs.

    natural       the grasp without delays
    simultaneous  each digit delayed so that all touch together in a trial without variation
    people-like   each digit delayed so that in that trial it touches when people's do: at their
                  median share of closing time, scaled to the natural grasp's closing time

Each schedule is a separate grasp, "g3-people-like", in a session in the folder schedules/ of the
session with the natural grasps (workbench/experiments/schedule_session.h). A grasp without such a
suffix is natural. That session's inputs/grasps/people.json stores people's contacts and why a
schedule is missing.

The cost in grip threshold is the ratio of a draw's threshold to that under the natural schedule:
the median over draws, with the interval of order statistics (threshold_summary.h). The ratio of a
draw is unknown if the least grip holds under both schedules, or no grip under either. Such draws
are counted and left out; if they are half of the draws or more, there is no ratio. If no grip held
under one of the two schedules, the ratio is infinite or 0.

A schedule is compared only if the compared trials realise its label. With the digits' median shares
of the closing time,

    simultaneous  GFT is at most kMostLabelError of the closing time
    people-like   each digit's share is within kMostLabelError of people's

A schedule that misses its label is reported with its deviation and has no ratio. */

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

/* When each digit touches, as a share of the closing time, for people and robots alike: the only
timing measure that a robot closing at a set speed shares with a person. For a trial with first
contacts t_d of the compared digits and the start t0 of closure (core/grasp/contact_timing.h),

    share_d = (t_d - min t) / (max t - t0),

with min and max over the digits that touched. A digit that never touched has an infinite share.
Median and quartiles (type 7) are over trials and include infinite shares; between a finite and an
infinite value the quantile is infinite.

A trial is left out, and counted, if a digit's contact time is unresolved, t0 is unknown, or a
contact came before t0. */

/** Contacts of one trial. */
struct TrialTouches {
  std::string object;
  double start = kUnset;               ///< of closure, on the clock of the contacts [s]
  std::vector<DigitContact> contacts;  ///< NaN: never touched; no entry: unknown
};

struct DigitShare {
  std::string digit;
  double low = kUnset, median = kUnset, high = kUnset;  ///< quartiles; infinite: never touched
  int num_never = 0;
};

struct TouchLags {
  int num_trials = 0;              ///< that take part
  int num_left_out = 0;            ///< for the reasons above
  double closing_time = kUnset;    ///< median of max t - t0 where a digit touched [s]
  double gft = kUnset;             ///< median [s]; infinite: a digit never touched in half of them
  std::vector<DigitShare> shares;  ///< in the order of the requested digits

  const DigitShare& Of(const std::string& digit) const;
};

/** Summarises the contacts of `digits`.
@returns no answer, with the reason, if no trial takes part or has a contact, if no trial has data
on one of the digits, or if the closing times cannot be in seconds. */
Answer<TouchLags> SummariseTouches(const std::vector<TrialTouches>& trials,
                                   const std::vector<std::string>& digits);

/** Writes infinite values as null. */
Json ToJson(const TouchLags& lags);
/** @throws Json::exception. */
TouchLags TouchLagsFromJson(const Json& json);

inline constexpr char kNatural[] = "natural";
inline constexpr char kSimultaneous[] = "simultaneous";
inline constexpr char kPeopleLike[] = "people-like";
/** In the order of tables and figures. */
inline constexpr const char* kSchedules[] = {kNatural, kSimultaneous, kPeopleLike};

/** A grasp id split into grasp and schedule: "g3-people-like" gives "g3" and "people-like"; an id
without a schedule gives itself and "natural". */
struct ScheduledGrasp {
  std::string grasp, schedule;
};
ScheduledGrasp SplitSchedule(const std::string& id);

/** One hand on one object with one grasp, with people's contacts on that object. */
struct PeopleOnObject {
  std::string hand, object, grasp;
  std::vector<std::string> digits;  ///< of the grasp; people's are matched to them
  Answer<TouchLags> people;         ///< people's contacts with these digits
  /** Why a schedule is missing, by schedule: "a digit does not touch". */
  std::map<std::string, std::string> missing;
};

/** Contents of inputs/grasps/people.json. */
struct PeopleFile {
  std::string study;  ///< as given by the user; empty: none
  std::vector<PeopleOnObject> cells;

  /** Returns null if there is no such cell. */
  const PeopleOnObject* Find(const std::string& hand, const std::string& object,
                             const std::string& grasp) const;
};
Json ToJson(const PeopleFile& people);
/** @param file  its name in messages. @throws Error(kFormat). */
PeopleFile PeopleFileFromJson(const Json& json, const std::string& file);

/** Summarises people's contacts with the object, for the grasp's digits.
@returns no answer, with the reason, as SummariseTouches() or for an object that is not in the
study. */
Answer<TouchLags> SummarisePeople(const std::vector<TrialTouches>& people,
                                  const std::string& object,
                                  const std::vector<std::string>& digits);

/** Largest deviation from a schedule's label, as a share of the closing time. */
inline constexpr double kMostLabelError = 0.1;

struct ScheduleRow {
  std::string schedule;  ///< one of kSchedules
  Answer<TouchLags> lags;
  Tally tally;
  double threshold = kUnset;              ///< median; infinite: no grip held in half of the draws
  std::string threshold_text = {};        ///< from FormatMedian; empty: not searched
  int num_pairs = 0;                      ///< draws with a threshold here and under natural
  int num_not_known = 0;                  ///< of these, with unknown ratio
  double ratio = kUnset;                  ///< median ratio to the natural schedule's threshold
  std::optional<Interval> interval = {};  ///< of the ratio, 95 %; none: too few draws
  std::string missed = {};                ///< how it misses its label; empty: it meets it
};

/** The schedules of one grasp of one hand on one object. */
struct ScheduleCell {
  PeopleOnObject of;  ///< without people where there is no PeopleFile
  std::vector<ScheduleRow> rows;
};

struct ScheduleComparison {
  std::string folder;                     ///< of the schedule session, within the session's folder
  std::string study;                      ///< with whose participants it is compared; empty: none
  const ThresholdScale* scale = nullptr;  ///< null: no thresholds are known
  std::vector<ScheduleCell> cells;        ///< in the order of the plan
};

/** Compares the schedules of a session. In a session without schedules all grasps are natural.
Grasps chosen by the camera are left out.
@param thresholds  of this session; the first scale is used. */
ScheduleComparison CompareSchedules(const Session& session, const PeopleFile& people,
                                    const std::vector<ThresholdSummary>& thresholds);

/** Lists which schedules miss their label, and why a ratio is unknown. Each sentence begins with
the schedule's name. */
std::vector<std::string> DescribeUnknown(const ScheduleCell& cell);

/** Reads inputs/grasps/people.json of a schedule session. @throws Error(kFormat, kIo). */
PeopleFile LoadPeopleFile(const std::filesystem::path& folder);

/** Loads the schedule sessions in schedules/ of the session's folder, by name. @throws as
LoadSession. */
std::vector<ScheduleComparison> LoadSchedules(const Session& session);

/** Writes {folder, study, scale, cells: [..]}; infinite and NaN values are null. */
Json ToJson(const ScheduleComparison& comparison);

}  // namespace graspbench
