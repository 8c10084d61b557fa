/** @file
A C3D file of 100 MB: under two seconds and under 300 MB of memory on a desktop machine of 2023. The
time is printed, the memory is checked. */

#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "tests/human_study/recording/synthetic_recording.h"

namespace graspbench {
namespace {

/** Forgets the peak so far, which the writer made. False where the system does not allow it. */
bool ResetPeakMemory() {
  std::ofstream out("/proc/self/clear_refs");
  out << "5" << std::flush;
  return out.good();
}

double FindPeakMemoryMb() {
  std::ifstream in("/proc/self/status");
  std::string word;
  while (in >> word) {
    double kilobytes = 0.0;
    if (word == "VmHWM:" && in >> kilobytes) return kilobytes / 1024.0;
  }
  return std::nan("");
}

/** Writes 60 points over as many frames as fill 100 MB. */
void WriteHundredMegabytes(const std::filesystem::path& path, bool is_float) {
  constexpr size_t kPoints = 60;
  const size_t frame_size = kPoints * (is_float ? 16 : 8);
  Recording recording = MakeSyntheticRecording(100'000'000 / frame_size, kPoints);
  recording.analog.clear();
  C3dWriteOptions options;
  options.is_float = is_float;
  std::ofstream out(path, std::ios::binary);
  WriteC3d(out, recording, options);
}

TEST(ImportSpeed, HundredMegabytesOfC3d) {
  const std::filesystem::path path = std::filesystem::path(testing::TempDir()) / "speed.c3d";
  for (const bool is_float : {true, false}) {
    WriteHundredMegabytes(path, is_float);
    const double size_mb = static_cast<double>(std::filesystem::file_size(path)) / 1e6;
    EXPECT_GT(size_mb, 99.9);
    const bool has_peak = ResetPeakMemory();
    const auto start = std::chrono::steady_clock::now();
    const Recording recording = LoadRecording(path);
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    const double peak_mb = FindPeakMemoryMb();
    EXPECT_EQ(recording.points.size(), 60u);
    EXPECT_NEAR(recording.points[59].Position(0).z(), 0.959, 1e-4);
    std::printf("%s: %.1f MB in %.2f s, peak memory %.0f MB\n", is_float ? "float" : "integer",
                size_mb, elapsed.count(), peak_mb);
    if (has_peak) {
      EXPECT_LT(peak_mb, 300.0);
    }
  }
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace graspbench
