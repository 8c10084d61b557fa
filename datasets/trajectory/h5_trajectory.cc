#include <hdf5.h>

#include <Eigen/Geometry>
#include <atomic>
#include <cmath>
#include <map>

#include "core/base/error.h"
#include "core/base/version.h"
#include "datasets/session/find_trial.h"
#include "datasets/trajectory/trajectory_arrays.h"

namespace graspbench {
namespace {

/** What the library opens is closed again. A negative number is its only word for a fault; a file in
memory has none but a lack of it. */
class H5Handle {
 public:
  H5Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {
    if (id < 0) throw Error(ErrorKind::kEnvironment, "the HDF5 library reports an error");
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
  if (status < 0) throw Error(ErrorKind::kEnvironment, "the HDF5 library reports an error");
}

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

void WriteTable(hid_t group, const TrajectoryArray& table) {
  const hsize_t num_columns = table.columns.size();
  const hsize_t sizes[] = {table.values.size() / num_columns, num_columns};
  const H5Handle space(H5Screate_simple(2, sizes, nullptr), &H5Sclose);
  const H5Handle settings(MakePlainSettings(), &H5Pclose);
  if (sizes[0] > 0) {
    H5Pset_chunk(settings, 2, sizes);
    H5Pset_shuffle(settings);
    H5Pset_deflate(settings, 4);
  }
  const H5Handle data(H5Dcreate2(group, table.name.c_str(), H5T_IEEE_F64LE, space, H5P_DEFAULT,
                                 settings, H5P_DEFAULT),
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
    SetText(demo, "events", FormatTrajectoryEvents(trajectory));
    std::vector<std::string> links, phases;
    for (const HandLink& link : trajectory.hand->links) links.push_back(link.name);
    SetTexts(demo, "links", links, true);
    for (const TrajectoryArray& table : MakeTrajectoryArrays(trajectory)) WriteTable(demo, table);
    if (trajectory.hand->skin) {
      std::vector<std::string> digits;
      for (const Digit& digit : trajectory.hand->digits) digits.push_back(digit.id);
      SetTexts(demo, "digits", digits, true);
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
