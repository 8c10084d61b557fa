#include "datasets/trajectory/trajectory_form.h"

#include <algorithm>
#include <filesystem>

#include "core/base/error.h"
#include "core/base/hash.h"
#include "core/trial/taxel_forces.h"
#include "datasets/records/trace_table.h"
#include "datasets/records/trial_record.h"

namespace graspbench {
namespace {

template <class Find>
void AddVectorColumns(const std::string& name, const std::string& unit, const std::string& of,
                      Find find, std::vector<CsvColumn<TrajectoryContact>>& columns) {
  const std::string ending = unit.empty() ? "" : "_" + std::string(unit == "N" ? "n" : unit);
  for (int axis = 0; axis < 3; ++axis) {
    const std::string letter(1, "xyz"[axis]);
    columns.push_back(
        {name + "_" + letter + ending, unit, letter + " of " + of,
         [find, axis](const TrajectoryContact& row) { return find(*row.contact)[axis]; }});
  }
}

}  // namespace

const Arm* FindTracedArm(const TracedTrial& traced) {
  const bool has_joints = !traced.trace.empty() && traced.trace.front().q_arm.size() > 0;
  return traced.arm && has_joints ? traced.arm->arm.get() : nullptr;
}

std::vector<CsvColumn<TraceInstant>> ListInstantColumns(const Hand& hand,
                                                        const TracedTrial& traced) {
  std::vector<CsvColumn<TraceInstant>> columns = ListTraceColumns(hand);
  const Arm* arm = FindTracedArm(traced);
  for (int i = 0; arm && i < arm->num_joints(); ++i) {
    const std::string& name = arm->joints[static_cast<size_t>(i)].name;
    columns.push_back({"arm/" + name + "_rad", "rad", "position of joint " + name + " of the arm",
                       [i](const TraceInstant& instant) { return instant.q_arm[i]; }});
  }
  return columns;
}

std::string CalcRecordSha256(const PlannedTrial& planned, const TrialResult& result) {
  return CalcSha256(FormatJson(ToJson(TrialRecord{planned, result})));
}

TrialTrajectory MakeTrajectory(const PlannedTrial& planned, const TrialSetup& setup,
                               const TracedTrial& traced, double rate) {
  if (traced.trace.empty()) {
    throw Error(ErrorKind::kUnsupported,
                "trial " + planned.id + " (" + DescribeTrial(planned) +
                    ") has no motion because it could not begin: " + traced.result.reason);
  }
  TrialTrajectory trajectory = {
      planned, CalcRecordSha256(planned, traced.result), setup.hand, setup.object, rate, {}};
  trajectory.traced.result = traced.result;
  trajectory.traced.closure_start = traced.closure_start;
  trajectory.traced.arm = traced.arm;
  trajectory.sensors = setup.sensors;
  std::vector<TraceInstant>& kept = trajectory.traced.trace;
  int num_regular = 0;
  for (const TraceInstant& instant : traced.trace) {
    const bool is_due =
        instant.time - traced.trace.front().time >= num_regular / rate - 1e-9;  // of rounding
    num_regular += is_due;
    const bool ends_phase = instant.next_phase != instant.phase;
    if (is_due || ends_phase || &instant == &traced.trace.back()) kept.push_back(instant);
  }
  return trajectory;
}

std::vector<TrajectoryEvent> ListTrajectoryEvents(const TrialTrajectory& trajectory) {
  const TracedTrial& traced = trajectory.traced;
  std::vector<TrajectoryEvent> events = {
      {0.0, "phase", NameOf(traced.trace.front().phase), "", "", kUnset}};
  for (const PhaseStart& phase : traced.result.phases) {
    events.push_back({phase.time + traced.closure_start, "phase", phase.name, "", "", kUnset});
  }
  for (const ContactEvent& event : traced.result.contact_events) {
    events.push_back({event.time + traced.closure_start, NameOf(event.kind), "", event.digit,
                      event.link, event.impulse});
  }
  std::stable_sort(
      events.begin(), events.end(),
      [](const TrajectoryEvent& a, const TrajectoryEvent& b) { return a.time < b.time; });
  return events;
}

std::vector<CsvColumn<TrajectoryContact>> ListContactNumbers() {
  std::vector<CsvColumn<TrajectoryContact>> columns;
  AddVectorColumns(
      "p", "m", "the contact in the world", [](const HandContact& c) { return c.p_WC; }, columns);
  AddVectorColumns(
      "n", "", "the unit normal from the hand into the object, in the world",
      [](const HandContact& c) { return c.nhat_W; }, columns);
  columns.push_back({"normal_force_n", "N", "of the hand on the object",
                     [](const TrajectoryContact& row) { return row.contact->normal_force; }});
  AddVectorColumns(
      "friction", "N", "the tangential force on the object, in the world",
      [](const HandContact& c) { return c.friction_W; }, columns);
  columns.push_back({"spin_moment_nm", "N m", "on the object about the normal",
                     [](const TrajectoryContact& row) { return row.contact->spin_moment; }});
  columns.push_back({"slip_speed_m_per_s", "m/s", "tangential speed of the surfaces",
                     [](const TrajectoryContact& row) { return row.contact->slip_speed; }});
  columns.push_back({"mu", "", "coefficient of friction in this state",
                     [](const TrajectoryContact& row) { return row.contact->mu; }});
  return columns;
}

std::vector<CsvColumn<TrajectoryTaxel>> ListTaxelColumns() {
  using Row = TrajectoryTaxel;
  std::vector<CsvColumn<Row>> columns = {
      {"element", "integer", "", "number of the tactile element, from 0",
       [](const Row& row) { return Json(row.index); }},
      {"link", "string", "", "link of the hand",
       [](const Row& row) {
         return Json(row.hand->links[static_cast<size_t>(row.element().link)].name);
       }},
      {"digit", "string", "", "digit of that link; palm: none", [](const Row& row) {
         const int digit = row.hand->FindDigitOfLink(row.element().link);
         return Json(digit < 0 ? "palm" : row.hand->digits[static_cast<size_t>(digit)].id);
       }}};
  for (int axis = 0; axis < 3; ++axis) {
    const std::string letter(1, "xyz"[axis]);
    columns.push_back({"p_" + letter + "_m", "m", letter + " of its place in the link's frame",
                       [axis](const Row& row) { return row.element().p_LE[axis]; }});
  }
  for (int axis = 0; axis < 3; ++axis) {
    const std::string letter(1, "xyz"[axis]);
    columns.push_back({"n_" + letter, "",
                       letter + " of its unit normal out of the hand, in the link's frame",
                       [axis](const Row& row) { return row.element().normal_L[axis]; }});
  }
  columns.push_back(
      {"area_m2", "m2", "of its cell", [](const Row& row) { return row.element().area; }});
  return columns;
}

std::vector<TrajectoryTaxel> ListTaxels(const Hand& hand) {
  std::vector<TrajectoryTaxel> taxels;
  for (size_t i = 0; hand.skin && i < hand.skin->elements.size(); ++i) taxels.push_back({&hand, i});
  return taxels;
}

std::vector<double> CalcTaxelForces(const TrialTrajectory& trajectory,
                                    const TraceInstant& instant) {
  return CalcTaxelForces(*trajectory.hand, trajectory.sensors, instant.X_WH, instant.q,
                         instant.contacts);
}

const std::vector<TrajectoryForm>& ListTrajectoryForms() {
  static const std::vector<TrajectoryForm> forms = {
#define GRASPBENCH_TRAJECTORY_FORM(Name) Make##Name##TrajectoryForm(),
#include "datasets/trajectory/trajectory_form_list.inc"
#undef GRASPBENCH_TRAJECTORY_FORM
  };
  return forms;
}

const TrajectoryForm& FindTrajectoryForm(const std::string& name) {
  const std::string ending = std::filesystem::path(name).extension().string();
  std::string known;
  for (const TrajectoryForm& form : ListTrajectoryForms()) {
    if (name == form.name || ending == "." + std::string(form.name)) return form;
    known += (known.empty() ? "." : ", .") + std::string(form.name);
  }
  throw Error(ErrorKind::kUsage,
              "--trajectory: \"" + name + "\" has none of the known endings: " + known);
}

std::vector<TrajectoryFile> MakeTrajectoryFiles(const TrajectoryForm& form,
                                                const TrialTrajectory& trajectory) {
  if (form.make) return form.make(trajectory);
  const auto collection = form.collect();
  collection->Add(trajectory);
  return {{"." + std::string(form.name), collection->Finish()}};
}

}  // namespace graspbench
