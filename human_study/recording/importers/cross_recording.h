#pragma once
/** @file
Serialisation of recordings and importer options through the fence (core/fence/crossing.h). */

#include "core/fence/crossing.h"
#include "human_study/recording/importers/importer.h"
#include "human_study/recording/importers/table_mapping.h"

namespace graspbench {

template <>
inline constexpr int kNumValues<SampleState> = static_cast<int>(SampleState::kInvalid) + 1;
template <>
inline constexpr int kNumValues<EventSource> = static_cast<int>(EventSource::kHeader) + 1;

template <class Values>
void CrossMembers(Values& values, TableRows& rows) {
  Cross(values, rows.begin, rows.first_line, rows.last_line);
}

template <class Values>
void CrossMembers(Values& values, TableTrial& trial) {
  Cross(values, trial.name, trial.rows);
}

template <class Values>
void CrossMembers(Values& values, TableMapping::Point& point) {
  Cross(values, point.label, point.columns);
}

template <class Values>
void CrossMembers(Values& values, GloveMapping& glove) {
  Cross(values, glove.hand, glove.is_in_degrees, glove.joints, glove.base, glove.quaternion);
}

template <class Values>
void CrossMembers(Values& values, TableMapping& mapping) {
  Cross(values, mapping.points, mapping.layout, mapping.unit, mapping.scale, mapping.time,
        mapping.seconds_per_time_unit, mapping.rate, mapping.trial, mapping.occluded,
        mapping.channels, mapping.glove, mapping.has_heading);
}

template <class Values>
void CrossMembers(Values& values, ImportOptions& options) {
  Cross(values, options.format, options.unit, options.accept_truncated, options.trust_residuals,
        options.mapping, options.trial, options.rows);
}

template <class Values>
void CrossMembers(Values& values, PersonalField& field) {
  Cross(values, field.where, field.text);
}

template <class Values>
void CrossMembers(Values& values, RecordedPoint& point) {
  Cross(values, point.label, point.unit, point.metres_per_unit, point.xyz, point.states,
        point.residuals);
}

template <class Values>
void CrossMembers(Values& values, AnalogChannel& channel) {
  Cross(values, channel.label, channel.unit, channel.rate, channel.samples);
}

template <class Values>
void CrossMembers(Values& values, RecordedEvent& event) {
  Cross(values, event.label, event.context, event.time, event.source);
}

template <class Values>
void CrossMembers(Values& values, ImportFinding& finding) {
  Cross(values, finding.code, finding.where, finding.text);
}

template <class Values>
void CrossMembers(Values& values, Recording& recording) {
  Cross(values, recording.format, recording.processor, recording.rate, recording.first_frame,
        recording.num_frames, recording.start_time, recording.times, recording.points,
        recording.analog, recording.events, recording.findings);
  if constexpr (Values::kIsIncoming) {
    const size_t n = recording.num_frames;
    const auto is_none_or_all = [&](size_t count) { return count == 0 || count == n; };
    values.Check(is_none_or_all(recording.times.size()));
    for (const RecordedPoint& point : recording.points) {
      values.Check(point.states.size() == n && point.xyz.size() / 3 == n &&
                   point.xyz.size() % 3 == 0 && is_none_or_all(point.residuals.size()));
    }
  }
}

}  // namespace graspbench
