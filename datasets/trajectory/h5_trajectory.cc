#include <hdf5.h>

#include <Eigen/Geometry>
#include <atomic>
#include <cmath>
#include <map>

#include "core/base/error.h"
#include "core/base/version.h"
#include "datasets/session/find_trial.h"
#include "datasets/trajectory/trajectory_form.h"

namespace graspbench {
namespace {

/** What the library opens is closed again. A negative number is its only word for a fault; a file in
memory has none but a lack of it. */
class H5Handle {
 public:
  H5Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {
    if (id < 0) throw Error(ErrorKind::kEnvironment, "the HDF5 library refuses to go on");
  }
  ~H5Handle() { close_(id_); }
  H5Handle(const H5Handle&) = delete;
  H5Handle& operator=(const H5Handle&) = delete;
  operator hid_t() const { return id_; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

void Check(herr_t status) {
  if (status < 0) throw Error(ErrorKind::kEnvironment, "the HDF5 library refuses to go on");
}

/** A table of numbers, row after row. */
struct H5Table {
  std::vector<std::string> columns;
  std::vector<double> values;
};

hid_t MakeTextType() {
  const hid_t type = H5Tcopy(H5T_C_S1);
  H5Tset_size(type, H5T_VARIABLE);
  H5Tset_cset(type, H5T_CSET_UTF8);
  return type;
}

void SetTexts(hid_t of, const char* name, const std::vector<std::string>& texts, bool is_list) {
  std::vector<const char*> pointers;
  for (const std::string& text : texts) pointers.push_back(text.c_str());
  const hsize_t size = texts.size();
  const H5Handle type(MakeTextType(), &H5Tclose);
  const H5Handle space(is_list ? H5Screate_simple(1, &size, nullptr) : H5Screate(H5S_SCALAR),
                       &H5Sclose);
  const H5Handle attribute(H5Acreate2(of, name, type, space, H5P_DEFAULT, H5P_DEFAULT), &H5Aclose);
  if (size > 0) Check(H5Awrite(attribute, type, pointers.data()));
}

void SetText(hid_t of, const char* name, const std::string& text) {
  SetTexts(of, name, {text}, false);
}

void SetNumber(hid_t of, const char* name, hid_t type, const void* value) {
  const H5Handle space(H5Screate(H5S_SCALAR), &H5Sclose);
  const H5Handle attribute(H5Acreate2(of, name, type, space, H5P_DEFAULT, H5P_DEFAULT), &H5Aclose);
  Check(H5Awrite(attribute, type, value));
}

void SetReal(hid_t of, const char* name, double value) {
  SetNumber(of, name, H5T_NATIVE_DOUBLE, &value);
}

void SetCount(hid_t of, const char* name, int64_t value) {
  SetNumber(of, name, H5T_NATIVE_INT64, &value);
}

/** Without the time of writing, so that the same content is the same bytes. */
hid_t MakePlainSettings() {
  const hid_t settings = H5Pcreate(H5P_DATASET_CREATE);
  H5Pset_obj_track_times(settings, false);
  return settings;
}

void WriteTable(hid_t group, const char* name, const H5Table& table) {
  const hsize_t num_columns = table.columns.size();
  const hsize_t sizes[] = {table.values.size() / num_columns, num_columns};
  const H5Handle space(H5Screate_simple(2, sizes, nullptr), &H5Sclose);
  const H5Handle settings(MakePlainSettings(), &H5Pclose);
  if (sizes[0] > 0) {
    H5Pset_chunk(settings, 2, sizes);
    H5Pset_shuffle(settings);
    H5Pset_deflate(settings, 4);
  }
  const H5Handle data(
      H5Dcreate2(group, name, H5T_IEEE_F64LE, space, H5P_DEFAULT, settings, H5P_DEFAULT),
      &H5Dclose);
  if (sizes[0] > 0) {
    Check(H5Dwrite(data, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, table.values.data()));
  }
  SetTexts(data, "columns", table.columns, true);
}

void WriteTexts(hid_t group, const char* name, const std::vector<std::string>& texts) {
  std::vector<const char*> pointers;
  for (const std::string& text : texts) pointers.push_back(text.c_str());
  const hsize_t size = texts.size();
  const H5Handle type(MakeTextType(), &H5Tclose);
  const H5Handle space(H5Screate_simple(1, &size, nullptr), &H5Sclose);
  const H5Handle settings(MakePlainSettings(), &H5Pclose);
  const H5Handle data(H5Dcreate2(group, name, type, space, H5P_DEFAULT, settings, H5P_DEFAULT),
                      &H5Dclose);
  if (size > 0) Check(H5Dwrite(data, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, pointers.data()));
}

hid_t MakeGroup(hid_t where, const char* name) {
  return H5Gcreate2(where, name, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
}

void AddPose(const Pose& pose, std::vector<double>& values) {
  for (double part : pose.translation()) values.push_back(part);
  const Eigen::Quaterniond turn(pose.linear());
  for (double part : turn.coeffs()) values.push_back(part);
}

void NamePose(const std::string& of, std::vector<std::string>& columns) {
  for (const char* part : {"_x_m", "_y_m", "_z_m", "_qx", "_qy", "_qz", "_qw"}) {
    columns.push_back(of + part);
  }
}

std::string NameJoint(const HandJoint& joint) {
  return joint.name + (joint.is_prismatic ? "_m" : "_rad");
}

H5Table MakeStates(const TrialTrajectory& trajectory) {
  H5Table table;
  table.columns = {"time_s", "grip_force_n", "table_force_n"};
  NamePose("hand", table.columns);
  NamePose("object", table.columns);
  for (const HandJoint& joint : trajectory.hand->joints) {
    table.columns.push_back(NameJoint(joint));
  }
  for (const TraceInstant& instant : trajectory.traced.trace) {
    for (double v : {instant.time, instant.grip_force, instant.table_force}) {
      table.values.push_back(v);
    }
    AddPose(instant.X_WH, table.values);
    AddPose(instant.X_WO, table.values);
    table.values.insert(table.values.end(), instant.q.begin(), instant.q.end());
  }
  return table;
}

/** What each drive was asked for; not a number before the first step. */
H5Table MakeActions(const TrialTrajectory& trajectory) {
  H5Table table;
  const std::vector<HandJoint>& joints = trajectory.hand->joints;
  for (const HandJoint& joint : joints) {
    if (joint.coupled_to < 0) table.columns.push_back(NameJoint(joint));
  }
  for (const TraceInstant& instant : trajectory.traced.trace) {
    for (size_t j = 0; j < joints.size(); ++j) {
      if (joints[j].coupled_to >= 0) continue;
      const bool is_asked = instant.q_asked.size() > 0;
      table.values.push_back(is_asked ? instant.q_asked[static_cast<Eigen::Index>(j)] : kUnset);
    }
  }
  return table;
}

/** One row a contact; `instant` is the row of the states, `link` a number in the links' names. */
H5Table MakeContactTable(const TrialTrajectory& trajectory) {
  const auto numbers = ListContactNumbers();
  H5Table table;
  table.columns = {"instant", "link"};
  for (const auto& number : numbers) table.columns.push_back(number.name);
  double row = 0.0;
  for (const TraceInstant& instant : trajectory.traced.trace) {
    for (const HandContact& contact : instant.contacts) {
      table.values.insert(table.values.end(), {row, static_cast<double>(contact.link)});
      for (const auto& number : numbers) {
        table.values.push_back(number.value({&instant, &contact}).get<double>());
      }
    }
    row += 1.0;
  }
  return table;
}

/** The force on each tactile element's cell, a row an instant. */
H5Table MakeTaxelTable(const TrialTrajectory& trajectory) {
  H5Table table;
  for (const TrajectoryTaxel& taxel : ListTaxels(*trajectory.hand)) {
    table.columns.push_back("element_" + std::to_string(taxel.index) + "_n");
  }
  for (const TraceInstant& instant : trajectory.traced.trace) {
    const std::vector<double> forces = CalcTaxelForces(trajectory, instant);
    table.values.insert(table.values.end(), forces.begin(), forces.end());
  }
  return table;
}

/** A row an element; `link` is a number in the links' names, `digit` in the digits': -1 the palm. */
H5Table MakeTaxelPlaces(const Hand& hand) {
  H5Table table;
  table.columns = {"link", "digit"};
  std::vector<CsvColumn<TrajectoryTaxel>> numbers;
  for (const auto& column : ListTaxelColumns()) {
    if (column.type == "number") numbers.push_back(column);
  }
  for (const auto& number : numbers) table.columns.push_back(number.name);
  for (const TrajectoryTaxel& taxel : ListTaxels(hand)) {
    const int link = taxel.element().link;
    table.values.insert(table.values.end(), {static_cast<double>(link),
                                             static_cast<double>(hand.FindDigitOfLink(link))});
    for (const auto& number : numbers) table.values.push_back(number.value(taxel).get<double>());
  }
  return table;
}

std::string FormatEvents(const TrialTrajectory& trajectory) {
  Json events = Json::array();
  for (const TrajectoryEvent& event : ListTrajectoryEvents(trajectory)) {
    Json json = {{"time_s", JsonNumber(event.time)}, {"kind", event.kind}};
    if (!event.phase.empty()) json["phase"] = event.phase;
    if (!event.link.empty()) json["digit"] = event.digit;
    if (!event.link.empty()) json["link"] = event.link;
    if (std::isfinite(event.impulse)) json["impulse_ns"] = event.impulse;
    events.push_back(std::move(json));
  }
  return FormatJson(events);
}

/** data/demo_<i> and mask/, as robomimic's files have them. */
class H5Collection : public TrajectoryCollection {
 public:
  H5Collection()
      : access_(H5Pcreate(H5P_FILE_ACCESS), &H5Pclose),
        file_(Open(access_), &H5Fclose),
        data_(MakeGroup(file_, "data"), &H5Gclose) {
    SetText(file_, "program", "graspbench " + std::string(program_version()));
    SetCount(file_, "physics_version", kPhysicsVersion);
  }

  void Add(const TrialTrajectory& trajectory) override {
    const std::string name = "demo_" + std::to_string(num_demos_++);
    const H5Handle demo(MakeGroup(data_, name.c_str()), &H5Gclose);
    const TrialResult& result = trajectory.traced.result;
    const auto num_samples = static_cast<int64_t>(trajectory.traced.trace.size());
    num_samples_ += num_samples;
    SetCount(demo, "num_samples", num_samples);
    SetText(demo, "trial_id", trajectory.planned.id);
    SetText(demo, "trial", NameTrial(trajectory.planned));
    SetText(demo, "hand", trajectory.planned.hand);
    SetText(demo, "object", trajectory.planned.object);
    SetText(demo, "grasp", trajectory.planned.grasp);
    SetText(demo, "outcome", NameOf(result.outcome));
    SetText(demo, "reason", result.reason);
    SetReal(demo, "closure_start_s", trajectory.traced.closure_start);
    SetReal(demo, "rate_hz", trajectory.rate);
    SetText(demo, "record_sha256", trajectory.record_sha256);
    SetText(demo, "events", FormatEvents(trajectory));
    std::vector<std::string> links, phases;
    for (const HandLink& link : trajectory.hand->links) links.push_back(link.name);
    SetTexts(demo, "links", links, true);
    WriteTable(demo, "states", MakeStates(trajectory));
    WriteTable(demo, "actions", MakeActions(trajectory));
    WriteTable(demo, "contacts", MakeContactTable(trajectory));
    if (trajectory.hand->skin) {
      std::vector<std::string> digits;
      for (const Digit& digit : trajectory.hand->digits) digits.push_back(digit.id);
      SetTexts(demo, "digits", digits, true);
      WriteTable(demo, "taxels", MakeTaxelTable(trajectory));
      WriteTable(demo, "taxel_elements", MakeTaxelPlaces(*trajectory.hand));
    }
    for (const TraceInstant& instant : trajectory.traced.trace) {
      phases.push_back(NameOf(instant.next_phase));
    }
    WriteTexts(demo, "phases", phases);
    masks_[IsSuccess(result.outcome) ? "success" : "failed"].push_back(name);
    // By the id, so that a trial is on the same side in every file.
    const bool is_for_validation = std::stoi(trajectory.planned.id.substr(0, 2), nullptr, 16) < 26;
    masks_[is_for_validation ? "valid" : "train"].push_back(name);
  }

  std::string Finish() override {
    SetCount(data_, "total", num_samples_);
    {
      const H5Handle mask(MakeGroup(file_, "mask"), &H5Gclose);
      for (const char* name : {"failed", "success", "train", "valid"}) {
        WriteTexts(mask, name, masks_[name]);
      }
    }
    Check(H5Fflush(file_, H5F_SCOPE_GLOBAL));
    const ssize_t size = H5Fget_file_image(file_, nullptr, 0);
    Check(size < 0 ? -1 : 0);
    std::string bytes(static_cast<size_t>(size), '\0');
    Check(H5Fget_file_image(file_, bytes.data(), bytes.size()) < 0 ? -1 : 0);
    return bytes;
  }

 private:
  /** In memory: nothing of the name is written. */
  static hid_t Open(hid_t access) {
    constexpr size_t kGrowth = size_t{4} << 20;
    static std::atomic<int> number = 0;  // two of one name must not be open
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    Check(H5Pset_fapl_core(access, kGrowth, false));
    return H5Fcreate(std::to_string(++number).c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access);
  }

  const H5Handle access_, file_, data_;
  int num_demos_ = 0;
  int64_t num_samples_ = 0;
  std::map<std::string, std::vector<std::string>> masks_;
};

std::unique_ptr<TrajectoryCollection> MakeH5Collection() {
  return std::make_unique<H5Collection>();
}

}  // namespace

TrajectoryForm MakeH5TrajectoryForm() {
  return {"h5", "all trials in one file for learning: data/demo_i, mask/", nullptr,
          &MakeH5Collection};
}

}  // namespace graspbench
